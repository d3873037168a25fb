#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "scene/scene.h"
#include "text/document.h"
#include "text/little_endian.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::string written_glb(const Scene& scene) {
    std::string bytes;
    write_geometry(*find_format("glb"), scene, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

/// The JSON of a GLB file.
Node glb_json(const std::string& bytes) {
    return read_json(bytes.substr(20, little_endian_at<std::uint32_t>(bytes, 12)), "file");
}

MaterialSpec plain_material(const std::string& name) {
    SideOptics side;
    side.reflectance = 0.5;
    return {name, {side}, {side}};
}

TEST(WriteGlb, IsOfTheSizeThatItStates) {
    const std::string bytes = written_glb(read_text(RunText().text()).scene);
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(little_endian_at<std::uint32_t>(bytes, 8), bytes.size());
    EXPECT_EQ(bytes.size() % 4, 0U);
}

/// Blender and others take lengths for metres and y for up.
TEST(WriteGlb, IsInMetresWithYUp) {
    RunText text;
    text.top += "length_unit = 'cm'\n";
    text.organs =
        "[[organ]]\nmaterial = 'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 100], [200, 0, 100], [0, 300, 100]]\n";
    const Node json = glb_json(written_glb(read_text(text.text()).scene));
    const Node& node = json.find("nodes")->as<Node::List>()->front();
    const Node::List& origin = *node.find("translation")->as<Node::List>();
    EXPECT_DOUBLE_EQ(*origin[0].as<double>(), 1);
    EXPECT_DOUBLE_EQ(*origin[1].as<double>(), 1);
    EXPECT_DOUBLE_EQ(*origin[2].as<double>(), -1.5);
}

TEST(WriteGlb, ComesBackInTheUnitAndTheAxesOfTheScene) {
    for (const char* top :
         {"length_unit = 'cm'\n", "up = 'y'\n", "length_unit = 'mm'\nup = 'y'\n"}) {
        RunText text;
        text.top += top;
        const Scene scene = read_text(text.text()).scene;
        text.organs = "[[geometry]]\nfile = 'a.glb'\n";
        const Scene back = read_text(text.text(), {{"a.glb", written_glb(scene)}}).scene;
        ASSERT_EQ(back.triangle_count(), 1U);
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 apart = data_of(back).triangles()[0][i] - data_of(scene).triangles()[0][i];
            EXPECT_LT(length(apart), 1e-6) << top;
        }
    }
}

TEST(WriteGlb, WarnsOfAUnitThatIsNotKnown) {
    RunText text;
    text.top += "length_unit = 'rods'\n";
    const Scene scene = read_text(text.text()).scene;
    text.organs = "[[geometry]]\nfile = 'a.glb'\n";
    const RunFile run = read_text(text.text(), {{"a.glb", written_glb(scene)}});
    EXPECT_TRUE(mentions(warning_texts(run.warnings), "the scene's unit 'rods'"));
}

/// Copies of a mesh are written at their positions.
TEST(WriteGlb, WritesEachCopyOfAMeshThatIsStoredOnce) {
    std::string tri;
    for (int i = 1; i <= 100; ++i) {
        tri += fmt::format("0 0 {0} 1 0 {0} 0 1 {0}\n", i);
    }
    RunText text;
    text.organs =
        "[[geometry]]\nfile = 'a.tri'\nmaterial = 'leaf'\norgans = 'one'\n"
        "at = [[0, 0, 0], [5, 0, 0], [9, 0, 0]]\n";
    const Scene scene = read_text(text.text(), {{"a.tri", tri}}).scene;
    ASSERT_EQ(data_of(scene).triangles().instances().size(), 3U);
    const ReadMesh read = read_mesh_text("glb", written_glb(scene));
    EXPECT_EQ(read.faults, std::vector<std::string>{});
    const std::vector<Triangle> back = triangles_of(read.mesh);
    ASSERT_EQ(back.size(), 300U);
    EXPECT_EQ(back[1], (Triangle{Vec3{0, 0, 2}, Vec3{1, 0, 2}, Vec3{0, 1, 2}}));
    EXPECT_EQ(back[101], (Triangle{Vec3{5, 0, 2}, Vec3{6, 0, 2}, Vec3{5, 1, 2}}));
}

/// A number near `middle`.
double drawn_near(double middle, double size) {
    return middle + size * (*rc::gen::inRange(-1000000, 1000001)) / 1e6;
}

/// Organs of a few triangles of two materials, anywhere: map coordinates as well.
RC_GTEST_PROP(WriteGlb, RoundTripsIdsNamesLabelsMaterialsAndTriangles, ()) {
    SceneBuilder builder({{"PAR"}});
    builder.add_material(plain_material("leaf"));
    builder.add_material(plain_material("\"stem\" \\ 1"));
    const double middle = *rc::gen::element(0.0, 1e-3, 5e6);
    const auto organs = *rc::gen::inRange(1, 5);
    for (int i = 0; i < organs; ++i) {
        OrganSpec organ;
        organ.id = 10 * (organs - i);
        organ.name = "organ " + std::to_string(*rc::gen::inRange(0, 3));
        organ.labels = {{"plant", std::to_string(i)}, {"kind", "<leaf>"}};
        int planes = 0;
        for (const char* material : {"leaf", "\"stem\" \\ 1"}) {
            Mesh mesh;
            for (int t = *rc::gen::inRange(1, 4); t > 0; --t) {
                // In planes of their own: what lies on each other is cut away.
                const double z = 10 * i + ++planes;
                Vec3 p{drawn_near(middle, 1), drawn_near(-middle, 1), drawn_near(z, 0.4)};
                mesh.push_back({p, p + Vec3{drawn_near(2, 1), 0, 0}, p + Vec3{0.3, 1, 0}});
            }
            organ.parts.push_back({material, mesh});
        }
        builder.add_organ(std::move(organ));
    }
    const Scene scene = std::move(builder).build();
    ReadMesh read = read_mesh_text("glb", written_glb(scene));
    RC_ASSERT(read.faults.empty());
    RC_ASSERT(read.warnings.empty());
    RC_ASSERT(read.mesh.groups.size() == scene.organs().size());
    std::size_t region = 0;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        const MeshGroup& group = read.mesh.groups[i];
        RC_ASSERT(group.id == organ.id);
        RC_ASSERT(group.name == organ.name);
        RC_ASSERT(group.labels == organ.labels);
        for (const MeshPart& part : group.parts) {
            RC_ASSERT(part.material == scene.material_name(scene.regions()[region++]));
        }
    }
    const std::vector<Triangle> back = triangles_of(read.mesh);
    RC_ASSERT(back.size() == scene.triangle_count());
    for (std::size_t i = 0; i < back.size(); ++i) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            RC_ASSERT(length(back[i][corner] - data_of(scene).triangles()[i][corner]) < 4e-7);
        }
    }
}

}  // namespace
}  // namespace quasimc::test
