"""A maize crop in the course of a day: the run file of the fourth example at other times."""

from pathlib import Path

import quasimc

RUN_FILE = Path(__file__).parent.parent / "04-first-canopy" / "maize.toml"


def main() -> None:
    scene = quasimc.load(RUN_FILE)
    hours = quasimc.day("2024-06-21", utc_offset_hours=2, hours=[6, 22], step_minutes=120)
    series = scene.series(hours, paths=1024)
    for time_step, result in zip(series.times, series):
        light = result.groups["absorbed_flux"].values[0]
        print(time_step["time"], *(f"{band} {x:8.3f}" for band, x in zip(result.bands, light)))
    groups = series.days["2024-06-21"].groups
    assert groups is not None
    total = groups["absorbed_flux"]  # group 0: all organs, without the ground
    print("the day:", *(f"{b} {total[b].values[0]:.3g} {total[b].unit}" for b in total.bands))


if __name__ == "__main__":
    main()
