"""Time of sums and arithmetic of light in Python, against numpy on numbers of the same size.

    PYTHONPATH=build/release/python python3 bench/python/sums.py [--organs 100000] [--replicates 16]

The floor of a sum is numpy's weighted sum over the four numbers (direct and scattered light on both
sides) that a run keeps of an organ in each replicate; that of arithmetic is numpy's on the
replicates of both terms, with their mean and standard error. Each time is the shortest of several.
"""

import argparse
import time

import numpy as np
import quasimc

REPEATS = 7


def best(call):
    """The shortest time of a call in seconds."""
    times = []
    for _ in range(REPEATS):
        start = time.perf_counter()
        call()
        times.append(time.perf_counter() - start)
    return min(times)


def results(organs, replicates):
    """Two results of a canopy of triangles, of other materials."""
    draw = np.random.default_rng(1)
    corner = draw.uniform(0, 20, (organs, 1, 3)) * [1, 1, 0.1] + [0, 0, 0.5]
    triangles = corner + draw.normal(0, 0.05, (organs, 3, 3))
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1, transmittance=0.05)
    scene.add_mesh(triangles, material="leaf", organ=np.arange(1, organs + 1))
    scene.sources.append(quasimc.sky(irradiance_horizontal=100))
    run = {"method": "light_tracing", "paths": 4096, "replicates": replicates, "keep": "replicates"}
    first = scene.run(**run)
    scene.materials["leaf"].reflectance = 0.2
    return first, scene.run(**run)


def cases(a, b, mask):
    """Name -> call on light."""
    x, y = (result["absorbed_flux"]["PAR"] for result in (a, b))
    return {
        "result.sum(mask)": lambda: a.sum("absorbed_flux", mask),
        "light.sum()": lambda: x.sum(),
        "light.sum(weights)": lambda: x.sum(weights=mask - 0.5),
        "30 * a - 31 * b": lambda: (30 * x - 31 * y).standard_error,
        "(30 * a - 31 * b).sum()": lambda: (30 * x - 31 * y).sum(),
        "a / b": lambda: (x / y).standard_error,
    }


def floors(organs, replicates, mask):
    """Name -> numpy's call on as many numbers."""
    draw = np.random.default_rng(2)
    kept = draw.random((replicates, organs, 4))
    x, y = draw.random((2, replicates, organs))
    weights = mask.astype(float)

    def total():
        sums = np.einsum("rnk,n->r", kept, weights)
        return sums.mean(), sums.std(ddof=1)

    def arithmetic(of=lambda x, y: 30 * x - 31 * y):
        made = of(x, y)
        return made.mean(axis=0), made.std(axis=0, ddof=1)

    return {
        "result.sum(mask)": total,
        "light.sum()": total,
        "light.sum(weights)": total,
        "30 * a - 31 * b": arithmetic,
        "(30 * a - 31 * b).sum()": arithmetic,
        "a / b": lambda: arithmetic(lambda x, y: x / y),
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--organs", type=int, default=100_000)
    parser.add_argument("--replicates", type=int, default=16)
    given = parser.parse_args()
    mask = np.arange(given.organs) % 3 == 0
    a, b = results(given.organs, given.replicates)
    start = time.perf_counter()
    a["absorbed_flux"]["PAR"].sum()
    first = time.perf_counter() - start
    calls = cases(a, b, mask)
    numpys = floors(given.organs, given.replicates, mask)
    print(f"{given.organs:,} organs, {given.replicates} replicates; milliseconds; the first sum took {1e3 * first:.0f}")
    print(f"{'':26}{'quasimc':>9}{'numpy':>9}{'ratio':>8}")
    for name, call in calls.items():
        with np.errstate(divide="ignore", invalid="ignore"):
            own, floor = 1e3 * best(call), 1e3 * best(numpys[name])
        print(f"{name:26}{own:9.2f}{floor:9.2f}{own / floor:8.2f}")


if __name__ == "__main__":
    main()
