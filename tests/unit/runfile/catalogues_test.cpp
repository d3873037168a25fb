// What the run file makes of the rows of the catalogues: models, kinds of sources, formats,
// samplers. Every row is tried, also one that was entered a minute ago.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "light/models/catalogue.h"
#include "optics/catalogue.h"
#include "samplers/catalogue.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// What a run file with a leaf of such keys says of it.
std::vector<std::string> faults_of_leaf(const std::string& keys) {
    RunText text;
    text.materials = "[[material]]\nname = 'leaf'\nreflectance = 0.1\n" + keys;
    return faults_of(text.text());
}

/// The keys of all parameters of a model but one.
std::string keys_of(const BsdfEntry& model, std::string_view word, std::string_view omitted) {
    std::string keys = fmt::format("{}_model = '{}'\n", word, model.name);
    for (const BsdfParameter& p : model.parameters) {
        if (p.name != omitted) {
            keys += fmt::format("{}_{} = {}\n", word, p.name, shortest(p.usual.value_or(p.high)));
        }
    }
    return keys;
}

TEST(Catalogues, EveryParameterOfAModelIsAKeyWithItsDomain) {
    for (const BsdfEntry& model : bsdf_catalogue()) {
        for (const std::string_view word : {"reflection", "transmission"}) {
            SCOPED_TRACE(fmt::format("{} {}", model.name, word));
            EXPECT_TRUE(faults_of_leaf(keys_of(model, word, "")).empty());
            for (const BsdfParameter& p : model.parameters) {
                const std::string others = keys_of(model, word, p.name);
                EXPECT_EQ(
                    mentions(faults_of_leaf(others), fmt::format("{}_{} is missing", word, p.name)),
                    !p.usual);
                const std::string beyond =
                    fmt::format("{}{}_{} = {}\n", others, word, p.name, shortest(2 * p.high + 1));
                EXPECT_TRUE(mentions(faults_of_leaf(beyond), std::string(p.name) + " is "));
            }
        }
    }
}

TEST(Catalogues, AParameterThatNoModelHasIsUnknown) {
    EXPECT_TRUE(mentions(
        faults_of_leaf("reflection_roughness = 1\n"), "unknown key 'reflection_roughness'"));
}

std::vector<std::string> faults_of_source(std::string_view kind, const std::string& keys) {
    RunText text;
    text.sources = fmt::format("[[source]]\ntype = '{}'\n{}", kind, keys);
    return faults_of(text.text());
}

TEST(Catalogues, EveryKindOfSourceHasAReader) {
    for (const SourceEntry& kind : source_catalogue()) {
        EXPECT_EQ(find_source(kind.name), &kind);
        EXPECT_FALSE(kind.summary.empty() || kind.words.empty()) << kind.name;
        EXPECT_TRUE(mentions(faults_of_source(kind.name, "colour = 3\n"), "unknown key 'colour'"))
            << kind.name;
    }
    EXPECT_EQ(find_source("moon"), nullptr);
    EXPECT_TRUE(mentions(faults_of_source("sunn", ""), "did you mean 'sun'?"));
}

/// Whether docs/FOLDER/NAME.md exists, in docs/theory with hyphens.
bool has_page(std::string_view folder, std::string_view name) {
    std::string page(name);
    std::replace(page.begin(), page.end(), '_', folder == "theory" ? '-' : '_');
    const std::filesystem::path root = QUASIMC_SOURCE_DIR;
    return std::filesystem::exists(root / "docs" / folder / (page + ".md"));
}

TEST(Catalogues, EveryMemberIsDescribedOnAPage) {
    const std::string models = repository_file("docs/theory/leaf-and-soil-models.md");
    for (const BsdfEntry& model : bsdf_catalogue()) {
        const bool is_section = models.find(fmt::format("`{}`", model.name)) != models.npos;
        EXPECT_TRUE(is_section || has_page("theory", model.name)) << model.name;
    }
    for (const FormatEntry& format : format_table()) {
        EXPECT_TRUE(has_page("reference", format.name)) << format.name;
    }
    const std::string manual = repository_file("docs/reference/run-file.md");
    for (const SourceEntry& kind : source_catalogue()) {
        const bool is_in_manual = manual.find(fmt::format("\"{}\"", kind.name)) != manual.npos;
        EXPECT_TRUE(is_in_manual || has_page("theory", kind.name)) << kind.name;
    }
    const std::string point_sets = repository_file("docs/theory/point-sets.md");
    for (const SamplerEntry& sampler : sampler_catalogue()) {
        const bool is_named = point_sets.find(sampler.name) != point_sets.npos;
        EXPECT_TRUE(is_named || has_page("theory", sampler.name)) << sampler.name;
    }
    EXPECT_FALSE(has_page("theory", "nothing"));
}

}  // namespace
}  // namespace quasimc::test
