// Numbers of organs, back in the OPF file they came from.

#include "resultio/write_opf.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

const std::string kOpfHead = R"(<?xml version="1.0"?>
<opf version="2.0"><meshBDD><mesh Id="0"><points>0 0 1 1 0 1 0 1 1</points>
<faces><face>0 1 2</face></faces></mesh></meshBDD>
<shapeBDD><shape Id="0"><meshIndex>0</meshIndex></shape></shapeBDD>
)";
const std::string kOpfGeometry =
    "<geometry><shapeIndex>0</shapeIndex><mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry>";
/// Two leaves, one of them with an attribute, and an axis without a shape.
const std::string kOpfNodes =
    "<topology class=\"Plant\" scale=\"1\" id=\"1\">\n<decomp class=\"Leaf\" "
    "scale=\"2\" id=\"7\"><light>3</light>" +
    kOpfGeometry +
    "</decomp>\n<decomp class=\"Axis\" scale=\"2\" id=\"8\"><!-- <decomp "
    "id=\"9\"> --></decomp>\n<decomp class=\"Leaf\" scale=\"2\" id=\"9\">" +
    kOpfGeometry + "</decomp></topology></opf>\n";

Scene opf_scene(const std::string& opf, const std::string& keys = "") {
    RunText text;
    text.organs = "[[geometry]]\nfile = 'a.opf'\nmaterial = 'leaf'\n" + keys;
    return read_text(text.text(), {{"a.opf", opf}}).scene;
}

std::string written_opf(
    const std::string& opf, const FieldScene& fields, OpfMatches* matches = nullptr) {
    std::string bytes;
    const OpfMatches found =
        write_opf(opf, fields, [&](std::string_view piece) { bytes += piece; });
    if (matches != nullptr) {
        *matches = found;
    }
    return bytes;
}

std::string without(std::string text, const std::string& part) {
    const std::size_t at = text.find(part);
    EXPECT_NE(at, std::string::npos) << part << "\n" << text;
    return at == std::string::npos ? text : text.erase(at, part.size());
}

TEST(WriteOpf, AddsNumbersToNodesAndKeepsTheRest) {
    const std::string opf = kOpfHead + kOpfNodes;
    const Scene scene = opf_scene(opf);
    ASSERT_EQ(scene.organs().size(), 2U);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    OpfMatches matches;
    const std::string bytes = written_opf(
        opf, {scene, {{"flux", "W", {0.25, 1e-7}}, {"share", "", {unknown, 0.5}}}}, &matches);
    EXPECT_EQ(matches.found, 2U);
    EXPECT_EQ(matches.missing, 0U);
    // What was read back has what was written as labels.
    const ReadMesh read = read_mesh_text("opf", bytes);
    EXPECT_TRUE(read.faults.empty());
    const auto label = [&](std::size_t group, const std::string& key) {
        for (const auto& [name, value] : read.mesh.groups[group].labels) {
            if (name == key) {
                return value;
            }
        }
        return std::string("none");
    };
    EXPECT_EQ(label(0, "flux"), "0.25");
    EXPECT_EQ(std::stod(label(1, "flux")), 1e-7);
    EXPECT_EQ(label(0, "share"), "none");
    EXPECT_EQ(label(1, "share"), "0.5");
    EXPECT_EQ(label(0, "light"), "3");
    // Written again, with the same numbers, it is the same; with others it has those alone.
    const FieldScene again{scene, {{"flux", "W", {0.25, 1e-7}}, {"share", "", {unknown, 0.5}}}};
    EXPECT_EQ(written_opf(bytes, again), bytes);
    const std::string other = written_opf(bytes, {scene, {{"flux", "W", {1, 2}}}});
    EXPECT_EQ(other.find("0.25"), std::string::npos);
    // The commented node and what follows the topology stay.
    EXPECT_NE(bytes.find("<!-- <decomp id=\"9\"> -->"), std::string::npos);
    EXPECT_EQ(bytes.substr(0, 60), opf.substr(0, 60));
    EXPECT_TRUE(bytes.ends_with("</topology></opf>\n"));
}

TEST(WriteOpf, ReplacesAnAttributeOfTheSameName) {
    const std::string opf = kOpfHead + kOpfNodes;
    const Scene scene = opf_scene(opf);
    const std::string bytes = written_opf(opf, {scene, {{"light", "", {5, 6}}}});
    EXPECT_EQ(bytes.find("<light>3</light>"), std::string::npos);
    EXPECT_NE(bytes.find("5"), std::string::npos);
}

/// They would be taken away by recursion.
TEST(WriteOpf, RefusesElementsWithinElementsWithoutEnd) {
    const std::string opf = kOpfHead + kOpfNodes;
    const Scene scene = opf_scene(opf);
    std::string deep = "<light>";
    for (int i = 0; i < 300'000; ++i) {
        deep += "<a>";
    }
    for (int i = 0; i < 300'000; ++i) {
        deep += "</a>";
    }
    std::string text = opf;
    text.replace(text.find("<light>3"), std::string("<light>3").size(), deep);
    const FieldScene fields{scene, {{"light", "", {5, 6}}}};
    EXPECT_THROW(written_opf(text, fields), InputError);
}

TEST(WriteOpf, TellsOrgansThatAreNoNodes) {
    const std::string opf = kOpfHead + kOpfNodes;
    const std::string less =
        without(opf, "<decomp class=\"Leaf\" scale=\"2\" id=\"9\">" + kOpfGeometry + "</decomp>");
    const Scene scene = opf_scene(opf);
    OpfMatches matches;
    written_opf(less, {scene, {{"flux", "W", {1, 2}}}}, &matches);
    EXPECT_EQ(matches.found, 1U);
    EXPECT_EQ(matches.missing, 1U);
    const Scene renumbered = opf_scene(opf, "first_id = 100\n");
    const FieldScene fields{renumbered, {{"flux", "W", {1, 2}}}};
    EXPECT_THROW(written_opf(opf, fields), InputError);
    EXPECT_THROW(written_opf("<opf><decomp", fields), InputError);
}

}  // namespace
}  // namespace quasimc::test
