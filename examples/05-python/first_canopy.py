"""Five hundred leaves over soil, under sun and sky: their light, and that of layers."""

from typing import Tuple

import numpy as np
from numpy.typing import NDArray

import quasimc


Floats = NDArray[np.float64]
Integers = NDArray[np.int64]


def leaves(count: int, seed: int = 1) -> Tuple[Floats, Integers, Integers]:
    """Square leaves in a cube of 1 m: vertices (4 n, 3), faces (2 n, 3), the organ of each face."""
    draw = np.random.default_rng(seed)
    corner = draw.uniform(0, 1, (count, 3))
    along, across = draw.normal(0, 0.04, (2, count, 3))
    vertices = np.stack([corner, corner + along, corner + along + across, corner + across], axis=1)
    faces = 4 * np.arange(count)[:, None, None] + np.array([[0, 1, 2], [0, 2, 3]])
    return vertices.reshape(-1, 3), faces.reshape(-1, 3), np.repeat(np.arange(1, count + 1), 2)


def main() -> None:
    vertices, faces, organ = leaves(500)
    vertices[:, 2] += 0.2  # above the soil
    scene = quasimc.Scene("PAR", irradiance_unit="umol m-2 s-1")
    scene.add_material("leaf", reflectance=0.08, transmittance=0.06)
    scene.add_material("soil", reflectance=0.12)
    scene.add_mesh(vertices, faces, organ=organ, material="leaf", labels={"kind": "leaf"})
    scene.ground = quasimc.Ground("soil")
    scene.cell = quasimc.Cell(x=[0, 1], y=[0, 1])
    sun = quasimc.sun(azimuth_deg=135, elevation_deg=50, irradiance_facing=1500)
    sky = quasimc.sky("cie_overcast", irradiance_horizontal=250)
    result = scene.run([sun, sky], paths=8192, layers=5)

    print(result)
    absorbed = result["absorbed_flux"]["PAR"]
    mean, error = absorbed.values[0], absorbed.standard_error[0]
    print(f"leaf 1 absorbs {mean:.4f} +- {error:.4f} {absorbed.unit}")
    for group, light in zip(result.groups.groups, result.groups["absorbed_flux"]["PAR"].values):
        name = f"{group['by']} {group['value']}"
        print(f"{name:>8}: area {group['area']:.3f} m2, absorbed {light:.2f}")


if __name__ == "__main__":
    main()
