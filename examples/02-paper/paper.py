#!/usr/bin/env python3
"""The experiment of Cieslak, Lemieux, Hanan and Prusinkiewicz (2008), beside the numbers of their paper.

  PYTHONPATH=build/release/python examples/02-paper/paper.py [--out FOLDER] [--replicates 10]
                                  [--paths 65536] [--target 0.01]

Writes the data of the paper's figure 3 to FOLDER (default: beside this script):
  irradiance.csv  depth and absorbed flux density of every leaf, and the fitted curve A exp(-lambda x)
  variance.csv    depth and variance of every leaf for Monte Carlo and randomized quasi-Monte Carlo, and fits
x is the depth of a leaf's centre below the top of the canopy, in units of the canopy's height.
Draws the figure there by matplotlib, as .png and .svg:
  figure3-irradiance light on every leaf, leaves counted from the top, with a fitted curve
  figure3-variance   its variance with Monte Carlo and randomized quasi-Monte Carlo, with fitted curves
Last it prints how long each way of computing takes until the error of a leaf is 1 % of the mean.
"""

import argparse
import csv
import pathlib
import sys

import matplotlib
import numpy as np

import quasimc
from quasimc.plotting import fit_exponential

matplotlib.use("agg")
HERE = pathlib.Path(__file__).resolve().parent
PAPER_PATHS = 65536


def experiments(paths):
    """Name, sampler, paths, start area and the paper's mean variance x 1e-5 (None: not in the paper)."""
    rows = [
        ("Monte Carlo", "monte_carlo", paths, "bounding_sphere", 75.46),
        ("Korobov", "korobov", paths, "bounding_sphere", 9.37),
        ("Korobov", "korobov", paths // 4, "bounding_sphere", 67.39),
        ("Sobol'", "sobol", paths, "bounding_sphere", None),
        ("Monte Carlo", "monte_carlo", paths, "silhouette", None),
        ("Korobov", "korobov", paths, "silhouette", None),
        ("Sobol'", "sobol", paths, "silhouette", None),
    ]
    for name, sampler, count, start_area, paper in rows:
        suffix = f"{count:,} paths" if start_area == "bounding_sphere" else "our start of rays"
        yield f"{name}, {suffix}", sampler, count, start_area, paper if paths == PAPER_PATHS else None


# name, method, sampler: each until the error of a leaf is small enough
WAYS = [
    ("Monte Carlo", "light_tracing", "monte_carlo"),
    ("Korobov", "light_tracing", "korobov"),
    ("lit surfaces, Sobol'", "first_hits", "sobol"),
    ("ray bundles", "ray_bundles", "sobol"),
]


def leaf_depths(organs):
    """Depth of each leaf's centre below the highest corner, relative to the canopy's height."""
    heights = np.stack([organs.triangles(i)[0, :, 2] for i in range(len(organs))])
    return (heights.max() - heights.mean(axis=1)) / (heights.max() - heights.min())


def light_of(result):
    return result["absorbed_flux_density"]["PAR"]


def variances_of(result):
    """Variance of every leaf's absorbed flux density, between replicates."""
    return result.run.replicates * np.nan_to_num(light_of(result).standard_error) ** 2


def run_to_error(scene, method, sampler, replicates, target):
    """Paths, error (root mean square over leaves, over their mean) and CPU seconds of the first run, paths doubled from
    256 on, with an error of at most target. Light paths start in the scene's silhouette; the error of ray bundles holds
    that of their patches."""
    for paths in (256 << i for i in range(22)):
        result = scene.run(method=method, sampler=sampler, paths=paths, start_area="silhouette", replicates=replicates,
                           threads=1)
        light = light_of(result)
        error = np.sqrt(np.mean(light.standard_error**2)) / light.values.mean()
        if error <= target:  # not where it is NaN: some leaf was not found
            return paths, error, result.run.solve_cpu_seconds
    sys.exit(f"{method}: the error is not reached")


def draw_figures(results, out, note):
    """The paper's figure 3, light and variance of each leaf, as PNG and SVG."""
    for name, variance in (("figure3-irradiance", False), ("figure3-variance", True)):
        axes = None
        for label, result in results.items():
            axes = result.plot.light_by_index(variance=variance, ax=axes, label=label)
        axes.set_title(note, fontsize=9)
        axes.figure.set_size_inches(9, 6.4)
        for suffix in ("png", "svg"):
            axes.figure.savefig(out / f"{name}.{suffix}", dpi=100, bbox_inches="tight")


def write_data(path, depths, columns):
    """The columns, and of each the fitted curve. Returns the curves."""
    fits = [fit_exponential(depths, column) for column in columns.values()]
    with open(path, "w", newline="") as file:
        for name, (a, rate) in zip(columns, fits):
            file.write(f"# {name}: fitted A exp(-lambda x) with A = {a:.6g}, lambda = {rate:.4g}\n")
        writer = csv.writer(file)
        writer.writerow(["leaf", "depth", *columns, *(f"{name}_fitted" for name in columns)])
        for i, depth in enumerate(depths):
            fitted = [a * np.exp(-rate * depth) for a, rate in fits]
            writer.writerow([i + 1, f"{depth:.6f}", *(f"{c[i]:.6g}" for c in columns.values()),
                             *(f"{f:.6g}" for f in fitted)])
    return fits


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    parser.add_argument("--replicates", type=int, default=10)
    parser.add_argument("--paths", type=int, default=PAPER_PATHS, help="of a replicate (default: the paper's)")
    parser.add_argument("--target", type=float, default=0.01, help="error of a leaf until which times are taken")
    arguments = parser.parse_args()
    out, replicates, target = arguments.out, arguments.replicates, arguments.target
    out.mkdir(parents=True, exist_ok=True)
    scene = quasimc.load(HERE / "paper.toml")

    results = {}
    print("Variance of the absorbed flux density per leaf x 1e-5, mean over 500 leaves (standard deviation)")
    print(f"  {'':32} {'ours':>18} {'paper':>8}")
    for name, sampler, paths, start_area, paper in experiments(arguments.paths):
        results[name] = scene.run(sampler=sampler, paths=paths, start_area=start_area, replicates=replicates)
        variances = 1e5 * variances_of(results[name])
        print(f"  {name:32} {variances.mean():9.2f} ({variances.std():6.2f}) {paper if paper else '':>8}")

    both = {name: results[f"{name}, {arguments.paths:,} paths"] for name in ("Monte Carlo", "Korobov")}
    depths = leaf_depths(scene.organs)
    (a, rate), = write_data(out / "irradiance.csv", depths, {"irradiance": light_of(both["Korobov"]).values})
    print(f"Absorbed flux density over depth x: {a:.3f} exp(-{rate:.2f} x)")
    write_data(out / "variance.csv", depths, {name.lower().replace(" ", "_"): variances_of(result)
                                              for name, result in both.items()})
    draw_figures(both, out, f"{arguments.paths:,} paths, {replicates} randomizations")
    print(f"Wrote to {out}: irradiance.csv, variance.csv, figure3-irradiance and figure3-variance (.png, .svg)")
    print(f"CPU time until the error of a leaf is {100 * target:g} % of the mean, {replicates} replicates together")
    for name, method, sampler in WAYS:
        paths, error, seconds = run_to_error(scene, method, sampler, replicates, target)
        print(f"  {name:32} {1000 * seconds:9.1f} ms ({100 * error:.2f} %, {paths:,} paths)")


if __name__ == "__main__":
    main()
