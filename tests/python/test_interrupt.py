"""Ctrl-C, in a process of its own."""

import signal
import subprocess
import sys
import time

HEAD = """
import sys, warnings
sys.path.insert(0, {folder!r})
import quasimc
from canopies import canopy
scene = canopy(200)
scene.build()
"""

LONG = "max_paths=1 << 30, target_error=1e-9, method='light_tracing'"


def interrupted(code, after):
    """What a program says that gets Ctrl-C some seconds after it printed `ready`."""
    folder = __file__.rsplit("/", 1)[0]
    process = subprocess.Popen(
        [sys.executable, "-c", HEAD.format(folder=folder) + code],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    assert process.stdout.readline() == "ready\n"
    time.sleep(after)
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=120)
    return said


def test_ctrl_c_gives_the_results_so_far():
    said = interrupted(
        f"""
warnings.simplefilter("always")
scene.run(paths=256)
print("ready", flush=True)
result = scene.run(paths=256, {LONG})
print(result.run.stop, result.run.paths >= 256, result["absorbed_flux"]["PAR"].values.min() > 0)
""",
        after=3.0,
    )
    assert "interrupted True True" in said
    assert "QuasimcWarning: interrupted" in said


def test_ctrl_c_before_there_is_a_result_is_a_keyboard_interrupt():
    said = interrupted(
        """
print("ready", flush=True)
try:
    scene.run(paths=1 << 21, accelerator="brute_force", method="light_tracing")
except KeyboardInterrupt:
    print("KeyboardInterrupt")
print(scene.run(paths=256).run.stop)
""",
        after=1.0,
    )
    assert said.split() == ["KeyboardInterrupt", "finished"]


def test_ctrl_c_ends_the_growth_of_a_plant(tmp_path):
    model = tmp_path / "model.l"
    model.write_text("lsystem: 1\nderivation length: 9\naxiom: ?E(1)F(1)\nendlsystem\n")
    said = interrupted(
        f"""
steps = quasimc.grow({str(model)!r}, light=scene, {LONG})
print("ready", flush=True)
try:
    next(steps)
except KeyboardInterrupt:
    print("KeyboardInterrupt", len(list(steps)))
""",
        after=2.0,
    )
    assert said.split() == ["KeyboardInterrupt", "0"]
