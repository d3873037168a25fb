#include "bad_inputs.h"

namespace quasimc::test {
namespace {

/// Places in the good run file.
const std::string kReflectance = "reflectance = 0.1";
const std::string kTransmittance = "transmittance = 0.2";
const std::string kDirection = "direction = [0, 0, -1]";
const std::string kIrradiance = "irradiance_facing = 1";
const std::string kCorners = "corners = [[0, 0, 5], [1, 0, 5], [0, 1, 5]]";
const std::string kFile = "file = \"leaves.tri\"";
const std::string kShape = "shape = \"triangle\"";

const std::vector<BadInput> kBadScenes{
    {"NoSource",
     "[[source]]\ntype = \"directional\"\ndirection = [0, 0, -1]\nirradiance_facing = 1\n", "",
     "no source of light is given"},
    {"SourceNoList", "[[source]]", "[source]", "write [[source]] above it"},
    {"SourceWithoutType", "type = \"directional\"", "", "run.toml:9: source: type is missing"},
    {"UnknownSource", "type = \"directional\"", "type = \"lamp\"",
     "run.toml:10: source: type is 'lamp'"},
    {"DirectionZero", kDirection, "direction = [0, 0, 0]",
     "run.toml:11: source 'directional': direction is [0, 0, 0]"},
    {"DirectionNan", kDirection, "direction = [0, 0, nan]",
     "run.toml:11: source 'directional': direction is nan"},
    {"DirectionInfinite", kDirection, "direction = [0, 0, -inf]", "direction is -inf"},
    {"DirectionOfFour", kDirection, "direction = [0, 0, -1, 0]", "direction is a list of 4"},
    {"DirectionMissing", kDirection, "", "where it shines from is missing"},
    {"IrradianceNegative", kIrradiance, "irradiance_facing = -1",
     "run.toml:12: source 'directional': irradiance_facing is -1"},
    {"IrradianceInfinite", kIrradiance, "irradiance_facing = inf", "irradiance_facing is inf"},
    {"IrradianceZero", kIrradiance, "irradiance_facing = 0", "all irradiances are 0"},
    {"IrradianceTwice", kIrradiance, "irradiance_facing = 1\nirradiance_horizontal = 1",
     "two irradiances are given"},
    {"IrradianceMissing", kIrradiance, "", "its irradiance is missing"},
    {"IrradianceForTwoBands", kIrradiance, "irradiance_facing = [1, 2]",
     "irradiance_facing has 2 values (there are 1 bands)"},
    {"IrradianceOverflow", kIrradiance, "irradiance_facing = 1e999", "run.toml:12: "},
    {"SunsetOnTheHorizontal", kDirection + "\n" + kIrradiance,
     "direction = [1, 0, 0]\nirradiance_horizontal = 1", "not above the horizon"},
    {"NoMaterial", "[[material]]\nname = \"leaf\"\nreflectance = 0.1\ntransmittance = 0.2\n", "",
     "leaf"},
    {"TwoMaterialsOfOneName", "[[geometry]]",
     "[[material]]\nname = \"leaf\"\nreflectance = 0\n[[geometry]]", "leaf"},
    {"MaterialWithoutName", "name = \"leaf\"", "", "run.toml:13: material: name is missing"},
    {"MaterialNamelessName", "name = \"leaf\"", "name = \"\"",
     "run.toml:14: material: its name is empty"},
    {"MaterialMakesLight", kTransmittance, "transmittance = 0.95", "material 'leaf'"},
    {"MaterialMakesLightBelow", kTransmittance,
     kTransmittance + "\n[material.lower]\nreflectance = 0.9", "material 'leaf'"},
    {"ReflectanceAboveOne", kReflectance, "reflectance = 1.5",
     "run.toml:15: material 'leaf': reflectance is 1.5 (it must be 0 to 1)"},
    {"ReflectanceNegative", kReflectance, "reflectance = -0.1", "reflectance is -0.1"},
    {"ReflectanceNan", kReflectance, "reflectance = nan", "reflectance is nan"},
    {"ReflectanceText", kReflectance, "reflectance = \"0.1\"", "reflectance is a text"},
    {"ReflectanceTrue", kReflectance, "reflectance = true", "reflectance is true or false"},
    {"ReflectanceForgotten", kReflectance + "\n" + kTransmittance, "",
     "neither reflectance nor transmittance is given"},
    {"ReflectanceOfUnknownBand", kReflectance, "reflectance = { NIR = 0.1 }", "PAR is missing"},
    {"UnknownModel", kReflectance, kReflectance + "\nreflection_model = \"glossy\"",
     "reflection_model is 'glossy' (no such model)"},
    {"ModelWithoutExponent", kReflectance, kReflectance + "\nreflection_model = \"phong\"",
     "reflection_exponent is missing"},
    {"ExponentNegative", kReflectance,
     kReflectance + "\nreflection_model = \"phong\"\nreflection_exponent = -3",
     "reflection_exponent is -3"},
    {"ExponentHuge", kReflectance,
     kReflectance + "\nreflection_model = \"phong\"\nreflection_exponent = 1e300",
     "reflection_exponent is 1e+300"},
    {"NoOrgan",
     "[[geometry]]\nfile = \"leaves.tri\"\nmaterial = \"leaf\"\n[[organ]]\nname = "
     "\"third\"\nmaterial = \"leaf\"\n" +
         kShape + "\n" + kCorners + "\n",
     "", "no organs"},
    {"UnknownMaterial", "material = \"leaf\"\nshape", "material = \"laef\"\nshape",
     "did you mean 'leaf'?"},
    {"OrganWithoutMaterial", "material = \"leaf\"\nshape", "shape",
     "organ 'third': material is missing"},
    {"UnknownShape", kShape, "shape = \"triangel\"", "did you mean 'triangle'?"},
    {"CornersMissing", kCorners, "", "corners is missing"},
    {"CornersOfTwo", kCorners, "corners = [[0, 0, 5], [1, 0, 5]]", "organ 'third': 2 corners"},
    {"CornersNan", kCorners, "corners = [[0, 0, 5], [1, 0, 5], [0, 1, nan]]",
     "organ 'third': corners[2] is nan"},
    {"CornersInfinite", kCorners, "corners = [[0, 0, 5], [1, 0, 5], [0, 1, inf]]",
     "organ 'third': corners[2] is inf"},
    {"CornersHuge", kCorners, "corners = [[0, 0, 5], [1e200, 0, 5], [0, 1, 5]]", "third"},
    {"TwoOrgansOfOneId", "[[organ]]",
     "[[organ]]\nid = 7\nmaterial = \"leaf\"\n" + kShape + "\n" + kCorners + "\n[[organ]]\nid = 7",
     "id 7"},
    {"IdBeyondInteger", kShape, "id = 99999999999999999999\n" + kShape, "run.toml:"},
    {"LabelsNoTable", kShape, "labels = [1]\n" + kShape, "labels is a list"},
    {"ScaleZero", kShape, "transform = { scale = 0 }\n" + kShape, "scale is 0"},
    {"SphereOfManyTriangles", kShape + "\n" + kCorners,
     "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 1\nlevels = 30", "levels is 30"},
    {"CylinderOfManySides", kShape + "\n" + kCorners,
     "shape = \"cylinder\"\nbase = [0, 0, 0]\naxis = [0, 0, 1]\nradius = 1\nsides = 2000000000",
     "sides is 2000000000"},
    {"GroundOfUnknownMaterial", "[[geometry]]", "[ground]\nmaterial = \"soil\"\n[[geometry]]",
     "soil"},
    {"GroundInsideOut", "[[geometry]]",
     "[ground]\nmaterial = \"leaf\"\nx = [1, -1]\ny = [0, 1]\n[[geometry]]",
     "low must be less than high"},
    {"CellOfNoSize", "[[geometry]]", "[cell]\nx = [1, 1]\n[[geometry]]",
     "low must be less than high"},
    {"CellTiny", "[[geometry]]", "[cell]\nx = [0, 1e-30]\n[[geometry]]", "cell"},
    {"CellAlongUp", "[[geometry]]", "[cell]\nz = [0, 1]\n[[geometry]]", "unknown key 'z'"},
    {"FileMissing", kFile, "file = \"none.tri\"",
     "run.toml:18: geometry: file 'none.tri' can't be read (No such file or directory)"},
    {"FileIsAFolder", kFile, "file = \".\"\nformat = \"tri\"", "can't be read (it is a folder)"},
    {"FileIsADevice", kFile, "file = \"/dev/zero\"\nformat = \"tri\"",
     "can't be read (it is a device)"},
    {"FileWithNul", kFile, "file = \"a\\u0000.tri\"", "geometry"},
    {"FileOfUnknownFormat", kFile, "file = \"leaves.stl\"",
     "the format of 'leaves.stl' can't be told"},
    {"FileIsTheRunFile", kFile, "file = \"run.toml\"\nformat = \"obj\"",
     "run.toml:1: 'format' is no statement of OBJ"},
};

}  // namespace

std::vector<BadInput> bad_scenes() {
    return kBadScenes;
}

}  // namespace quasimc::test
