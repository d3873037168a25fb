"""Gap fractions."""

import math

import numpy as np
import pytest

import quasimc


def roof():
    """A square of 1 x 1 at height 1 over the origin."""
    scene = quasimc.Scene("PAR")
    scene.add_material("leaf", reflectance=0.1)
    scene.add_mesh(
        [[-0.5, -0.5, 1], [0.5, -0.5, 1], [0.5, 0.5, 1], [-0.5, 0.5, 1]],
        [[0, 1, 2], [0, 2, 3]], material="leaf",
    )
    return scene


def test_a_roof_closes_its_solid_angle():
    gaps = roof().gap_fraction([0, 0, 0], rings_deg=[0, 90], azimuths=4)
    quarter = math.asin(0.25 / 1.25)
    expected = 1 - 4 * quarter / (2 * math.pi)
    assert gaps.gap.shape == (1, 1, 4)
    np.testing.assert_allclose(gaps.gap.values, expected, atol=5e-3)
    assert (gaps.gap.standard_error < 3e-3).all()
    assert gaps.all.gap.values[0] == pytest.approx(expected, abs=5e-3)
    assert gaps.by_position.plant_area_index.shape == (1,)
    assert float(gaps.all.clumping_index) == pytest.approx(1, abs=0.01)


def test_rings_are_those_of_the_instrument():
    gaps = roof().gap_fraction(np.zeros((2, 3, 3)))
    assert gaps.gap.shape == (6, 5, 8)
    assert list(gaps.rings_deg) == [0, 13, 28, 43, 58, 74]
    assert gaps.closed_bins == 6 * 8  # the innermost ring sees nothing but the roof
    assert "plant area index" in repr(gaps)


@pytest.mark.parametrize(
    "keys, text",
    [
        ({"rings_deg": [20, 10]}, "rings_deg are no bounds of rings"),
        ({"azimuths": 0}, "azimuths is 0"),
        ({"where": "kin == 'leaf'"}, "unknown label 'kin'"),
    ],
)
def test_bad_arguments_are_refused(keys, text):
    with pytest.raises(quasimc.InputError, match=text):
        roof().gap_fraction([0, 0, 0], **keys)
    with pytest.raises(ValueError, match="shape"):
        roof().gap_fraction([0, 0])
