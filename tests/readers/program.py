"""Runs programs for the checks of this folder."""

import subprocess


def run_in(folder, *command, status=0):
    """What a program prints and what it complains of, run in a folder; it must end with that status."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == status, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr
