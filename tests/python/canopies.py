"""Scenes for the tests."""

import numpy as np

import quasimc

FEW = {"paths": 1024, "replicates": 4}
#: Night, and a morning.
DAY = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[2, 12], step_minutes=120)


def leaves(count, seed=7):
    """Random leaves of two triangles each: vertices (4 n, 3), faces (2 n, 3), organ (2 n,)."""
    draw = np.random.default_rng(seed)
    corner = draw.uniform(0, 1, (count, 3)) + [0, 0, 1]
    along, across = draw.normal(0, 0.1, (2, count, 3))
    vertices = np.stack([corner, corner + along, corner + along + across, corner + across], axis=1)
    first = 4 * np.arange(count)[:, None]
    faces = np.concatenate([first + [[0, 1, 2]], first + [[0, 2, 3]]], axis=1).reshape(-1, 3)
    return vertices.reshape(-1, 3), faces, np.repeat(np.arange(1, count + 1), 2)


def canopy(count=20):
    """Leaves over soil, with a sun and a sky, in two bands."""
    scene = quasimc.Scene(["PAR", "NIR"])
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    scene.add_material("soil", reflectance=[0.1, 0.2])
    vertices, faces, organ = leaves(count)
    scene.add_mesh(vertices, faces, organ=organ, material="leaf", labels={"plant": 1})
    scene.ground = quasimc.Ground("soil", x=[-1, 2], y=[-1, 2])
    scene.sources.append(quasimc.sun(azimuth_deg=135, elevation_deg=50, irradiance_facing=[400, 380]))
    scene.sources.append(quasimc.sky(irradiance_horizontal=[80, 20]))
    return scene


def stand(par="umol m-2 s-1"):
    """Leaves over soil in two bands, with sensors and a detector."""
    bands = {"PAR": par, "NIR": "W m-2"}
    scene = quasimc.Scene(bands, length_unit="m", site=quasimc.Site(52, 5.7))
    scene.add_material("leaf", reflectance=[0.08, 0.45], transmittance=[0.06, 0.45])
    scene.add_material("soil", reflectance=[0.1, 0.2])
    vertices, faces, organ = leaves(12)
    scene.add_mesh(vertices, faces, organ=organ, material="leaf", labels={"plant": 1})
    scene.ground = quasimc.Ground("soil", x=[-1, 2], y=[-1, 2])
    scene.add_sensors([[0.2, 0.2, 0.5], [0.4, 0.2, 0.5], [0.6, 0.2, 0.5]], name="bench")
    scene.add_detector("escaped_by_zenith", name="up")
    return scene
