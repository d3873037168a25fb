// What the run file makes of the rows of the catalogues: models, kinds of sources, formats,
// samplers. Every row is tried, also one that was entered a minute ago.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "base/text.h"
#include "io/runfile/document.h"
#include "io/runfile/run_file_source_kinds.h"
#include "io_testing.h"
#include "optics/catalogue.h"
#include "samplers/catalogue.h"
#include "sources/catalogue.h"

namespace quasimc::test {
namespace {

/// What a run file with a leaf of such keys says of it.
std::vector<std::string> faults_of_leaf(const std::string& keys) {
    RunText text;
    text.materials = "[[material]]\nname = 'leaf'\nreflectance = 0.1\n" + keys;
    return faults_of(text.text());
}

/// The keys of all parameters of a model but one.
std::string keys_of(const BsdfEntry& model, std::string_view word, std::string_view left_out) {
    std::string keys = fmt::format("{}_model = '{}'\n", word, model.name);
    for (const BsdfParameter& p : model.parameters) {
        if (p.name != left_out) {
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

/// What must be stated before a reader asks for the key.
std::string asked_first(const SourceEntry& kind, const SourceKey& key) {
    if (kind.name == "sun" && key.name == "delta_t_s") {
        return "time = 2024-06-21T12:00:00Z\n";
    }
    return kind.name == "spot" && key.name != "cone_deg" ? "cone_deg = 20\n" : "";
}

TEST(Catalogues, EveryKindOfSourceTakesTheKeysOfItsRow) {
    for (const SourceEntry& kind : source_catalogue()) {
        EXPECT_EQ(find_source(kind.name), &kind);
        EXPECT_FALSE(kind.summary.empty() || kind.words.empty()) << kind.name;
        for (const SourceKey& key : kind.keys) {
            const std::string keys = fmt::format("{} = true\n", key.name);
            const auto faults = faults_of_source(kind.name, keys + asked_first(kind, key));
            EXPECT_FALSE(faults.empty()) << kind.name << " " << key.name;
            EXPECT_FALSE(mentions(faults, "unknown key")) << kind.name << " " << key.name;
        }
        EXPECT_TRUE(mentions(faults_of_source(kind.name, "colour = 3\n"), "unknown key 'colour'"))
            << kind.name;
    }
    EXPECT_EQ(find_source("moon"), nullptr);
    EXPECT_TRUE(mentions(faults_of_source("sunn", ""), "did you mean 'sun'?"));
}

TEST(Catalogues, AKindThatItsRowTellsAllOfStatesItsLight) {
    for (const SourceEntry& kind : source_catalogue()) {
        EXPECT_TRUE(kind.make == nullptr || kind.amount != SourceAmount::other) << kind.name;
        for (const SourceKey& key : kind.keys) {
            EXPECT_EQ(key.type == SourceKeyType::other, kind.make == nullptr) << kind.name;
        }
    }
}

// A kind of source that stands here alone: a lamp with keys of every type.
std::shared_ptr<const Source> make_torch(const StatedSource& stated) {
    return make_directional_source(stated.name, stated.vectors.at("aim"), stated.spectrum);
}
constexpr std::array kTorchKeys{
    SourceKey{"width", "of its cone", SourceKeyType::number, 0, 90, 15.0},
    SourceKey{"height", "above its foot", SourceKeyType::number, 0, 10},
    SourceKey{"position", "where it stands", SourceKeyType::position},
    SourceKey{"aim", "where it shines", SourceKeyType::direction}};

SourceEntry torch(SourceAmount amount) {
    return {"torch", "torch", "a torch", amount, kTorchKeys, make_torch};
}

/// A torch as it is read, and what is said of it.
struct ReadTorch {
    std::optional<NotedSource> noted;
    std::vector<std::string> faults;
};
ReadTorch read_torch(const std::string& keys, SourceAmount amount) {
    Reporter reporter{"run.toml", {}, {}};
    RunFileContext context{};
    context.reporter = &reporter;
    context.bands = {{"PAR", "W m-2"}};
    context.orientation = Orientation(UpAxis::y, {1, 0, 0});
    context.length_unit = "cm";
    const Node node = read_toml(keys, "run.toml");
    TableReader table(node, "source 'torch'", reporter);
    ReadTorch read{read_stated_source(torch(amount), table, "torch", context), {}};
    table.finish();
    try {
        reporter.faults.throw_if_any();
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            read.faults.push_back(fault.text());
        }
    }
    return read;
}

TEST(StatedSources, AreMadeFromTheKeysOfTheirRow) {
    const ReadTorch read = read_torch(
        "height = 2\nposition = [1, 2, 3]\naim = [0, -4, 0]\npower = 5\n", SourceAmount::flux);
    ASSERT_TRUE(read.noted) << ::testing::PrintToString(read.faults);
    EXPECT_EQ(read.noted->source->horizontal_irradiance(), 1) << "it aims down, and y is up";
    EXPECT_DOUBLE_EQ(read.noted->source->spectrum()[0], 5e4) << "W per square metre of cm";
    EXPECT_EQ(
        read.noted->note,
        "torch: torch, width 15, height 2, position (1, 2, 3), aim (0, -1, 0), emits PAR 5 W");
}

TEST(StatedSources, MayStateAnIrradiance) {
    const std::string keys = "height = 2\nwidth = 3\nposition = [1, 2, 3]\naim = [0, -4, 0]\n";
    const ReadTorch facing =
        read_torch(keys + "irradiance_facing = 7\n", SourceAmount::irradiance_facing);
    ASSERT_TRUE(facing.noted);
    EXPECT_TRUE(mentions({facing.noted->note}, "irradiance on the plane facing it: PAR 7 W m-2"));
    const ReadTorch level =
        read_torch(keys + "irradiance_horizontal = 7\n", SourceAmount::irradiance_horizontal);
    ASSERT_TRUE(level.noted);
    EXPECT_TRUE(mentions({level.noted->note}, "irradiance on the horizontal: PAR 7 W m-2"));
}

TEST(StatedSources, ReportEveryKeyThatIsMissingOrOutOfItsDomain) {
    const ReadTorch read = read_torch("width = 91\naim = [0, 0, 0]\n", SourceAmount::flux);
    EXPECT_FALSE(read.noted);
    for (const std::string_view problem :
         {"width is 91", "height is missing", "position is missing", "aim is [0, 0, 0]",
          "what it emits is missing"}) {
        EXPECT_TRUE(mentions(read.faults, problem))
            << problem << ::testing::PrintToString(read.faults);
    }
    EXPECT_EQ(read.faults.size(), 5U);
}

/// docs/theory/NAME.md with hyphens.
bool has_page(std::string_view folder, std::string_view name) {
    std::string page(name);
    std::replace(page.begin(), page.end(), '_', folder == "theory" ? '-' : '_');
    const std::filesystem::path root = QUASIMC_SOURCE_DIR;
    return std::filesystem::exists(root / "docs" / folder / (page + ".md"));
}

TEST(Catalogues, EveryMemberIsDescribedOnAPage) {
    for (const BsdfEntry& model : bsdf_catalogue()) {
        EXPECT_TRUE(has_page("theory", model.name)) << model.name;
    }
    for (const FormatEntry& format : format_table()) {
        EXPECT_TRUE(has_page("formats", format.name)) << format.name;
    }
    const std::string manual = repository_file("docs/formats/run-file.md");
    for (const SourceEntry& kind : source_catalogue()) {
        const bool is_in_manual = manual.find(fmt::format("\"{}\"", kind.name)) != manual.npos;
        EXPECT_TRUE(is_in_manual || has_page("theory", kind.name)) << kind.name;
    }
    const std::string point_sets = repository_file("docs/theory/point-sets.md");
    for (const SamplerEntry& sampler : sampler_catalogue()) {
        const bool is_told = point_sets.find(sampler.name) != point_sets.npos;
        EXPECT_TRUE(is_told || has_page("theory", sampler.name)) << sampler.name;
    }
    EXPECT_FALSE(has_page("theory", "nothing"));
}

}  // namespace
}  // namespace quasimc::test
