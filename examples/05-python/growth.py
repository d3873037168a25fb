"""A plant that grows by the light it absorbs: a leaf a step, each as long as light allows."""

import numpy as np
from numpy.typing import NDArray

import quasimc


def leaf(height: float, heading: float, length: float) -> NDArray[np.float64]:
    """Two triangles of a leaf that points up and outward: (2, 3, 3)."""
    out = np.array([np.cos(heading), np.sin(heading), 0.5]) * length
    side = np.array([-np.sin(heading), np.cos(heading), 0.0]) * 0.15 * length
    base = np.array([0.0, 0.0, height])
    tip, left, right = base + out, base + out / 2 - side, base + out / 2 + side
    return np.array([[base, left, tip], [base, tip, right]])


def main() -> None:
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.08, transmittance=0.06)
    scene.add_material("soil", reflectance=0.15)
    scene.ground = quasimc.Ground("soil")
    scene.cell = quasimc.Cell(x=[-0.15, 0.15], y=[-0.15, 0.15])
    sky = quasimc.sky("cie_overcast", irradiance_horizontal=200)

    lengths: "dict[int, float]" = {}
    for step in range(1, 9):
        lengths[step] = 0.05
        scene.add_mesh(leaf(0.02 * step, 2.4 * step, 0.05), material="leaf", organ=step)
        result = scene.run(sky, paths=2048)
        light = result.at(list(lengths))["absorbed_flux_density"]["PAR"].values
        for organ, absorbed in zip(lengths, light):
            lengths[organ] *= 1 + 0.001 * float(absorbed)
            scene.organs.replace(organ, leaf(0.02 * organ, 2.4 * organ, lengths[organ]))
        print(f"step {step}: the lengths are", *(f"{x:.3f}" for x in lengths.values()))


if __name__ == "__main__":
    main()
