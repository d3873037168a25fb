"""changes.py on small repositories, among them those that continuous integration makes."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import changes

IDENTITY = {
    name: value
    for role in ("AUTHOR", "COMMITTER")
    for name, value in ((f"GIT_{role}_NAME", "a"), (f"GIT_{role}_EMAIL", "a@b"))
}


class Changes(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = Path(self.folder.name).resolve() / "main"
        self.root.mkdir()
        self.git(self.root, "init", "-q", "-b", "main")
        for i in range(3):
            self.commit(self.root, f"old{i}.cpp")

    def git(self, root, *arguments):
        environment = {**os.environ, **IDENTITY, "GIT_CONFIG_GLOBAL": os.devnull}
        subprocess.run(["git", "-C", str(root), *arguments], env=environment, check=True)

    def commit(self, root, name):
        (root / name).write_text(name)
        self.git(root, "add", name)
        self.git(root, "commit", "-q", "-m", name)

    def clone(self, *arguments):
        copy = self.root.parent / "clone"
        self.git(self.root, "clone", "-q", *arguments, self.root.as_uri(), str(copy))
        return copy

    def names(self, root, since=None):
        found = changes.find_changes(root, since)
        return None if found.files is None else {path.name for path in found.files}

    def test_a_branch_is_compared_with_where_it_began(self):
        copy = self.clone()
        self.git(copy, "checkout", "-q", "-b", "branch")
        self.commit(copy, "new.cpp")
        self.assertEqual(self.names(copy), {"new.cpp"})

    def test_what_is_not_committed_counts(self):
        copy = self.clone()
        self.commit(copy, "new.cpp")
        (copy / "newer.cpp").write_text("")
        (copy / "old0.cpp").write_text("other")
        self.assertEqual(self.names(copy), {"new.cpp", "newer.cpp", "old0.cpp"})

    def test_what_was_deleted_does_not(self):
        copy = self.clone()
        self.git(copy, "rm", "-q", "old0.cpp")
        self.git(copy, "commit", "-q", "-m", "less")
        self.assertEqual(self.names(copy), set())

    def test_on_the_main_branch_the_last_commits_count(self):
        found = changes.find_changes(self.clone())
        self.assertEqual({path.name for path in found.files}, {"old1.cpp", "old2.cpp"})
        self.assertIn("last 2 commits", found.why)

    def test_only_so_many_of_them(self):
        for i in range(changes.RECENT_COMMITS):
            self.commit(self.root, f"new{i}.cpp")
        expected = {f"new{i}.cpp" for i in range(changes.RECENT_COMMITS)}
        self.assertEqual(self.names(self.root), expected)

    def test_a_clone_of_one_commit_can_not_tell(self):
        found = changes.find_changes(self.clone("--depth=1"))
        self.assertIsNone(found.files)
        self.assertIn("one commit", found.why)

    def test_a_shallow_clone_tells_what_it_knows(self):
        self.assertEqual(self.names(self.clone("--depth=2")), {"old2.cpp"})

    def test_a_branch_without_its_beginning_is_compared_with_the_last_commits(self):
        self.git(self.root, "checkout", "-q", "--orphan", "apart")
        self.git(self.root, "commit", "-q", "-m", "begin")
        self.commit(self.root, "new.cpp")
        copy = self.clone("--branch=apart")
        self.git(copy, "branch", "-q", "--unset-upstream")
        self.git(copy, "remote", "set-head", "origin", "main")
        self.assertEqual(self.names(copy), {"new.cpp"})

    def test_the_base_can_be_named(self):
        self.assertEqual(self.names(self.root, "HEAD~1"), {"old2.cpp"})
        found = changes.find_changes(self.root, "nowhere")
        self.assertIn("nowhere can't be found", found.why)
        self.assertTrue(found.files)

    def test_a_folder_that_is_no_repository_can_not_tell(self):
        folder = self.root.parent / "plain"
        folder.mkdir()
        self.assertIsNone(changes.find_changes(folder).files)


if __name__ == "__main__":
    unittest.main()
