// PlantGL's .geom, as its printer writes it.

#include <gtest/gtest.h>

#include "io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A scene in the words of PlantGL's printer.
constexpr const char* kPrinted = R"((#--------------------------------------------------
 #
 #  A GEOM file generated with GEOM library
 #)

Translated Geometry_1 {
    Translation <1,0,0>
    Geometry AxisRotated {
        Axis <0,0,1>
        Angle 90
        Geometry TriangleSet blade {
            PointList [
                <0,0,1>,
                <2,0,1>,
                <0,2,1>
            ]
            IndexList [
                [0,1,2]
            ]
            Skeleton Polyline {
                PointList [
                    <0,0,0>,
                    <0,0,1>
                ]
            }
        }
    }
}

Material green {
    Ambient <30,90,60>
    Diffuse 2
}

Shape leaf_1 {
    Id  12
    ParentId  3
    Geometry  Geometry_1
    Appearance  green
}

# the same leaf again, in few words
Shape { blade, green }
)";

TEST(ReadGeom, MakesAnOrganOfAShape) {
    const ReadMesh read = read_mesh_text("geom", kPrinted);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(read.warnings, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    const MeshGroup& leaf = read.mesh.groups[0];
    EXPECT_EQ(leaf.name, "leaf_1");
    EXPECT_EQ(leaf.id, 12);
    EXPECT_EQ(leaf.labels, (Labels{{"parent_id", "3"}}));
    EXPECT_EQ(leaf.parts[0].material, "green");
    EXPECT_EQ(read.mesh.groups[1].name, "blade");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_NEAR(read.mesh.materials[0].reflectance, 2 * 60.0 / 255, 1e-15);
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    EXPECT_LT(length(triangles[0][1] - Vec3{1, 2, 1}), 1e-12);
    EXPECT_LT(length(triangles[0][2] - Vec3{-1, 0, 1}), 1e-12);
    EXPECT_EQ(triangles[1][1], (Vec3{2, 0, 1}));
}

/// A shape with the faces, and what stands around them.
ReadMesh read_faces(const std::string& faces, const std::string& before = "Geometry ") {
    return read_mesh_text("geom", "Shape {\n" + before + faces + "\n}\n");
}

const std::string kGeomPoints = "PointList [<0,0,0>,<2,0,0>,<2,2,0>,<0,2,0>]";
const std::string kGeomTriangle = "TriangleSet { " + kGeomPoints + " IndexList [[0,1,3]] }";

TEST(ReadGeom, TakesTrianglesQuadrilateralsAndPolygons) {
    EXPECT_EQ(triangles_of(read_faces(kGeomTriangle).mesh).size(), 1U);
    EXPECT_EQ(
        triangles_of(read_faces("QuadSet { " + kGeomPoints + " IndexList [[0,1,2,3]] }").mesh)
            .size(),
        2U);
    EXPECT_EQ(
        triangles_of(
            read_faces("FaceSet { " + kGeomPoints + " IndexList [[0,1,2,3],[0,1,2]] CCW False }")
                .mesh)
            .size(),
        3U);
    const ReadMesh clockwise =
        read_faces("TriangleSet { CCW False " + kGeomPoints + " IndexList [[0,1,3]] }");
    EXPECT_EQ(
        triangles_of(clockwise.mesh)[0], (Triangle{Vec3{0, 2, 0}, Vec3{2, 0, 0}, Vec3{0, 0, 0}}));
}

TEST(ReadGeom, MovesScalesTurnsAndGroups) {
    const auto corner = [](const std::string& what) {
        const ReadMesh read = read_faces(what + " Geometry " + kGeomTriangle + " }");
        EXPECT_EQ(read.faults, Texts{}) << what;
        return triangles_of(read.mesh)[0][1];
    };
    const auto expect = [](const Vec3& p, const Vec3& q) { EXPECT_LT(length(p - q), 1e-12); };
    expect(corner("Translated { Translation <1,2,3>"), {3, 2, 3});
    expect(corner("Scaled { Scale <3,1,1>"), {6, 0, 0});
    expect(corner("AxisRotated { Axis OZ Angle 90"), {0, 2, 0});
    expect(corner("EulerRotated { Azimuth 90"), {0, 2, 0});
    expect(corner("EulerRotated { Elevation 90"), {0, 0, -2});
    expect(corner("EulerRotated { Azimuth 90 Roll 90 Elevation 90"), {0, 0, -2});
    expect(corner("Oriented { Primary <0,1,0> Secondary <0,0,1>"), {0, 2, 0});
    const ReadMesh two = read_faces(
        "Group { GeometryList [ " + kGeomTriangle + ", Translated { Translation <0,0,5> Geometry " +
        kGeomTriangle + " } ] }");
    EXPECT_EQ(two.faults, Texts{});
    ASSERT_EQ(two.mesh.groups.size(), 1U);
    EXPECT_EQ(triangles_of(two.mesh)[1][0], (Vec3{0, 0, 5}));
}

TEST(ReadGeom, TakesColoursAsTheyAreWritten) {
    const auto reflectance = [](const std::string& material) {
        const ReadMesh read = read_faces(kGeomTriangle + " Appearance " + material);
        EXPECT_EQ(read.faults, Texts{});
        return read.mesh.materials.at(0).reflectance;
    };
    EXPECT_NEAR(reflectance("Material a { }"), 160.0 / 255, 1e-15);
    EXPECT_NEAR(reflectance("Material a { Ambient 51 }"), 0.2, 1e-15);
    EXPECT_NEAR(reflectance("Material a { Ambient Red }"), 1.0 / 3, 1e-15);
    EXPECT_NEAR(reflectance("Material a { Ambient White Diffuse 0.25 }"), 0.25, 1e-15);
    EXPECT_TRUE(read_faces(kGeomTriangle + " Appearance Texture2D b { }").mesh.materials.empty());
}

TEST(ReadGeom, CountsOrgansWhoseIdsAreRepeated) {
    const std::string shape = "Shape { Id 4 Geometry " + kGeomTriangle + " }\n";
    const ReadMesh read = read_mesh_text("geom", shape + shape);
    EXPECT_EQ(read.mesh.groups[0].id, std::nullopt);
    EXPECT_TRUE(mentions(read.warnings, "1 shapes have an id that another shape has"));
}

TEST(ReadGeom, TellsFaultsWithTheirLines) {
    const auto expect = [](const std::string& faces, const char* part) {
        const Texts faults = read_faces(faces).faults;
        EXPECT_TRUE(mentions(faults, part)) << part << "\n" << (faults.empty() ? "" : faults[0]);
    };
    expect("Cylinder { Radius 1 }", ":2: 'Cylinder' is not read");
    expect("Sphere { }", "scene.save(\"all.obj\")");
    expect(
        "BezierPatch { CtrlPointMatrix [ [ <0,0,0,1>, <1,0,0,1> ], [ <0,1,0,1>, <1,1,0,1> ] ] }",
        "'BezierPatch' is not read");
    expect("leaf", "there is no 'leaf'");
    expect("TriangleSet { " + kGeomPoints + " }", "TriangleSet needs a PointList and an IndexList");
    expect("TriangleSet { PointList [<0,0>] IndexList [[0,0,0]] }", "points are <x,y,z>");
    expect("TriangleSet { " + kGeomPoints + " IndexList [[0,1,4]] }", "face 0 of the TriangleSet");
    expect("TriangleSet { " + kGeomPoints + " IndexList [[0,1]] }", "face 0 of the TriangleSet");
    expect("TriangleSet { PointList [<0,0,nan>] }", "'nan' stands where a finite number");
    expect("TriangleSet { PointList [<0,0,2*3>] }", "expressions are not computed");
    expect(
        "Translated { Translation 1 Geometry " + kGeomTriangle + " }",
        "the Translation of Translated");
    expect("Translated { Translation <0,0,0> }", "Translated has no Geometry");
    expect(
        "AxisRotated { Axis <0,0,0> Geometry " + kGeomTriangle + " }", "the Axis is no direction");
    expect(
        "Oriented { Primary <1,0,0> Secondary <1,0,0> Geometry " + kGeomTriangle + " }",
        "are no two directions");
    expect("Group { }", "Group has no GeometryList");
    expect(kGeomTriangle + " Id 1.5", "Id is no whole number");
    expect("TriangleSet { ", "the file ends too early");
    const auto whole = [](const std::string& text) { return read_mesh_text("geom", text).faults; };
    EXPECT_TRUE(mentions(whole(":Define A 3\n"), ":1: ':Define' is not read"));
    EXPECT_TRUE(mentions(whole("Inline { FileName \"a.geom\" }"), "Inline is not read"));
    EXPECT_TRUE(mentions(whole(""), "it has no Shape"));
    EXPECT_TRUE(mentions(whole("Material a { }\nMaterial a { }\n"), "'a' is there twice"));
    EXPECT_TRUE(mentions(whole("Shape { Id 3 }"), "the Shape has no Geometry"));
    std::string deep;
    for (int i = 0; i < 100; ++i) {
        deep += "Translated { Geometry ";
    }
    EXPECT_TRUE(mentions(whole(deep), "nested too deep"));
}

/// A group of groups of groups, each of ten.
TEST(ReadGeom, EndsWhereGroupsGrowWithoutEnd) {
    std::string text = "Group g0 { GeometryList [ " + kGeomTriangle + " ] }\n";
    for (int i = 1; i < 9; ++i) {
        const std::string inner = "g" + std::to_string(i - 1);
        text += "Group g" + std::to_string(i) + " { GeometryList [";
        for (int copy = 0; copy < 10; ++copy) {
            text += " " + inner + ",";
        }
        text += " ] }\n";
    }
    const ReadMesh read = read_mesh_text("geom", text + "Shape { Geometry g8 }\n");
    EXPECT_TRUE(mentions(read.faults, "it places more than 1000000 objects"));
}

TEST(ReadGeom, WarnsOfWordsThatPlantGlDoesNotKnow) {
    const std::string shape = "Shape leaf { Geometry " + kGeomTriangle + " }\n";
    const auto warnings = [](const std::string& text) {
        const ReadMesh read = read_mesh_text("geom", text);
        EXPECT_EQ(read.faults, Texts{});
        return read.warnings;
    };
    EXPECT_EQ(warnings(shape), Texts{});
    EXPECT_EQ(
        warnings(shape + "Sxape leaf_1 { Geometry " + kGeomTriangle + " }\n"),
        Texts{"file: objects of kinds that PlantGL does not know are left out: 1 in all, the first "
              "is "
              "'Sxape' in line 2; did you mean 'Shape'?"});
    EXPECT_EQ(
        warnings(
            "Shape { Geometry AxisRotated { Axis <0,0,1> Angel 90 Geometry " + kGeomTriangle +
            " } }\n"),
        Texts{"file: fields that PlantGL does not know are left out: 1 in all, the first is "
              "'Angel' in "
              "line 1; did you mean 'Angle'?"});
}

}  // namespace
}  // namespace quasimc::test
