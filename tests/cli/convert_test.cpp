// Files inspected and converted from the command line.

#include <string>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

class ConvertCommand : public ProgramTest {
  protected:
    void expect_in(const std::string& text, const std::string& part) const {
        EXPECT_NE(text.find(part), std::string::npos) << part << "\nin\n" << text;
    }
};

TEST_F(ConvertCommand, TellsWhatAGeometryFileHolds) {
    folder_.write(
        "a.can",
        "p 1 100007002001 3 0 0 1 2 0 1 0 1 1\np 1 100007002001 3 0 0 1 2 0 1 0 1 1\n"
        "p 1 100008000001 3 0 0 3 1 0 3 0 1 3\n");
    const Outcome outcome = run({"info", "a.can"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* part :
         {"file      a.can: can, ",
          "bounds    x 0 to 2 (2), y 0 to 1 (1), z 1 to 3 (2); the file has no unit",
          "organs    2\n", "material  leaf 1: 1 organ", "material  stem 1: 1 organ, area 0.5",
          "label     plant: 2 organs, 2 values: 7 8\n", "warning   "}) {
        expect_in(outcome.out, part);
    }
    EXPECT_EQ(outcome.out.find("warning   none"), std::string::npos) << "a triangle is twice there";
}

TEST_F(ConvertCommand, TellsWhatARunFileHolds) {
    const Outcome outcome = run({"info", "run.toml"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(outcome.out, "file      run.toml: run file, 1 point\nband      PAR [");
    expect_in(outcome.out, "organs    3\n");
}

TEST_F(ConvertCommand, GoesThereAndBackWithAllDigits) {
    folder_.write("a.tri", "0 0 1 1 0 1 0 1 1\n0.1 0.30000000000000004 2 1 0 2 0 1e-09 2\n");
    ASSERT_EQ(run({"convert", "a.tri", "b.stl"}).status, 0);
    ASSERT_EQ(run({"convert", "b.stl", "c.tri"}).status, 0);
    std::string back;
    std::string rest = folder_.read("c.tri");
    for (std::size_t at = rest.find('\n'); at != std::string::npos; at = rest.find('\n')) {
        back += rest.starts_with('#') ? "" : rest.substr(0, at + 1);
        rest.erase(0, at + 1);
    }
    EXPECT_EQ(back, folder_.read("a.tri"));
}

TEST_F(ConvertCommand, WarnsOfTrianglesThatItCutsAway) {
    folder_.write("a.tri", "0 0 1 1 0 1 0 1 1\n0 0 1 1 0 1 0 1 1\n");
    const Outcome outcome = run({"convert", "a.tri", "b.stl"});
    EXPECT_EQ(outcome.status, 0);
    expect_in(outcome.err, "warning: organ 'organ 2' (id 2): ");
}

TEST_F(ConvertCommand, WritesResultsForOtherPrograms) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const Outcome outcome = run({"convert", "out.json", "out.vtp"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(folder_.read("out.vtp"), "Name=\"absorbed_flux_density_PAR [W m-2]\"");
    expect_in(folder_.read("out.vtp"), "Name=\"absorbed_flux_density_PAR_standard_error [W m-2]\"");
    EXPECT_EQ(run({"convert", "out.json", "out.ply"}).status, 0);
    expect_in(folder_.read("out.ply"), "property double incident_upper_PAR_standard_error\n");
    EXPECT_EQ(run({"info", "out.ply"}).status, 0) << "our own reader passes over the numbers";
}

/// Which of the two depends on the libraries that the program was built with.
TEST_F(ConvertCommand, WritesNetcdfOrNamesTheLibraryThatItLacks) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const Outcome outcome = run({"convert", "out.json", "out.nc"});
    if (run({"list", "formats"}).out.find("not built in") != std::string::npos) {
        EXPECT_EQ(outcome.status, 1);
        expect_in(
            outcome.err,
            "NetCDF: this program can't write NetCDF (it was built without the netCDF library)");
        return;
    }
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(folder_.read("out.nc").substr(1, 3), "HDF");
    const Outcome chosen = run({"convert", "out.json", "out.nc", "--sweep-point", "1"});
    EXPECT_EQ(chosen.status, 2);
    expect_in(
        chosen.err,
        "--sweep-point: a NetCDF file has all points of a sweep (each has its place along an "
        "axis); "
        "remove it");
}

TEST_F(ConvertCommand, RefusesWhatItCannotDo) {
    const auto expect_fault = [this](const std::vector<std::string>& arguments, const char* text) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, outcome.err.starts_with("error: OUTPUT: ") ? 2 : 1)
            << outcome.err;
        expect_in(outcome.err, text);
    };
    expect_fault({"convert", "leaves.tri", "a.opf"}, "format opf can be read, not written");
    expect_fault(
        {"convert", "leaves.tri", "a.xyz"}, "is not a format that geometry can be written in");
    expect_fault({"convert", "leaves.tri", "a.mtl"}, "use tri, obj, ply, stl, can, glb\n");
    expect_fault(
        {"convert", "run.toml", "a.vtp"}, "is not a format that geometry can be written in");
    expect_fault({"convert", "leaves.tri", "leaves.tri"}, "leaves.tri");
    expect_fault({"info", "none.can"}, "none.can");
}

TEST_F(ConvertCommand, PrintsTheTableOfFormats) {
    const Outcome outcome = run({"list", "formats"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    for (const char* name :
         {"tri ", "obj ", "ply ", "stl ", "can ", "opf ", "vgx ", "vtp ", "nc "}) {
        expect_in(outcome.out, name);
    }
}

TEST_F(ConvertCommand, ShowsNamesWithoutWhatATerminalRuns) {
    folder_.write(
        "evil.toml",
        "bands = ['PAR']\n[[material]]\nname = \"m\\u001b]0;x\\u0007\"\nreflectance = 0.1\n"
        "[[source]]\ntype = 'uniform_sky'\nirradiance_horizontal = 1\n"
        "[[organ]]\nname = \"o\\u001b[2J\\u0000x\\u009b\"\nlabels = {\"k\\nwarning   none\" = "
        "\"v\"}\n"
        "material = \"m\\u001b]0;x\\u0007\"\nshape = 'triangle'\n"
        "corners = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]\n");
    const Outcome outcome = run({"info", "evil.toml"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    expect_in(outcome.out, "smallest organ 0.5 ('o [2J x ')");
    expect_in(outcome.out, "material  m ]0;x : 1 organ");
    expect_in(outcome.out, "label     k warning   none: 1 organ");
    const std::string all = outcome.out + outcome.err + run({"check", "evil.toml"}).err;
    for (const char c : {'\x1B', '\a', '\0'}) {
        EXPECT_EQ(all.find(c), std::string::npos) << static_cast<int>(c);
    }
}

TEST_F(ConvertCommand, NamesFilesThatAreNoRunFiles) {
    folder_.write("plant.obj", "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n");
    folder_.write("plant.bgeom", "GEOM");
    for (const char* command : {"run", "check"}) {
        const Outcome outcome = run({command, "plant.obj"});
        EXPECT_EQ(outcome.status, 1);
        expect_in(
            outcome.err,
            "plant.obj: is geometry, not a run file; name it in a run file, under [[geometry]]: "
            "file = \"plant.obj\"; or draw it: quasimc show plant.obj");
    }
    expect_in(
        run({"info", "plant.bgeom"}).err,
        "plant.bgeom: is a binary scene of PlantGL, not a run file (it is not supported); load it "
        "in Python with PlantGL");
    folder_.write("plant.dae", "<COLLADA/>");
    const Outcome dae = run({"convert", "plant.dae", "plant.obj"});
    EXPECT_EQ(dae.status, 1);
    expect_in(dae.err, "plant.dae: is a COLLADA file, which is not supported; make glTF of it");
}

}  // namespace
}  // namespace quasimc::test
