import os
import pickle
from pathlib import Path

import numpy as np
import pytest

import quasimc
from canopies import FEW, canopy

SOURCE = Path(os.environ["QUASIMC_SOURCE_DIR"])


def test_parts_add_up_to_the_whole():
    result = canopy().run(**FEW, sun_shade="apart", layers=2)
    for light in (result, result.groups):
        parts = light.sun_shade
        assert parts["incident_upper_sunlit"]["PAR"].unit == "W m-2"
        for side in ("upper", "lower"):
            fraction = parts[f"sunlit_fraction_{side}"].values
            assert fraction.shape == light["sunlit_fraction"].values.shape
            sunlit = np.nan_to_num(parts[f"incident_{side}_sunlit"]["NIR"].values)
            shaded = np.nan_to_num(parts[f"incident_{side}_shaded"]["NIR"].values)
            whole = light[f"incident_{side}"]["NIR"].values
            inner = fraction < 0.99        # others are cut at 1
            assert inner.any() and np.allclose(
                (fraction * sunlit + (1 - fraction) * shaded)[inner], whole[inner], rtol=0.02)
    table = result.sun_shade.to_pandas()
    assert len(table) == len(result.organs) and "absorbed_flux_density_sunlit_PAR_se" in table


def test_days_have_hours_in_the_sun():
    stand = quasimc.Scene(
        {"PAR": "umol m-2 s-1"}, length_unit="m", site=quasimc.Site(45, 8))
    stand.add_material("leaf", reflectance=0.1)
    stand.add_mesh([[0, 0, 1], [1, 0, 1], [0, 1, 1]], [[0, 1, 2]], material="leaf")
    day = quasimc.day("2024-06-21", utc_offset_hours=1, hours=[10, 12])
    series = stand.series(day, paths=256, sun_shade="apart")
    for light in (series.days["2024-06-21"], series.total, series.total.groups):
        parts = light.sun_shade
        assert parts["sunlit_hours"].unit == "h"
        assert parts["sunlit_hours_upper"].values[0] == pytest.approx(2, rel=1e-3)
        assert parts["incident_upper_direct"]["PAR"].unit == "mol m-2"
        mean = parts["incident_upper_sunlit"]["PAR"]
        assert mean.unit == "umol m-2 s-1"
        assert mean.values[0] * 7200e-6 == pytest.approx(
            light["incident_upper"]["PAR"].values[0], rel=1e-2)


def test_parts_must_be_asked_for():
    result = canopy().run(**FEW)
    with pytest.raises(KeyError, match='sun_shade="apart"'):
        result.sun_shade
    with pytest.raises(KeyError, match="there is no quantity 'light'"):
        canopy().run(**FEW, sun_shade="apart").sun_shade["light"]


def test_pickled_and_saved_results_keep_the_parts(tmp_path):
    scene = quasimc.load(SOURCE / "examples" / "01-leaves" / "leaves.toml")
    result = scene.run(paths=64, replicates=4, sun_shade="apart")
    name, band = "absorbed_flux_density_sunlit", result.bands[0]
    values = result.sun_shade[name][band].values
    again = pickle.loads(pickle.dumps(result))
    np.testing.assert_array_equal(again.sun_shade[name][band].values, values)
    opened = quasimc.open(result.save(tmp_path / "light.json"))
    np.testing.assert_array_equal(opened.sun_shade[name][band].values, values)
