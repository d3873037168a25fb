#include "resultio/read_controls.h"

#include <cstdint>

#include "quasimc/error.h"
#include "resultio/read_nodes.h"
#include "resultio/read_rows.h"

namespace quasimc {
namespace {

std::size_t length_of(const Node* list) {
    const auto* items = list != nullptr ? list->as<Node::List>() : nullptr;
    return items != nullptr ? items->size() : 0;
}

/// Reads one control.
class OutcomeReader {
  public:
    OutcomeReader(const Node& control, const TimeSeries& series, const std::string& path)
        : control_(control), series_(series), path_(path) {}

    [[nodiscard]] ControlOutcome read() const {
        const Node* found = control_.find("lamps");
        const auto* lamps = found != nullptr ? found->as<std::int64_t>() : nullptr;
        check(lamps != nullptr && *lamps >= 0, "lamps");
        ControlOutcome outcome{.lamps = static_cast<std::size_t>(*lamps), .has_file_units = true};
        const Node* steps = control_.find("time_steps");
        check(length_of(steps) == series_.notes.size(), "time steps");
        for (std::size_t i = 0; i < series_.notes.size(); ++i) {
            const Node& step = *item_at(steps, i);
            check(text_in(step, "time") == series_.notes[i].time, "time steps");
            outcome.steps.push_back(
                {number_in(step, "factor"), number_in(step, "on"), number_in(step, "kwh"),
                 estimate_in(&step, "daylight"), estimate_in(&step, "lamps"),
                 estimate_in(&step, "light"), flag_in(step, "is_near_threshold")});
        }
        const Node* days = control_.find("days");
        check(length_of(days) == series_.days.size(), "days");
        for (std::size_t i = 0; i < series_.days.size(); ++i) {
            const Node& day = *item_at(days, i);
            check(text_in(day, "date") == series_.days[i], "days");
            outcome.days.push_back(
                {number_in(day, "hours_on"), number_in(day, "kwh"),
                 number_in(day, "hours_near_threshold"), estimate_in(&day, "lamps"),
                 estimate_in(&day, "light")});
        }
        return outcome;
    }

    void check(bool is_same, const std::string& what) const {
        if (!is_same) {
            throw InputError(
                {{path_, "'control' has other " + what + " than the run", "the file is damaged",
                  ""}});
        }
    }

  private:
    const Node& control_;
    const TimeSeries& series_;
    const std::string& path_;
};

}  // namespace

std::vector<ControlOutcome> read_controls(
    const Node& rest, std::size_t point, const RunFile& run, const std::string& path) {
    const Node* at = run.sweep ? item_at(rest.find("points"), point) : &rest;
    const Node* list = at != nullptr ? at->find("control") : nullptr;
    std::vector<ControlOutcome> outcomes;
    if (list == nullptr || !run.series) {
        return outcomes;
    }
    for (std::size_t k = 0; k < run.series->controls.size(); ++k) {
        const Node none, *control = item_at(list, k);
        const OutcomeReader reader(control != nullptr ? *control : none, *run.series, path);
        reader.check(
            length_of(list) == run.series->controls.size() &&
                text_in(*control, "sources") == run.series->controls[k].sources,
            "controls");
        outcomes.push_back(reader.read());
    }
    return outcomes;
}

}  // namespace quasimc
