"""The interface of Caribu, by what is published of its behaviour."""

import math
import warnings

import numpy as np
import pytest

import fake_plantgl as plantgl
import quasimc
from quasimc.compat.caribu import CaribuScene_nodes as nodes
from quasimc.compat.caribu import caribu as functions
from quasimc.compat.caribu.CaribuScene import CaribuScene
from quasimc.compat.caribu.caribu import mixed_radiosity, radiosity, raycasting, x_raycasting
from quasimc.compat.caribu.file_adaptor import (
    build_materials,
    read_can,
    read_light,
    read_opt,
    read_pattern,
)
from quasimc.compat.caribu.caribu_star import caribu_star
from quasimc.compat.caribu.label import Label
from quasimc.compat.caribu.light import light_sources, turtle
from quasimc.compat.caribu.sky_tools import GenSky, Gensun, GetLight, GetLightsSun
from quasimc.compat.caribu.sky_tools import spitters_horaire
from quasimc.compat.caribu.plantgl_adaptor import mtg_to_cscene, scene_to_cscene

S = math.sqrt(2)
LEAF = [(0, 0, 0), (S, 0, 0), (0, S, 0)]  # of area 1
HIGHER = [(x, y, 1e-5) for x, y, _ in LEAF]
ZENITH = [(100, (0, 0, -1))]
LOWER_HALF = [(0, 0, 0), (1, 0, 0), (1, 1, 0)]
UPPER_HALF = [(0, 0, 0), (1, 1, 0), (0, 1, 0)]
COVER = [(x, y, 1e-5) for x, y, _ in LOWER_HALF]


def square_scene(**keys):
    scene = {"lower": [LOWER_HALF, UPPER_HALF], "upper": [COVER]}
    return CaribuScene(scene, pattern=(0, 0, 1, 1), **keys)


def test_energy_is_that_on_the_horizontal():
    light = raycasting([LEAF], [(0.06, 0.04)], ZENITH)
    assert light["Ei"][0] == pytest.approx(100, abs=0.01)
    assert light["Eabs"][0] == pytest.approx(90, abs=0.01)
    assert light["Ei_sup"][0] == pytest.approx(100, abs=0.01) and light["Ei_inf"] == [0]
    assert 0 < light["Ei_se"][0] < 0.01
    oblique = raycasting([LEAF], [(0.06, 0.04)], [(70.7, (-1, 0, -1))])
    assert oblique["Ei"][0] == pytest.approx(70.7, abs=0.01)


def test_light_that_is_horizontal_or_from_below_lights_nothing():
    for direction in ((1, 0, 0), (1, 0, 1)):
        assert raycasting([LEAF], [(0.06, 0.04)], [(100, direction)])["Ei"] == [0]
    for direction in ((0, 0, 1), (0, 0, 0)):
        with pytest.raises(functions.CaribuRunError):
            raycasting([LEAF], [(0.06, 0.04)], [(100, direction)])


def test_of_coincident_triangles_the_first_gets_the_light():
    two = [(0.06, 0.04)] * 2
    assert raycasting([LEAF, LEAF], two, ZENITH)["Ei"][1] == 0
    assert radiosity([LEAF, LEAF], two, ZENITH)["Ei"][1] == 0
    lower, upper = raycasting([LEAF, HIGHER], two, ZENITH)["Ei"]
    assert lower == 0 and upper == pytest.approx(100, abs=0.01)


def test_overlapping_triangles_are_a_warning_with_their_pids():
    scene = CaribuScene({"7": [LEAF], "9": [LEAF, HIGHER]}, opt={"PAR": (0.06, 0.07)})
    with pytest.warns(quasimc.QuasimcWarning, match="^pid 9: 1 triangle .*pid 7; there, only that") as caught:
        scene.run()
    assert {each.filename for each in caught} == {__file__}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        scene.run()  # was warned of before
    with pytest.warns(quasimc.QuasimcWarning, match="^triangle 1: .* triangles of triangle 0"):
        raycasting([LEAF, LEAF], [(0.06, 0.04)] * 2, ZENITH)


