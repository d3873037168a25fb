"""The files of a work tree that differ from the start of its branch."""

import subprocess
from pathlib import Path
from typing import NamedTuple, Optional, Set

MAIN_BRANCHES = ("@{upstream}", "origin/HEAD", "origin/main", "origin/master")
RECENT_COMMITS = 10


class Changes(NamedTuple):
    """The files, with full paths, or None if unknown; and a text that names the base."""

    files: Optional[Set[Path]]
    why: str


def git(root, *arguments):
    """The output of git, or None if it fails or is not installed."""
    try:
        done = subprocess.run(
            ["git", "-C", str(root), *arguments], capture_output=True, text=True, check=False
        )
    except OSError:
        return None
    return done.stdout.strip("\n") if done.returncode == 0 else None


def find_base(root, since=None):
    """The commit to compare with, or None, and why.

    That is where the branch left the main branch; for the main branch itself, and if the point
    is unknown, the oldest of the recent commits. A clone may have only one commit.
    """
    head = git(root, "rev-parse", "--verify", "HEAD^{commit}")
    if head is None:
        return None, "there is no commit"
    for name in (since,) if since else MAIN_BRANCHES:
        base = git(root, "merge-base", "HEAD", name)
        if base is not None and (since or base != head):
            return base, f"changed since {base[:10]}, the merge base with {name}"
    recent = git(root, "rev-list", "--first-parent", f"--max-count={RECENT_COMMITS + 1}", "HEAD")
    commits = recent.split()
    missing = f"{since} can't be found; " if since else ""
    if len(commits) < 2:
        return None, f"{missing}the history holds one commit"
    return commits[-1], f"{missing}changed in the last {len(commits) - 1} commits"


def find_changes(root, since=None):
    """All files that differ from the base, committed or not, less those deleted."""
    base, why = find_base(root, since)
    if base is None:
        return Changes(None, why)
    top = git(root, "rev-parse", "--show-toplevel")
    differing = git(root, "diff", "--name-only", "--diff-filter=d", "-z", base)
    untracked = git(root, "ls-files", "--others", "--exclude-standard", "--full-name", "-z")
    if top is None or differing is None or untracked is None:
        return Changes(None, "git does not say what changed")
    names = [*differing.split("\0"), *untracked.split("\0")]
    return Changes({Path(top).resolve() / name for name in names if name}, why)
