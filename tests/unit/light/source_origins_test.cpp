// Origins of light: which sources belong to which.

#include "light/source_origins.h"

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

using Names = std::vector<std::string>;

std::shared_ptr<const Source> lamp(std::string name) {
    LampSpec spec;
    spec.name = std::move(name);
    spec.flux = {1};
    return make_lamp(std::move(spec));
}

Sources some_sources() {
    return {
        make_directional_source("noon", {0, 0, -1}, {1}), make_uniform_sky("dome", {1}),
        lamp("hps 1"), lamp("hps 2"), lamp("led")};
}

std::vector<std::size_t> origins_of(const Names& entries) {
    return source_origins(some_sources(), entries).of_source;
}

std::string faults_of(const Names& entries, const Sources& sources = some_sources()) {
    Faults faults;
    check_origins(sources, entries, faults);
    try {
        faults.throw_if_any();
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(SourceOrigins, AreKindsAndPatternsOfNames) {
    EXPECT_EQ(origins_of({"sun", "sky", "lamps"}), (std::vector<std::size_t>{0, 1, 2, 2, 2}));
    EXPECT_EQ(
        origins_of({"hps *", "led", "dome", "n*n"}), (std::vector<std::size_t>{3, 2, 0, 0, 1}));
    EXPECT_EQ(origins_of({"*"}), (std::vector<std::size_t>(5, 0)));
}

TEST(SourceOrigins, AreTheFirstThatFits) {
    EXPECT_EQ(origins_of({"hps 2", "lamps", "*"}), (std::vector<std::size_t>{2, 2, 1, 0, 1}));
}

TEST(SourceOrigins, AreOtherWhereNoneFits) {
    const SourceOrigins origins = source_origins(some_sources(), Names{"sun", "led"});
    EXPECT_EQ(origins.names, (Names{"sun", "led", "other"}));
    EXPECT_EQ(origins.of_source, (std::vector<std::size_t>{0, 2, 2, 2, 1}));
    // Entries that were completed are complete.
    EXPECT_EQ(complete_origins(some_sources(), origins.names), origins.names);
    EXPECT_EQ(source_origins(some_sources(), origins.names).of_source, origins.of_source);
    EXPECT_EQ(complete_origins(some_sources(), Names{"sun", "*"}), (Names{"sun", "*"}));
    EXPECT_TRUE(complete_origins(some_sources(), Names{}).empty());
}

TEST(SourceOrigins, AreRefusedByName) {
    EXPECT_EQ(faults_of({"sun", "hps *", "lamps"}), "");
    EXPECT_EQ(faults_of({"lamps"}, {some_sources()[0]}), "");  // of other hours
    EXPECT_EQ(
        faults_of({"lamp*"}),
        "origins: no source is called 'lamp*' (names are noon, dome, hps 1, hps 2, led); kinds are "
        "sun, sky and lamps");
    EXPECT_EQ(faults_of({"sky", "sky"}), "origins: 'sky' is given twice; give it once");
    EXPECT_EQ(
        faults_of({"sun"}, {some_sources()[0], lamp("sun")}),
        "origins: 'sun' is a kind and the name of a source (the source is of another kind); rename "
        "the source");
}

}  // namespace
}  // namespace quasimc::test
