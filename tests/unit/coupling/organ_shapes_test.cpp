#include "coupling/vlab/organ_shapes.h"

#include <numbers>

#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

class OrganShapesTest : public ::testing::Test {
  protected:
    OrganShape make(const std::string& module, const std::string& text = "") {
        spec_ = specification(text, cached_, {{"leaf.s", square_surface()}});
        const Pass pass = pass_of(flat(0, module, 1));
        return OrganShapes(spec_, cached_.notices).make(pass, pass.queries.front());
    }
    static Vec3 normal(const OrganShape& shape) {
        Vec3 sum;
        for (const Triangle& t : shape.triangles) {
            sum += area_vector(t);
        }
        return sum;
    }

    RecordedNotices cached_;
    Specification spec_;
};

TEST_F(OrganShapesTest, HaveTheAreasOfTheirModules) {
    EXPECT_NEAR(area(make("P(0.5,2)").triangles), 1, 1e-12);
    EXPECT_NEAR(area(make("T(0.5,2)").triangles), 1, 1e-12);
    EXPECT_NEAR(area(make("U(1,2,3,90)").triangles), 4.5, 1e-12);
    EXPECT_NEAR(area(make("U(1,2,3,-30)").triangles), 2.25, 1e-12);
    EXPECT_NEAR(area(make("S(0,2)", "surface: leaf.s 0").triangles), 4, 1e-12);
    EXPECT_NEAR(area(make("S(0,2,3)", "surface: leaf.s 0").triangles), 6, 1e-12);
    EXPECT_NEAR(
        area(make("I(0.1,2)", "cylinder sides: 5").triangles), 0.4 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(
        area(make("I(0.1,2)", "cylinder width: diameter").triangles), 0.2 * std::numbers::pi,
        1e-12);
}

TEST_F(OrganShapesTest, HaveTheirUpperSideTowardsUp) {
    for (const char* module : {"P(0.5,2)", "T(0.5,2)", "U(1,2,3,60)", "U(1,2,3,-60)", "S(0,2)"}) {
        EXPECT_GT(normal(make(module, "surface: leaf.s 0")).y, 0) << module;
    }
}

TEST_F(OrganShapesTest, HaveTheUpperSideOfEitherSimulator) {
    // The same leaf from cpfg (up = left x heading) and lpfg (up = heading x left).
    spec_ = specification("", cached_);
    const std::string frame = " 0 1 0\n 0 0 -1\n -1 0 0\n";
    const Pass pass =
        pass_of("0 E(1)P(1,1)\n" + frame + " 0 -1 0\n1 E(1)P(1,1)\n" + frame + " 0 1 0\n");
    OrganShapes shapes(spec_, cached_.notices);
    EXPECT_LT(normal(shapes.make(pass, pass.queries[0])).y, 0);
    EXPECT_GT(normal(shapes.make(pass, pass.queries[1])).y, 0);
}

TEST_F(OrganShapesTest, StandAtTheTurtle) {
    const OrganShape shape = make("P(0.5,2)");  // at height 1, heading to -z
    EXPECT_EQ(shape.triangles.front()[0], (Vec3{0, 1, 0}));
    double nearest = 0;
    for (const Triangle& t : shape.triangles) {
        for (const Vec3& p : t) {
            nearest = std::min(nearest, p.z);
            EXPECT_EQ(p.y, 1);
        }
    }
    EXPECT_EQ(nearest, -2);
}

TEST_F(OrganShapesTest, HaveOutsidesUpOnCylinders) {
    const OrganShape shape = make("I(0.5,2)");
    for (const Triangle& t : shape.triangles) {
        const Vec3 middle = (t[0] + t[1] + t[2]) / 3;
        EXPECT_GT(dot(area_vector(t), {middle.x, middle.y - 1, 0}), 0);
    }
}

const std::string kMaterials =
    "leaf material (top): 0.1 10 0.1 10\nleaf material (bottom): 0.2 10 0.2 10\n"
    "material: 0.3 10 0.3 10\nsurface: leaf.s 0\n";

TEST_F(OrganShapesTest, TakeTheirMaterials) {
    EXPECT_EQ(make("P(1,1)", kMaterials).materials, (SideMaterials{0, 1}));
    EXPECT_EQ(make("P(1,1,2)", kMaterials).materials, (SideMaterials{2, 2}));
    EXPECT_EQ(make("P(1,1,2,0)", kMaterials).materials, (SideMaterials{2, 0}));
    EXPECT_EQ(make("U(1,1,1,90,2)", kMaterials).materials, (SideMaterials{2, 2}));
    EXPECT_EQ(make("I(1,1,2)", kMaterials).materials, (SideMaterials{2, 2}));
    EXPECT_EQ(make("S(0,1)", kMaterials).materials, (SideMaterials{0, 1}));
    EXPECT_EQ(
        make("S(0,1,2)", kMaterials + "material parameter: 3\n").materials, (SideMaterials{2, 2}));
    EXPECT_EQ(
        make("S(2,1)", kMaterials + "material parameter: 1\n").materials, (SideMaterials{0, 1}));
    EXPECT_EQ(make("P(1,1,9)", kMaterials).materials, (SideMaterials{0, 1}));
    EXPECT_TRUE(cached_.has("uses material 9"));
}

TEST_F(OrganShapesTest, NameWhatTheyDoNotUnderstandOnce) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_TRUE(make("X(1,1)").triangles.empty());
    }
    EXPECT_TRUE(cached_.has("module 'X' is unknown"));
    EXPECT_EQ(cached_.texts.size(), 1U);
    EXPECT_TRUE(make("Plant(1,1)").triangles.empty());
    EXPECT_TRUE(cached_.has("'Plant'"));
}

