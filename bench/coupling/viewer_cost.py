#!/usr/bin/env python3
"""The cost of a viewer for a growing plant: viewer_cost.py QUASIMC_ENVIRONMENT [--leaves N] [...]

A plant grows continuously, in turns without a viewer, with one that has no page open, and with one
that a page follows. Prints medians over the repeats: processor time of the light program and wall-
clock time, each per step, and the cost of a viewer. The follower is a separate process, but takes
its share of a machine with few processors.
"""

import argparse
import http.client
import json
import math
import os
import statistics
import subprocess
import tempfile
import threading
import time
import urllib.request
from pathlib import Path

COMM = """communication type: pipes
turtle position: %f %f %f
turtle heading: %f %f %f
turtle left: %f %f %f
turtle up: %f %f %f
following module: yes
"""
KINDS = ("without", "unseen", "followed")
GOLDEN_ANGLE = 2.399963229728653


def message(leaves, step):
    """Returns leaves around a stem, a little larger in every step."""
    width = leaves ** (1 / 3)
    text = []
    for i in range(leaves):
        part = i / leaves
        c, s = math.cos(GOLDEN_ANGLE * i), math.sin(GOLDEN_ANGLE * i)
        r = width * math.sqrt(part * 97 % 1)
        text.append(
            f"{i} E(1)P({0.2 + 0.001 * step:g},0.5)\n {r * c:g} {part * width:g} {r * s:g}\n"
            f" {0.866025 * c:g} 0.5 {0.866025 * s:g}\n {-s:g} 0 {c:g}\n"
            f" {0.5 * c:g} -0.866025 {0.5 * s:g}\n"
        )
    return ("".join(text) + f"Control: 5 {step}\n").encode()


def follow(address, ended):
    """Requests what a page requests: news, and the data that it shows of the newest step."""

    def ask(name):
        with urllib.request.urlopen(address + name, timeout=10) as answer:
            return answer.read()

    shown = scene = None
    while not ended.is_set():
        try:
            frames = json.loads(ask("live"))["frames"]
            if frames and frames[-1]["number"] != shown:
                newest = frames[-1]
                shown = newest["number"]
                if newest["scene"] != scene:
                    scene = newest["scene"]
                    ask(f"scene-{scene}")
                    ask(f"shape-{scene}")
                key = f"{shown}-{newest['version']}"
                ask(f"light-{key}")
                ask(f"values-{key}-0")
        except (OSError, http.client.HTTPException):  # it has ended
            return
        ended.wait(0.4)


def read_answers(stream):
    """Reads up to the end of the last chunk."""
    for line in stream:
        if line.startswith(b"Control:") and int(line.split()[1]) & 4:
            return
    raise SystemExit("viewer_cost.py: the light program has ended")


def measure(program, messages, kind):
    """Returns processor time of the light program, and wall-clock time, per step."""
    words = [] if kind == "without" else ["--view"]
    child = subprocess.Popen(
        [program, "-e", "comm.e", *words, "light.qmc"],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )
    ended = threading.Event()
    looker = None
    child.stdout.read(1)
    if kind != "without":
        line = ""
        while "view: " not in line:
            line = child.stderr.readline().decode()
        address = line.split("view: ")[1].strip()
        if kind == "followed":
            looker = threading.Thread(target=follow, args=(address, ended))
            looker.start()
    start = time.perf_counter()
    for text in messages:
        writer = threading.Thread(target=lambda: (child.stdin.write(text), child.stdin.flush()))
        writer.start()
        read_answers(child.stdout)
        writer.join()
    clock = time.perf_counter() - start
    child.stdin.write(b"Control: 8 0\n")
    child.stdin.close()
    child.stdout.read()
    _, status, used = os.wait4(child.pid, 0)
    child.returncode = status
    ended.set()
    if looker:
        looker.join()
    return (used.ru_utime + used.ru_stime) / len(messages), clock / len(messages)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("--leaves", type=int, default=10000)
    parser.add_argument("--paths", type=int, default=262144)
    parser.add_argument("--steps", type=int, default=30)
    parser.add_argument("--repeats", type=int, default=5)
    arguments = parser.parse_args()
    program = str(Path(arguments.program).resolve())
    messages = [message(arguments.leaves, step) for step in range(arguments.steps)]
    found = {kind: [] for kind in KINDS}
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        Path("comm.e").write_text(COMM)
        Path("light.qmc").write_text(
            f"return type: D\nnumber of rays: {arguments.paths}\nnumber of runs: 2\nverbose: 0\n"
        )
        for _ in range(arguments.repeats):
            for kind in KINDS:
                found[kind].append(measure(program, messages, kind))
        os.chdir("/")
    print(f"{arguments.leaves} leaves, {arguments.steps} steps, medians of {arguments.repeats}:")
    for kind in KINDS:
        cpu, clock = (statistics.median(values) for values in zip(*found[kind]))
        # Compares a viewer with the run just before: other programs disturb both alike.
        added = [
            100 * (statistics.median(one[k] / other[k] for one, other in zip(found[kind], found["without"])) - 1)
            for k in (0, 1)
        ]
        print(
            f"{kind:8}  processor {1e3 * cpu:7.1f} ms a step ({added[0]:+.1f} %), "
            f"clock {1e3 * clock:7.1f} ms ({added[1]:+.1f} %)"
        )


if __name__ == "__main__":
    main()