def test_radiosity_follows_light_through_leaves():
    light = radiosity([LEAF, HIGHER], [(0.06, 0.04)] * 2, ZENITH)
    # 4 are transmitted; each leaf reflects 0.06 to the other.
    between = 4 / (1 - 0.06**2)
    assert light["Ei"][0] == pytest.approx(between, abs=0.02)
    assert light["Eabs"][0] == pytest.approx(0.9 * between, abs=0.02)
    assert light["Ei"][1] == pytest.approx(100 + 0.06 * between, abs=0.1)


def test_flags_of_sides_that_are_not_told():
    opaque = raycasting([LEAF], [(0.1,)], ZENITH)
    assert opaque["Ei_sup"] == opaque["Ei"] and opaque["Ei_inf"] == [-1]
    alike = raycasting([LEAF], [(0.05, 0.05)], ZENITH)
    assert alike["Ei_sup"] == [-1] and alike["Ei_inf"] == [-1]
    four = raycasting([LEAF], [(0.05, 0.01, 0.01, 0.05)], ZENITH)
    assert four["Ei_sup"] == [-1] and four["Eabs"][0] == pytest.approx(94, abs=0.01)


def test_materials_of_four_numbers_have_two_sides():
    up = raycasting([LEAF], [(0.1, 0, 0.2, 0)], ZENITH)
    down = raycasting([reversed(LEAF)], [(0.1, 0, 0.2, 0)], ZENITH)
    assert up["Eabs"][0] == pytest.approx(90, abs=0.01)
    assert down["Eabs"][0] == pytest.approx(80, abs=0.01)
    # Caribu reads 105.8 and 94.0 here.
    assert up["Ei"][0] == pytest.approx(100, abs=0.01)
    assert down["Ei"][0] == pytest.approx(100, abs=0.01)


@pytest.mark.parametrize(
    "null",
    [
        [(0, 0, 0), (0, 0, 0), (1, 0, 0)],
        [(0, 0, 0), (1, 0, 0), (2, 0, 0)],
        [(0, 0, 0), (1e-7, 0, 0), (0, 1e-7, 0)],
    ],
)
def test_triangles_without_area_are_not_numbers(null):
    light = raycasting([null, LEAF], [(0.06, 0.04)] * 2, ZENITH)
    assert light["area"][0] == 0
    assert all(math.isnan(light[key][0]) for key in ("Eabs", "Ei", "Ei_sup", "Ei_inf"))
    assert light["Ei"][1] == pytest.approx(100, abs=0.01)
    alone = raycasting([null], [(0.06, 0.04)], ZENITH)
    assert math.isnan(alone["Ei"][0])


def test_faulty_materials_are_refused_as_by_caribu():
    for black in ((0,), (0.0, 0), (0, 0, 0, 0)):
        with pytest.raises(ValueError):
            raycasting([LEAF], [black], ZENITH)
    for wrong in ((0.1, 0.1, 0.1), [0.1, 0.1]):
        with pytest.raises(TypeError):
            raycasting([LEAF], [wrong], ZENITH)
    with pytest.raises(ValueError):
        raycasting([LEAF], [(0.1,)] * 2, ZENITH)
    with pytest.raises(ValueError):
        radiosity([LEAF], [(0.1,)], ZENITH)


def test_several_bands_are_one_run():
    light = x_raycasting([LEAF], {"PAR": [(0.1,)], "NIR": [(0.2,)]}, ZENITH)
    assert light["PAR"]["Eabs"][0] == pytest.approx(90, abs=0.01)
    assert light["NIR"]["Eabs"][0] == pytest.approx(80, abs=0.01)


def test_means_are_weighted_by_area_and_have_errors():
    raw, aggregated = square_scene().run(direct=True)
    band = aggregated["default_band"]
    assert band["area"] == {"lower": 1.0, "upper": 0.5}
    assert band["Ei"]["lower"] == pytest.approx(0.5, abs=1e-3)
    assert band["Ei"]["upper"] == pytest.approx(1, abs=1e-3)
    assert list(raw["default_band"]["Ei"]) == ["lower", "upper"]
    assert isinstance(raw["default_band"]["Ei"]["upper"], list)
    assert type(band["Eabs_se"]["lower"]) is float and 0 < band["Eabs_se"]["lower"] < 1e-3