TEST_F(OrganShapesTest, WithoutSizeAreNothing) {
    EXPECT_TRUE(make("P(0,1)").triangles.empty());  // a bud that has not grown
    EXPECT_TRUE(cached_.texts.empty());
    for (const char* module :
         {"P(-1,1)", "T(nan,1)", "U(1,1,1,91)", "S(3,1)", "I(1,inf)", "P(1)"}) {
        EXPECT_TRUE(make(module, "surface: leaf.s 0").triangles.empty()) << module;
    }
    EXPECT_GE(cached_.texts.size(), 5U);
}

TEST_F(OrganShapesTest, TellOfParametersInNumbersThatAgree) {
    EXPECT_TRUE(make("P()").triangles.empty());
    EXPECT_TRUE(cached_.has("has 1 parameter; 2 are needed")) << cached_.texts.front();
    EXPECT_TRUE(make("U(1,2)").triangles.empty());
    EXPECT_TRUE(cached_.has("has 2 parameters; 4 are needed"));
}

TEST_F(OrganShapesTest, TellOfMaterialsThatAreNoWholeNumbers) {
    const std::string two = "leaf material (top): 1 0 0 0\nmaterial: 0.5 0 0 0\n";
    EXPECT_FALSE(make("P(1,1,1)", two).triangles.empty());
    EXPECT_TRUE(cached_.texts.empty());
    EXPECT_EQ(make("P(1,1,0.7)", two).materials.upper, 0U) << "what stands before the point";
    EXPECT_TRUE(cached_.has("uses material 0.7; text after the point is ignored"));
}

TEST_F(OrganShapesTest, TellOfPolygonsByTheirLines) {
    spec_ = specification("", cached_);
    const std::string turtle = " 0 0 0\n 0 0 -1\n -1 0 0\n 0 1 0\n";
    const Pass pass = pass_of(
        "0 E(1)\n" + turtle + "Dbegin\npolygon\n 0 0 0\n 1 0 0\n 0 0 1\npolygon\n 0 0 0\nDend\n" +
        "1 E(1)M(1)\n" + turtle + "Dbegin\npolygon\n 0 0 0\n 1 0 0\n 2 0 0\nDend\n");
    OrganShapes shapes(spec_, cached_.notices);
    EXPECT_EQ(shapes.make(pass, pass.queries[0]).triangles.size(), 1U);
    EXPECT_TRUE(cached_.has(
        "query 0, without a module, has a polygon (line 11 of its message) of 1 corner"))
        << cached_.texts.front();
    static_cast<void>(shapes.make(pass, pass.queries[1]));
    EXPECT_TRUE(
        cached_.has("module M (query 1) has a polygon (line 20 of its message) without area"))
        << cached_.texts.back();
}

TEST_F(OrganShapesTest, OfPolygonsAddUp) {
    spec_ = specification("", cached_);
    const std::string turtle = " 0 0 0\n 0 0 -1\n -1 0 0\n 0 1 0\n";
    const Pass pass = pass_of(
        "0 E(1)M(1)\n" + turtle +
        "Dbegin\npolygon\n 0 0 0\n 1 0 0\n 1 0 0\n 1 0 1\n 0 0 1\n"  // a square
        "polygon\n 2 0 0\n 5 0 0\n 3 0 0.5\n 2 0 2\nDend\n");        // a dart, not convex
    const OrganShape shape = OrganShapes(spec_, cached_.notices).make(pass, pass.queries.front());
    EXPECT_NEAR(area(shape.triangles), 1 + 1.75, 1e-12);
    EXPECT_GT(normal(shape).y, 0);
    EXPECT_TRUE(cached_.texts.empty());
}

TEST_F(OrganShapesTest, OfPolygonsWhoseSidesCrossAreFans) {
    spec_ = specification("", cached_);
    const std::string turtle = " 0 0 0\n 0 0 -1\n -1 0 0\n 0 1 0\n";
    const Pass pass = pass_of(
        "0 E(1)M(1)\n" + turtle +
        "Dbegin\npolygon\n 0 0 0\n 4 0 0\n 4 0 2\n 2 0 -1\n 0 0 2\nDend\n"
        "1 E(1)M(1)\n" +
        turtle + "Dbegin\npolygon\n 0 0 0\n 1e200 0 0\n 1e200 0 1e200\n 0 0 1e200\nDend\n");
    OrganShapes shapes(spec_, cached_.notices);
    const OrganShape fan = shapes.make(pass, pass.queries[0]);
    ASSERT_EQ(fan.triangles.size(), 3U);
    EXPECT_NEAR(area(fan.triangles), 4 + 4 + 2, 1e-12);
    for (const Triangle& t : fan.triangles) {
        EXPECT_GT(area_vector(t).y, 0);
    }
    EXPECT_TRUE(cached_.has("divided into a fan"));
    RecordedNotices of_huge;
    EXPECT_TRUE(OrganShapes(spec_, of_huge.notices).make(pass, pass.queries[1]).triangles.empty());
    EXPECT_TRUE(of_huge.has("left out"));
}

}  // namespace
}  // namespace quasimc::test
