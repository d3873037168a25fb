#include <algorithm>
#include <iterator>

#include "base/checks.h"
#include "base/shown_faults.h"
#include "base/text.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

std::string joined(const std::vector<Fault>& faults) {
    std::string text;
    for (const std::string& line : shown_faults(faults)) {
        text += (text.empty() ? "" : "\n") + line;
    }
    return text;
}

/// Makes texts from untrusted files printable: their terminal escapes must not reach a terminal,
/// nor their invalid bytes a text of Python.
std::vector<Fault> printable_faults(std::vector<Fault> faults) {
    for (Fault& fault : faults) {
        for (std::string* text : {&fault.where, &fault.problem, &fault.why, &fault.suggestion}) {
            *text = printable(*text);
        }
    }
    return faults;
}

}  // namespace

std::string Fault::text() const {
    std::string text = where.empty() ? problem : where + ": " + problem;
    if (!why.empty()) {
        text += " (" + why + ")";
    }
    if (!suggestion.empty()) {
        text += "; " + suggestion;
    }
    return text;
}

std::vector<std::string> shown_faults(const std::vector<Fault>& faults) {
    constexpr std::size_t kMaxShown = 50;
    std::vector<std::string> lines;
    const std::size_t shown = std::min(faults.size(), kMaxShown);
    std::transform(
        faults.begin(), faults.begin() + static_cast<std::ptrdiff_t>(shown),
        std::back_inserter(lines), [](const Fault& fault) { return fault.text(); });
    if (shown < faults.size()) {
        lines.push_back("... and " + std::to_string(faults.size() - shown) + " more");
    }
    return lines;
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(printable(joined(faults))), faults_(printable_faults(std::move(faults))) {
    EXPECT(!faults_.empty());
}

void Faults::add(const InputError& error) {
    faults_.insert(faults_.end(), error.faults().begin(), error.faults().end());
}

void Faults::add(const Faults& others) {
    faults_.insert(faults_.end(), others.faults_.begin(), others.faults_.end());
}

void Faults::throw_if_any() const {
    if (!faults_.empty()) {
        throw InputError(faults_);
    }
}

}  // namespace quasimc
