"""The functions of Caribu's nodes for dataflows."""

from __future__ import annotations

from .CaribuScene import CaribuScene

DEFAULT_BAND = "band1"


def newCaribuScene(
    scene=None,
    light=None,
    pattern=None,
    opt=None,
    soil_reflectance=None,
    soil_mesh=-1,
    z_soil=0.0,
    scene_unit="cm",
):
    """A CaribuScene; without optics its band is "band1"."""
    if opt is None and soil_reflectance is None:
        opt = {DEFAULT_BAND: CaribuScene.default_material}
    return CaribuScene(
        scene,
        light=light,
        pattern=pattern,
        opt=opt,
        soil_reflectance=soil_reflectance,
        soil_mesh=soil_mesh,
        z_soil=z_soil,
        scene_unit=scene_unit,
    )


def runCaribu(caribuscene, direct=True, infinite=False, **keys):
    """Runs a scene; the keywords are those of `CaribuScene.run`.

    Returns
    -------
    scene, aggregated, raw
    """
    raw, aggregated = caribuscene.run(direct=direct, infinite=infinite, **keys)
    return caribuscene, aggregated, raw


def selectOutput(output, name="Ei", band=DEFAULT_BAND):
    """One quantity of an output: its dict by pid, and its name.

    Of an output of one band, whatever it is called, `band` may be another.
    """
    bands = [key for key, value in output.items() if isinstance(value, dict) and name in value]
    if name not in output and band not in output and len(bands) == 1:
        band = bands[0]
    return (output[name] if name in output else output[band][name]), name


def periodise(caribuscene):
    """Moves the triangles of a scene into its pattern; as `CaribuScene.runPeriodise`."""
    return caribuscene.runPeriodise()


def getIncidentEnergy(caribuscene):
    """As `CaribuScene.getIncidentEnergy`."""
    return caribuscene.getIncidentEnergy()


def getSoilEnergy(caribuscene):
    """As `CaribuScene.getSoilEnergy`."""
    return caribuscene.getSoilEnergy()