def test_errors_of_means_are_those_of_sums():
    sky = list(zip(*[turtle("46")[i] for i in (0, 2)]))
    estimates = []
    for seed in range(24):
        scene = square_scene(light=sky)
        _, aggregated = scene.run(direct=False, infinite=True, paths=64, seed=seed + 1)
        band = aggregated["default_band"]
        estimates.append((band["Eabs"]["lower"], band["Eabs_se"]["lower"]))
    means, errors = np.array(estimates).T
    scatter = means.std(ddof=1)
    # The ratio of scatter and error has a relative error of about 1 / sqrt(2 * 23).
    assert 0.4 < scatter / math.sqrt(np.mean(errors**2)) < 1.8


def test_bands_are_left_out_of_one_if_that_is_asked_for():
    raw, aggregated = square_scene().run(simplify=True, split_face=True)
    assert set(raw) == {"Eabs", "Ei", "Ei_sup", "Ei_inf", "area", "Eabs_se", "Ei_se"}
    assert set(aggregated) == set(raw)


def test_units_change_areas_alone():
    for unit, factor in (("m", 1), ("cm", 0.01)):
        scene = {1: [[tuple(x / factor for x in p) for p in t] for t in (LOWER_HALF, UPPER_HALF)]}
        _, light = CaribuScene(scene, scene_unit=unit).run(simplify=True)
        assert light["area"][1] == pytest.approx(1, rel=1e-12)
        assert light["Ei"][1] == pytest.approx(1, abs=1e-3)


def test_a_soil_lies_below():
    scene = square_scene(soil_mesh=1)
    scene.run(direct=True)
    soil = scene.soil_aggregated["default_band"]
    assert soil["area"] == pytest.approx(1) and soil["Ei"] == 0
    assert len(scene.soil_raw["default_band"]["Ei"]) == 2
    bare = CaribuScene({7: [COVER]}, pattern=(0, 0, 1, 1), soil_mesh=1, z_soil=-1)
    bare.run(direct=True)
    assert bare.soil_label == -1
    assert bare.getSoilEnergy()[0] == pytest.approx(0.5, abs=1e-3)
    assert bare.getIncidentEnergy() == (1, 1.0, 1)


def test_a_repeated_leaf_gets_light_from_the_ground():
    leaf = {1: [[(0, 0, 1), (0.5, 0, 1), (0.5, 0.5, 1)], [(0, 0, 1), (0.5, 0.5, 1), (0, 0.5, 1)]]}
    light = []
    for soil in (0.0, 0.5):
        scene = CaribuScene(
            leaf, ZENITH, (0, 0, 1, 1), {"PAR": (0.06, 0.07)}, {"PAR": soil}
        )
        light.append(scene.run(direct=False, infinite=True)[1]["PAR"]["Ei"][1])
    assert light[0] == pytest.approx(100, abs=0.1)
    # Light is seen again through the ground: at most 75 % * 0.5 falls on the lower side, and more
    # by what the leaf sends back.
    assert 130 < light[1] < 145


def test_a_pattern_repeats_exactly():
    beside = {1: [[(x + 0.8, y + 0.7, z) for x, y, z in t] for t in (LOWER_HALF, UPPER_HALF)]}
    scene = CaribuScene(beside, ZENITH, ((0, 0), (1, 1)))
    light = scene.run(direct=True, infinite=True, simplify=True)[1]
    assert light["Ei"][1] == pytest.approx(100, abs=0.01)


def test_sensors_cast_no_shadow_and_look_up():
    up = [(0, 0, 2), (1, 0, 2), (0, 1, 2)]
    scene = CaribuScene({1: [LEAF]}, ZENITH)
    raw, aggregated = scene.run(
        direct=True, sensors={"up": [up], "down": [up[::-1]]}, simplify=True
    )
    assert aggregated["Ei"][1] == pytest.approx(100, abs=0.1)
    sensors = aggregated["sensors"]
    assert sensors["Ei"]["up"] == pytest.approx(100, abs=0.5)
    assert sensors["Ei"]["down"] == 0 and sensors["area"]["up"] == 0.5
    assert raw["sensors"]["Ei0"]["up"] == raw["sensors"]["Ei"]["up"]


