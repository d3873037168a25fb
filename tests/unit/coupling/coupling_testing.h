#pragma once

#include <map>
#include <string>
#include <vector>

#include "coupling/plant_light.h"

namespace quasimc::test {

/// Notices that are kept.
struct RecordedNotices {
    std::vector<std::string> texts;
    Notices notices{[this](const std::string& text) { texts.push_back(text); }};

    /// Whether one of them holds a word.
    [[nodiscard]] bool has(const std::string& word) const;
};

/// An environment file with all turtle lines, as both simulators write it.
[[nodiscard]] CommFile usual_format();

/// A specification from its text; `files` are those it may name.
[[nodiscard]] Specification specification(
    const std::string& text,
    RecordedNotices& kept,
    const std::map<std::string, std::string>& files = {},
    SpecificationKind kind = SpecificationKind::automatic);

/// The message of the InputError that a text causes; "" if it is good.
[[nodiscard]] std::string faults_of(
    const std::string& text, const std::map<std::string, std::string>& files = {});

/// A query for a module at a position, lying flat with its upper side up and its heading to -z, as
/// cpfg writes it.
[[nodiscard]] std::string flat(
    int id, const std::string& module, double height, const std::string& question = "E(1)");

/// The pass of a message without its Control line.
[[nodiscard]] Pass pass_of(const std::string& queries);

/// The answers to a step, by id.
[[nodiscard]] std::map<std::int64_t, std::vector<double>> answers_of(
    PlantLight& light, const std::string& queries);

/// A surface of one flat patch, a square of side 1 from the contact point along the heading.
[[nodiscard]] std::string square_surface();

}  // namespace quasimc::test
