"""Days, materials and one large run, each divided over two processes."""

from __future__ import annotations

from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import quasimc

RUN_FILE = Path(__file__).parent.parent / "04-first-canopy" / "maize.toml"
SKY = quasimc.sky("cie_clear", azimuth_deg=180, elevation_deg=60, irradiance_horizontal=400)
PARTS = 4


def light_of_day(date: str) -> quasimc.Series:
    times = quasimc.day(date, utc_offset_hours=2, step_minutes=120)
    return quasimc.load(RUN_FILE).series(times, paths=256, threads=1)


def light_with_leaves(reflectance: float) -> quasimc.Result:
    scene = quasimc.load(RUN_FILE)
    scene.materials["leaf"].set(reflectance=reflectance)
    return scene.run(SKY, paths=1024, threads=1)  # with the seed of all


def part_of_run(index: int) -> quasimc.Part:
    return quasimc.load(RUN_FILE).part(index, PARTS, SKY, paths=1024, threads=1)


def main() -> None:
    dates = ["2024-05-21", "2024-06-21", "2024-07-21"]
    reflectances = [0.06, 0.08, 0.1]
    with ProcessPoolExecutor(2) as pool:
        days = list(pool.map(light_of_day, dates))
        results = list(pool.map(light_with_leaves, reflectances))
        merged = quasimc.merge(pool.map(part_of_run, range(PARTS)))

    for date, series in zip(dates, days):
        groups = series.days[date].groups
        assert groups is not None
        light = groups["absorbed_flux"]["PAR"]  # group 0: all organs
        print(date, light.values[0], light.unit)
    for reflectance, result in zip(reflectances[1:], results[1:]):
        change = (result["absorbed_flux"]["PAR"] - results[0]["absorbed_flux"]["PAR"]).sum()
        print(f"reflectance {reflectance}: {result.sum('absorbed_flux')['PAR']}, change {change}")
    print("of parts", merged.sum("absorbed_flux")["PAR"])
    print("the same bits as one run:", merged == results[1])


if __name__ == "__main__":
    main()