def test_lights_may_change_between_runs():
    scene = square_scene()
    first = scene.run(simplify=True)[1]["Ei"]["upper"]
    traced = scene._traced[1]
    scene.setLight([(3, (0, 0, -1))])
    assert scene.run(simplify=True)[1]["Ei"]["upper"] == pytest.approx(3 * first, rel=1e-6)
    assert scene._traced[1] is traced
    scene.material["default_band"] = {"lower": (0.5, 0.1), "upper": (0.5, 0.1)}
    assert scene.run(simplify=True)[1]["Eabs"]["upper"] == pytest.approx(1.2, abs=1e-3)


def test_what_means_nothing_here_is_told_once(monkeypatch):
    monkeypatch.setattr(functions, "_warned", False)
    with pytest.warns(quasimc.QuasimcWarning, match="ignored") as seen:
        square_scene().run(screen_size=1536, layers=10)
        square_scene().run(screen_size=1536, d_sphere=1)
    assert len(seen) == 1


def test_precision_takes_the_place_of_pixels():
    keys = dict(direct=False, simplify=True, paths=256, max_paths=1 << 16)
    errors = []
    for precision in (0.5, 0.0005):
        light = square_scene().run(precision=precision, **keys)[1]
        errors.append(light["Eabs_se"]["lower"] / light["Eabs"]["lower"])
    assert errors[1] < errors[0]
    with pytest.raises(ValueError, match="precision"):
        square_scene().run(precision=3)


@pytest.mark.parametrize(
    "arguments, error",
    [
        (dict(scene_unit="inch"), ValueError),
        (dict(scene=3), ValueError),
        (dict(scene={}), IndexError),
        (dict(scene={1: [LEAF]}, light=[]), IndexError),
        (dict(scene={1: [LEAF]}, light=3), ValueError),
        (dict(scene={1: [LEAF]}, pattern=[0, 0, 1, 1]), ValueError),
        (dict(scene={1: [LEAF]}, opt={}), IndexError),
        (dict(scene={1: [LEAF]}, opt={"PAR": (0.1,)}, soil_reflectance=0.1), ValueError),
        (dict(scene={1: [LEAF]}, soil_reflectance=0.1), AttributeError),
        (dict(scene={1: [LEAF]}, soil_mesh=1), ValueError),
        (dict(scene={1: [LEAF]}, soil_mesh=2), UserWarning),
    ],
)
def test_faults_are_told_at_construction_as_by_caribu(arguments, error):
    with pytest.raises(error):
        CaribuScene(**arguments)


def test_an_empty_scene_gives_nothing():
    assert CaribuScene().run() == ({}, {})


def test_files_are_read(tmp_path):
    (tmp_path / "plant.can").write_text(
        "# triangles\np 1 100001001001 3 0 0 0 1 0 0 0 1 0\np 1 100001000001 3 0 0 1 1 0 1 0 1 1\n"
    )
    (tmp_path / "par.opt").write_text(
        "n 1\ns d 0.15\ne d 0.1 d 0.1 0.05 d 0.1 0.05\n"
    )
    (tmp_path / "sky.light").write_text("1.0 0 0 -1\n")
    (tmp_path / "plot.8").write_text("0 0\n2 2\n")
    assert read_pattern(tmp_path / "plot.8") == (0, 0, 2, 2)
    assert read_light(tmp_path / "sky.light") == [(1.0, (0, 0, -1))]
    count, soil, species = read_opt(tmp_path / "par.opt")
    assert (count, soil, species) == (1, 0.15, {1: (0.1, 0.1, 0.05, 0.1, 0.05)})
    labels = list(read_can(tmp_path / "plant.can"))
    assert build_materials(labels, species) == [(0.1, 0.05), (0.1,)]
    scene = CaribuScene(
        str(tmp_path / "plant.can"),
        str(tmp_path / "sky.light"),
        str(tmp_path / "plot.8"),
        [str(tmp_path / "par.opt")],
    )
    assert list(scene.material) == ["par"]
    light = scene.run()[1]["par"]["Ei"]
    assert light[labels[1]] == pytest.approx(1, abs=1e-3) and light[labels[0]] == 0
    assert Label(labels[0]).leaf == 1 and Label(labels[1]).is_stem()


