"""A script for Caribu: only the import differs; --caribu runs Caribu itself."""

import random
import sys

if "--caribu" in sys.argv:
    from openalea.caribu.CaribuScene import CaribuScene  # type: ignore
else:
    from quasimc.compat.caribu.CaribuScene import CaribuScene


def main() -> None:
    draw = random.Random(2)
    scene = {}
    for pid in range(1, 21):
        x, y, z = draw.uniform(0, 0.9), draw.uniform(0, 0.9), draw.uniform(0.1, 1)
        scene[pid] = [[(x, y, z), (x + 0.1, y, z + 0.02), (x, y + 0.1, z)]]
    cs = CaribuScene(
        scene,
        light=[(300, (0, -0.5, -1)), (100, (0, 0, -1))],
        pattern=(0, 0, 1, 1),
        opt={"PAR": (0.08, 0.06), "NIR": (0.45, 0.45)},
        soil_reflectance={"PAR": 0.12, "NIR": 0.2},
    )
    raw, aggregated = cs.run(direct=False, infinite=True)
    for band, light in aggregated.items():
        for pid in (1, 2, 3):
            error = light.get("Eabs_se", {}).get(pid)
            known = "" if error is None else f"+- {error:.2f}"
            print(band, pid, f"Eabs {light['Eabs'][pid]:.2f}", known)


if __name__ == "__main__":
    main()
