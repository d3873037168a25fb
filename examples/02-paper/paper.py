#!/usr/bin/env python3
"""Repeats the experiment of Cieslak, Lemieux, Hanan and Prusinkiewicz (2008) and prints its numbers beside ours.

Usage: examples/02-paper/paper.py [--program build/release/bin/quasimc] [--out FOLDER] [--replicates 10] [--paths 65536]
                                  [--target 0.01] [--figures]

Writes the data of the paper's two figures to FOLDER (default: beside this script):
  irradiance.csv  depth and absorbed flux density of every leaf, and the fitted curve A exp(-lambda x)
  variance.csv    depth and variance of every leaf for Monte Carlo and randomized quasi-Monte Carlo, and fits
x is the depth of a leaf's centre below the top of the canopy, in units of the canopy's height.
Draws the figures there as well, each as .png and .svg:
  figure2            the canopy, its leaves shaded by the light that they absorb
  figure3-irradiance light on every leaf, leaves counted from the top, with a fitted curve
  figure3-variance   its variance with Monte Carlo and randomized quasi-Monte Carlo, with fitted curves
Last it prints how long each way of computing takes until the error of a leaf is 1 % of the mean.
"""

import argparse
import csv
import json
import math
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent

PAPER_PATHS = 65536


def experiments(paths):
    """Name, sampler, paths, window and the paper's mean variance x 1e-5 (None: not in the paper)."""
    rows = [
        ("Monte Carlo", "monte_carlo", paths, "sphere", 75.46),
        ("Korobov", "korobov", paths, "sphere", 9.37),
        ("Korobov", "korobov", paths // 4, "sphere", 67.39),
        ("Sobol'", "sobol", paths, "sphere", None),
        ("Monte Carlo", "monte_carlo", paths, "silhouette", None),
        ("Korobov", "korobov", paths, "silhouette", None),
        ("Sobol'", "sobol", paths, "silhouette", None),
    ]
    for name, sampler, count, window, paper in rows:
        suffix = f"{count:,} paths" if window == "sphere" else "our start of rays"
        yield f"{name}, {suffix}", sampler, count, window, paper if paths == PAPER_PATHS else None


# name, method, sampler: each until the error of a leaf is small enough
WAYS = [
    ("Monte Carlo", "light_tracing", "monte_carlo"),
    ("Korobov", "light_tracing", "korobov"),
    ("lit surfaces, Sobol'", "first_hits", "sobol"),
    ("ray bundles", "ray_bundles", "sobol"),
]


def leaf_depths(path):
    """Depth of each triangle's centre below the highest corner, relative to the canopy's height."""
    rows = [[float(x) for x in line.split()] for line in path.read_text().splitlines()
            if line.strip() and not line.startswith("#")]
    heights = [z for row in rows for z in row[2::3]]
    top, size = max(heights), max(heights) - min(heights)
    return [(top - sum(row[2::3]) / 3) / size for row in rows]


def run(program, sampler, paths, window, replicates):
    """Mean and variance over replicates of the absorbed flux density of every leaf."""
    command = [program, "run", str(HERE / "paper.toml"), "--sampler", sampler, "--paths", str(paths),
               "--window", window, "--replicates", str(replicates), "--csv", "-"]
    output = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = [line for line in output.splitlines() if not line.startswith("#")]
    means, variances = [], []
    for row in csv.DictReader(lines):
        error = row["absorbed_flux_density_PAR_se"]
        means.append(float(row["absorbed_flux_density_PAR"]))
        variances.append(replicates * float(error) ** 2 if error else 0.0)
    return means, variances


def run_to_error(program, method, sampler, replicates, target):
    """Paths, error (root mean square over leaves, over their mean) and CPU seconds of the first run, paths doubled from
    256 on, with an error of at most target. Light paths start in the scene's silhouette; the error of ray bundles holds
    that of their patches."""
    with tempfile.TemporaryDirectory() as folder:
        for paths in (256 << i for i in range(22)):
            path = pathlib.Path(folder) / "result.json"
            command = [program, "run", str(HERE / "paper.toml"), "--method", method, "--sampler", sampler, "--paths",
                       str(paths), "--window", "silhouette", "--replicates", str(replicates), "--threads", "1",
                       "--json", str(path), "--csv", str(path.with_suffix(".csv")), "--quiet"]
            subprocess.run(command, check=True)
            result = json.loads(path.read_text())
            leaves = [organ["absorbed_flux_density"]["PAR"] for organ in result["organs"]]
            if any(leaf["standard_error"] is None for leaf in leaves):
                continue  # some leaf was not found
            square = statistics.fmean(leaf["standard_error"] ** 2 for leaf in leaves)
            error = math.sqrt(square) / statistics.fmean(leaf["mean"] for leaf in leaves)
            if error <= target:
                return paths, error, result["seconds"]["trace_cpu"]
    sys.exit(f"{method}: the error is not reached")


def write_result(program, path, sampler, paths, replicates):
    """The whole result of the experiment with a sampler, for pictures."""
    subprocess.run([program, "run", str(HERE / "paper.toml"), "--sampler", sampler, "--paths", str(paths), "--replicates",
                    str(replicates), "--json", str(path), "--csv", str(path.with_suffix(".csv")), "--quiet"], check=True)


def draw_figures(program, out, paths, replicates):
    """The paper's figures 2 and 3, each as PNG and SVG."""
    with tempfile.TemporaryDirectory() as folder:
        monte_carlo, korobov = (pathlib.Path(folder) / name for name in ("Monte_Carlo.json", "Korobov.json"))
        write_result(program, monte_carlo, "monte_carlo", paths, replicates)
        write_result(program, korobov, "korobov", paths, replicates)
        figures = {
            "figure2": [korobov, "--opening", "20"],
            "figure3-irradiance": [monte_carlo, "--chart", "organs", "--with", korobov, "--note",
                                   f"{paths:,} paths, {replicates} randomizations, 95 % intervals; mean by the original program "
                                   "0.215"],
            "figure3-variance": [monte_carlo, "--chart", "organs", "--variance", "--with", korobov, "--note",
                                 f"{paths:,} paths, {replicates} randomizations; mean in the paper: Monte Carlo 0.0007546, "
                                 "randomized QMC 0.0000937"],
        }
        for name, words in figures.items():
            for suffix in ("png", "svg"):
                subprocess.run([program, "show", *map(str, words), "--size", "900x640", "-o",
                                str(out / f"{name}.{suffix}")], check=True)
    return list(figures)


def fit_exponential(x, y):
    """A and lambda of the curve A exp(-lambda x) with the least squared deviations (Gauss-Newton)."""
    a, rate = max(statistics.fmean(y) * 2, 1e-300), 1.0
    for _ in range(100):
        curve = [math.exp(-rate * t) for t in x]
        da = curve
        dr = [-a * t * c for t, c in zip(x, curve)]
        residual = [v - a * c for v, c in zip(y, curve)]
        aa, ar, rr = (sum(p * q for p, q in zip(u, v)) for u, v in ((da, da), (da, dr), (dr, dr)))
        ga, gr = (sum(p * q for p, q in zip(u, residual)) for u in (da, dr))
        determinant = aa * rr - ar * ar
        if determinant == 0:
            break
        a += (ga * rr - gr * ar) / determinant
        rate += (gr * aa - ga * ar) / determinant
    return a, rate


def write_figure(path, header, depths, columns):
    fits = [fit_exponential(depths, column) for column in columns]
    with open(path, "w", newline="") as file:
        for name, (a, rate) in zip(header, fits):
            file.write(f"# {name}: fitted A exp(-lambda x) with A = {a:.6g}, lambda = {rate:.4g}\n")
        writer = csv.writer(file)
        writer.writerow(["leaf", "depth", *header, *(f"{name}_fitted" for name in header)])
        for i, depth in enumerate(depths):
            fitted = [a * math.exp(-rate * depth) for a, rate in fits]
            writer.writerow([i + 1, f"{depth:.6f}", *(f"{c[i]:.6g}" for c in columns),
                             *(f"{f:.6g}" for f in fitted)])
    return fits


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--program", default=str(HERE.parents[1] / "build/release/bin/quasimc"))
    parser.add_argument("--out", type=pathlib.Path, default=HERE)
    parser.add_argument("--replicates", type=int, default=10)
    parser.add_argument("--paths", type=int, default=PAPER_PATHS, help="of a replicate (default: the paper's)")
    parser.add_argument("--figures", action="store_true", help="draw the figures alone")
    parser.add_argument("--target", type=float, default=0.01, help="error of a leaf until which times are taken")
    arguments = parser.parse_args()
    if not pathlib.Path(arguments.program).exists():
        sys.exit(f"{arguments.program}: not there; run ./dev build first, or name it with --program")
    arguments.out.mkdir(parents=True, exist_ok=True)

    if arguments.figures:
        draw_figures(arguments.program, arguments.out, arguments.paths, arguments.replicates)
        return

    depths = leaf_depths(HERE.parent / "01-leaves/leaves.tri")
    results = {}
    print("Variance of the absorbed flux density per leaf x 1e-5, mean over 500 leaves (standard deviation)")
    print(f"  {'':32} {'ours':>18} {'paper':>8}")
    for name, sampler, paths, window, paper in experiments(arguments.paths):
        means, variances = run(arguments.program, sampler, paths, window, arguments.replicates)
        results[name] = (means, variances)
        mean, deviation = 1e5 * statistics.fmean(variances), 1e5 * statistics.pstdev(variances)
        print(f"  {name:32} {mean:9.2f} ({deviation:6.2f}) {paper if paper else '':>8}")

    reference = results[f"Korobov, {arguments.paths:,} paths"][0]
    (a, rate), = write_figure(arguments.out / "irradiance.csv", ["irradiance"], depths, [reference])
    print(f"Absorbed flux density over depth x: {a:.3f} exp(-{rate:.2f} x)")
    write_figure(arguments.out / "variance.csv", ["monte_carlo", "korobov"], depths,
                 [results[f"{name}, {arguments.paths:,} paths"][1] for name in ("Monte Carlo", "Korobov")])
    figures = draw_figures(arguments.program, arguments.out, arguments.paths, arguments.replicates)
    print(f"Wrote to {arguments.out}: irradiance.csv, variance.csv, and as .png and .svg {', '.join(figures)}")
    print(f"CPU time until the error of a leaf is {100 * arguments.target:g} % of the mean, {arguments.replicates} replicates together")
    for name, method, sampler in WAYS:
        paths, error, seconds = run_to_error(arguments.program, method, sampler, arguments.replicates,
                                             arguments.target)
        print(f"  {name:32} {1000 * seconds:9.1f} ms ({100 * error:.2f} %, {paths:,} paths)")


if __name__ == "__main__":
    main()