def test_lights_come_from_places_of_the_sky():
    north, east = light_sources([45, 45], [0, 90], [1, 2])
    assert north[1] == pytest.approx((-(0.5**0.5), 0, -(0.5**0.5)))
    assert east[1] == pytest.approx((0, 0.5**0.5, -(0.5**0.5)))
    turned = light_sources(45, 0, 1, orientation=-90)[0]
    assert turned[1] == pytest.approx((0, -(0.5**0.5), -(0.5**0.5)))
    assert light_sources([], [], []) == []


@pytest.mark.parametrize("sectors, count", [("46", 46), ("16", 16), ("1", 1)])
def test_a_turtle_has_all_energy(sectors, count):
    energy, emission, direction, elevation, azimuth = turtle(sectors, "soc", 5.0)
    assert len(direction) == count and sum(energy) == pytest.approx(5, rel=1e-12)
    assert all(d[2] < 0 for d in direction)
    assert np.allclose(np.array(emission) * np.sin(np.radians(elevation)), energy)
    # As much from every side.
    sideways = np.sum(np.array(energy)[:, None] * np.array(direction)[:, :2], axis=0)
    assert np.allclose(sideways, 0, atol=1e-9)


class TriangleSet:
    pointList = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    indexList = [(0, 1, 2, 3)]


class Shape:
    def __init__(self, pid):
        self.id, self.geometry = pid, TriangleSet()


class Mtg:
    def property(self, name):
        return {4: TriangleSet(), 6: TriangleSet()} if name == "geometry" else {}


def test_scenes_of_plantgl_and_mtgs_are_known_by_what_they_can_do():
    assert {pid: len(t) for pid, t in scene_to_cscene([Shape(1), Shape(2), Shape(1)]).items()} == {
        1: 4,
        2: 2,
    }
    assert sorted(mtg_to_cscene(Mtg())) == [4, 6]
    assert sorted(CaribuScene([Shape(3)]).run(simplify=True)[1]["Ei"]) == [3]
    assert sorted(CaribuScene(Mtg()).run(simplify=True)[1]["Ei"]) == [4, 6]


def leaf_of_plantgl():
    return plantgl.TriangleSet([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)])


def test_transformed_shapes_of_plantgl_stand_where_they_were_moved(monkeypatch):
    plantgl.install(monkeypatch)
    leaf = leaf_of_plantgl()
    scene = plantgl.Scene([plantgl.Shape(leaf, id=1)])
    scene.add(plantgl.Shape(plantgl.Translated((0, 0, 2), plantgl.Scaled((1, 2, 1), leaf)), id=2))
    cscene = CaribuScene(scene)
    assert cscene.bbox() == ((0, 0, 0), (1, 2, 2))
    aggregated = cscene.run(simplify=True)[1]
    assert aggregated["area"] == {1: pytest.approx(1), 2: pytest.approx(2)}
    assert aggregated["Ei"][1] == pytest.approx(0, abs=1e-3)
    assert aggregated["Ei"][2] == pytest.approx(1, abs=1e-2)


def test_geometries_of_an_mtg_are_transformed(monkeypatch):
    plantgl.install(monkeypatch)

    class Plant:
        def property(self, name):
            return {7: plantgl.Translated((0, 0, 3), leaf_of_plantgl())}

    assert mtg_to_cscene(Plant())[7][0][0] == (0, 0, 3)


def test_transformed_shapes_need_plantgl_to_be_made_triangles():
    moved = plantgl.Translated((0, 0, 2), leaf_of_plantgl())
    with pytest.raises(ValueError, match="a Translated can't be divided into triangles"):
        CaribuScene([plantgl.Shape(moved, id=1)])


class Lsystem:
    def sceneInterpretation(self, lstring):
        return [Shape(pid) for pid, module in enumerate(lstring) if module == "L"]


