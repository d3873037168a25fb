#include "output_choice.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "runfile/written.h"

namespace {

std::vector<std::string> split_list(std::string_view list) {
    std::vector<std::string> words;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(','), list.size());
        words.emplace_back(list.substr(0, end));
        list.remove_prefix(std::min(end + 1, list.size()));
    }
    return words;
}

}  // namespace

void add_choice_flags(OutputChoice& choice, std::vector<Flag>& flags) {
    flags.push_back(
        {.name = "--quantities",
         .target = &choice.quantities,
         .summary = "write only these quantities, comma-separated (`quasimc list quantities`, "
                    "sunlit_fraction)",
         .type_name = "NAMES",
         .group = "Output"});
    flags.push_back(
        {.name = "--bands",
         .target = &choice.bands,
         .summary = "write only these bands, comma-separated",
         .type_name = "NAMES",
         .group = "Output"});
    flags.push_back(
        {.name = "--include-night",
         .target = &choice.include_night,
         .summary = "with [time]: also write night hours",
         .group = "Output"});
}

std::vector<quasimc::Override> overrides_of(const OutputChoice& choice) {
    const quasimc::OutputSpec given{.quantities = split_list(choice.quantities)};
    return quasimc::needs_parts(given)
               ? std::vector<quasimc::Override>{{"sun_shade", "apart", "--quantities"}}
               : std::vector<quasimc::Override>{};
}

void apply_choice(const OutputChoice& choice, quasimc::RunFile& run) {
    quasimc::OutputSpec given;
    given.quantities = split_list(choice.quantities);
    given.bands = split_list(choice.bands);
    quasimc::Faults wrong;
    quasimc::check_written(given, run.scene.bands(), wrong);
    quasimc::Faults faults;
    for (quasimc::Fault fault : wrong.all()) {
        fault.where = "--" + fault.where;
        faults.add(std::move(fault));
    }
    if (choice.include_night && !run.series) {
        faults.add({"--include-night", "the run has no [time]", "night hours need [time]", ""});
    }
    faults.throw_if_any();
    quasimc::OutputSpec& output = run.output;
    output.quantities = given.quantities.empty() ? output.quantities : given.quantities;
    output.bands = given.bands.empty() ? output.bands : given.bands;
    output.include_night = output.include_night || choice.include_night;
}
