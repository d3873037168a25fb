"""Runs programs for the checks of this folder."""

import subprocess


def run_in(folder, *command, status=0):
    """Standard output and error of a program that runs in a folder, and must end with a status."""
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == status, f"{command}: {done.stdout}{done.stderr}"
    return done.stdout + done.stderr