def test_strings_of_lpy_are_drawn_by_their_lsystem():
    scene = CaribuScene((Lsystem(), "FLFL"))
    assert list(scene.scene.keys()) == [1, 3]


@pytest.mark.parametrize("kind", ["soc", "uoc"])
def test_skies_in_cells_have_all_energy(kind):
    text = GetLight.GetLight(GenSky.GenSky()(7.0, kind, 5, 6))
    lights = [[float(x) for x in line.split()] for line in text.splitlines()]
    assert len(lights) == 30 and sum(light[0] for light in lights) == pytest.approx(7, rel=1e-12)
    assert all(np.linalg.norm(light[1:]) == pytest.approx(1) for light in lights)
    assert all(light[3] < 0 for light in lights)
    # Half of the light of a uniform sky comes from within 45 degrees, more of an overcast one.
    high = sum(light[0] for light in lights if -light[3] > 0.5**0.5) / 7
    assert high == pytest.approx(0.5, abs=1e-9) if kind == "uoc" else high > 0.55


def test_exposure_to_the_sky_is_that_of_its_horizontal_light():
    star, exposed = caribu_star({1: [LEAF]}, 16, convUnit=1)
    assert star[1] == pytest.approx(1, abs=1e-3) and exposed[1] == pytest.approx(1, abs=1e-3)
    by_triangle, _ = caribu_star({1: [LEAF, HIGHER]}, 1, True, convUnit=1)
    assert by_triangle[1] == pytest.approx([0, 1], abs=1e-3)


def test_a_picture_takes_values_and_gaps():
    scene = square_scene()
    axes, values = scene.plot(display=False)
    assert values is None
    raw, aggregated = scene.run(simplify=True)
    assert len(scene.plot(raw["Ei"], display=False)[1]) == 3
    axes, values = scene.plot({"lower": math.nan, "upper": 2.0}, 0, 4, display=False)
    assert values == [0.0, 0.0, 0.5]


def test_the_mixed_function_repeats_over_a_ground():
    light = mixed_radiosity(
        [LOWER_HALF, UPPER_HALF], [(0.06, 0.04)] * 2, ZENITH, (0, 0, 1, 1), 0.15, 0.5, 2, 1.0
    )
    assert light["Ei"][0] == pytest.approx(100, abs=2)


def test_the_sun_of_a_day_and_an_hour():
    energy, azimuth, zenith = Gensun.Gensun()(500.0, 172, 12, 45.0)
    assert energy == 500 and math.degrees(zenith) == pytest.approx(45 - 23.45, abs=0.02)
    assert abs(math.degrees(azimuth)) == pytest.approx(180)  # in the south, X+ is north
    morning = Gensun.Gensun()(500.0, 172, 8, 45.0)
    assert math.sin(morning[1]) < 0 < math.sin(Gensun.Gensun()(500.0, 172, 16, 45.0)[1])
    # As the position of the sun by the precise algorithm, at an hour near that of true solar time.
    precise = quasimc.sun_position(45.0, 0.0, "2023-06-21T08:02+00:00")
    assert 90 - math.degrees(morning[2]) == pytest.approx(precise.elevation_deg, abs=0.5)
    assert -math.degrees(morning[1]) % 360 == pytest.approx(precise.azimuth_deg, abs=0.5)
    light = [float(x) for x in GetLightsSun.GetLightsSun(morning).split()]
    assert light[0] == 500 and light[3] == pytest.approx(-math.cos(morning[2]))
    expected = light_sources(90 - math.degrees(morning[2]), -math.degrees(morning[1]), 500)[0]
    assert light[1:] == pytest.approx(expected[1])
    assert Gensun.Gensun()(500.0, 172, 1, 45.0)[0] == 0
    sun = Gensun.Gensun()(Rsun=500.0, DOY=172, heureTU=8, lat=45.0)  # as scripts call it
    assert (sun.azim, sun.elev) == (morning[1], math.pi / 2 - morning[2])


