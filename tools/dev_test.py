"""The command ./dev where programs that it calls are replaced: package managers, and quasimc itself."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

DEV = Path(__file__).resolve().parent.parent / "dev"

APT_GET = """#!/bin/sh
echo "$1" >>"{calls}"
if [ "$(wc -l <"{calls}")" -le {locked} ]; then
    echo "E: Could not get lock /var/lib/apt/lists/lock. It is held by process 12 (apt-get)" >&2
    exit 100
fi
echo "{words}" >&2
exit {status}
"""


class Dev(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name).resolve()
        self.tools = self.folder / "tools"
        self.tools.mkdir()
        shutil.copy(DEV, self.folder / "dev")

    def replace(self, name, script):
        tool = self.tools / name
        tool.write_text(script)
        tool.chmod(0o755)

    def replace_apt_get(self, locked, status=0, words="done"):
        self.calls = self.folder / "calls"
        self.replace("apt-get", APT_GET.format(calls=self.calls, locked=locked, status=status, words=words))
        self.replace("dpkg-query", "#!/bin/sh\nexit 1\n")
        self.replace("id", "#!/bin/sh\necho 0\n")
        self.replace("sleep", "#!/bin/sh\n")

    def run_dev(self, *arguments, folder=None, dev="./dev", **variables):
        path = f"{self.tools}:{os.environ['PATH']}"
        return subprocess.run([dev, *arguments], cwd=folder or self.folder, env={**os.environ, "PATH": path, **variables},
                              capture_output=True, text=True)

    def test_it_waits_for_the_locks_of_the_package_manager(self):
        self.replace_apt_get(locked=3)
        done = self.run_dev("setup", "run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.calls.read_text().split(), ["update"] * 4 + ["install"])
        self.assertEqual(done.stderr.count("waiting for another process"), 1, done.stderr)

    def test_it_does_not_wait_where_another_fault_stops_the_package_manager(self):
        self.replace_apt_get(locked=0, status=100, words="E: Unable to locate package")
        done = self.run_dev("setup", "run")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(self.calls.read_text().split(), ["update", "install"])
        self.assertIn("E: Unable to locate package", done.stderr)

    def test_it_does_not_wait_for_ever(self):
        self.replace_apt_get(locked=1000000)
        done = self.run_dev("setup", "run")
        self.assertEqual(done.returncode, 1)
        self.assertIn("E: Could not get lock", done.stderr)

    def test_files_belong_to_the_folder_of_the_caller(self):
        below = self.folder / "examples" / "a"
        below.mkdir(parents=True)
        (below / "maize.toml").write_text("")
        self.replace("quasimc", '#!/bin/sh\necho "$(pwd)" "$@"\n')
        done = self.run_dev("run", "maize.toml", folder=below, dev="../../dev", QUASIMC_PROGRAM=str(self.tools / "quasimc"))
        self.assertEqual(done.stdout.strip(), f"{below} run maize.toml", done.stderr)


if __name__ == "__main__":
    unittest.main()