def test_the_diffuse_part_of_an_hour():
    at_noon = lambda rg: spitters_horaire.RdRsH(rg, 172, 12, 45.0)  # noqa: E731
    assert at_noon(100) == 1 and at_noon(0) == 1
    outside = 1370 * (1 + 0.033 * math.cos(2 * math.pi * 172 / 365))
    outside *= spitters_horaire.sin_elevation(172, 12, 45.0)
    assert at_noon(0.3 * outside) == pytest.approx(1 - 6.4 * 0.08**2)
    assert at_noon(0.5 * outside) == pytest.approx(1.47 - 1.66 * 0.5)
    sine = math.cos(math.radians(45 - 23.45))
    clear = 0.847 - 1.61 * sine + 1.04 * sine**2
    assert at_noon(0.9 * outside) == pytest.approx(clear, abs=1e-3)
    fractions = [at_noon(share * outside) for share in np.linspace(0, 1, 200)]
    assert all(b <= a + 0.01 for a, b in zip(fractions, fractions[1:]))
    assert spitters_horaire.RdRsH(100, 172, 1, 45.0) == 1


def test_nodes_give_scenes_and_outputs():
    scene = nodes.newCaribuScene({1: [LEAF]}, ZENITH, scene_unit="m")
    same, aggregated, raw = nodes.runCaribu(scene)
    assert same is scene and list(raw) == ["band1"]
    light, name = nodes.selectOutput(aggregated, "Ei", "band1")
    assert name == "Ei" and light[1] == pytest.approx(100, abs=0.01)
    assert nodes.selectOutput(aggregated["band1"], "Ei")[0] == light
    assert nodes.getIncidentEnergy(scene)[0] == 100


def test_a_scene_as_plain_lists():
    scene = square_scene(opt={"PAR": (0.1, 0.05)}, soil_reflectance={"PAR": 0.2}, soil_mesh=1)
    triangles, groups, materials, bands, albedo = scene.as_primitive()
    assert len(triangles) == 5 and groups == ["lower", "lower", "upper", "soil", "soil"]
    assert materials == {"PAR": [(0.1, 0.05)] * 3 + [(0.2,)] * 2}
    assert bands == ["PAR"] and albedo == {"PAR": 0.2}


def test_triangles_are_moved_into_the_pattern():
    far = [(x + 7, y - 3, z) for x, y, z in LOWER_HALF]
    scene = CaribuScene({5: [far], 6: [UPPER_HALF]}, ZENITH, pattern=(1, 1, 0, 0))
    before = scene.run(infinite=True, simplify=True)[1]["Ei"]
    assert scene.runPeriodise() is scene
    assert np.allclose(scene.scene[5], [LOWER_HALF]) and np.allclose(scene.scene[6], [UPPER_HALF])
    after = scene.run(infinite=True, simplify=True)[1]["Ei"]
    assert after[5] == pytest.approx(before[5], rel=1e-3)
    with pytest.raises(ValueError):
        CaribuScene({5: [far]}).runPeriodise()


@pytest.mark.parametrize("number", [math.nan, math.inf])
def test_corners_that_are_not_finite_are_refused(number):
    faulty = [(0, 0, 1), (1, 0, number), (0, 1, 1)]
    scene = CaribuScene({1: [LEAF], 2: [faulty]}, light=ZENITH)
    with pytest.raises(ValueError, match="triangle 1 has a corner that is not finite"):
        scene.run(direct=True)
    with pytest.raises(ValueError, match="triangle 0 has a corner"):
        raycasting([faulty, LEAF], [(0.1,), (0.1,)], ZENITH)
    with pytest.raises(ValueError, match="sensor 0 has a corner"):
        raycasting([LEAF], [(0.1,)], ZENITH, sensors=[faulty])


def test_a_soil_that_lies_on_triangles_is_told():
    with pytest.warns(quasimc.QuasimcWarning, match="give z_soil"):
        square_scene(soil_mesh=1)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        square_scene(soil_mesh=1, z_soil=-0.1)
        square_scene(soil_mesh=1, z_soil=0)
        slanted = {1: [[(0, 0, 0), (1, 0, 1), (0, 1, 1)]]}
        CaribuScene(slanted, pattern=(0, 0, 1, 1), soil_mesh=1)
