// Reads [[control]]: lamps that are switched and dimmed by the light at sensors.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "results/units.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr Range kLightAboveZero{1e-12, 1e15};

/// A set of sensors, as its table names it.
struct NamedSensors {
    std::string name;
    bool is_sphere = false;
};

std::vector<NamedSensors> named_sensors(const Scene& scene) {
    std::vector<NamedSensors> sets;
    for (const SensorSet& set : scene.sensors()) {
        sets.push_back({set.name, set.receiver == Receiver::sphere});
    }
    return sets;
}

/// The sets of [[sensors]], whose faults its own reader reports.
std::vector<NamedSensors> named_sensors(TableReader& top) {
    std::vector<NamedSensors> sets;
    const Node* node = top.any("sensors");
    const auto* tables = node == nullptr ? nullptr : node->as<Node::List>();
    for (const Node& table : tables == nullptr ? Node::List() : *tables) {
        const auto text = [&](std::string_view key, const char* usual) {
            const Node* value = table.find(key);
            const auto* given = value == nullptr ? nullptr : value->as<std::string>();
            return given == nullptr ? std::string(usual) : *given;
        };
        sets.push_back({text("name", "sensors"), text("receiver", "cosine") == "sphere"});
    }
    return sets;
}

/// Reads one table.
class ControlReader {
  public:
    ControlReader(
        const Node& node, const RunFileContext& context, std::vector<NamedSensors> sensors)
        : context_(context),
          sensors_(std::move(sensors)),
          table_(node, "control", *context.reporter),
          time_(table_.table_name("time")) {}

    LampControl read(const SourceList& sources, const TimeSeries* series) {
        LampControl control;
        control.sources = table_.required("sources", table_.text("sources")).value_or("");
        if (!control.sources.empty()) {
            table_.rename(fmt::format("control '{}'", control.sources));
            check_lamps(control, sources);
        }
        control.sensors = table_.required("sensors", table_.text("sensors")).value_or("");
        check_sensors(control.sensors);
        control.band = read_band();
        read_rules(control);
        if (series != nullptr) {
            check_times(*series);
        } else if (!context_.has_time) {
            table_.fault("it needs " + time_, "lamps are controlled by the hour", "add " + time_);
        }
        table_.finish();
        return control;
    }

    /// Reports a lamp that has another control.
    void refuse_lamp(const std::string& lamp, const LampControl& other) {
        table_.fault_at(
            "sources", fmt::format("'{}' belongs to control '{}' too", lamp, other.sources),
            "a lamp has one control", "let their patterns fit different lamps");
    }

  private:
    void check_lamps(const LampControl& control, const SourceList& given) {
        const Sources& sources = given.sources;
        std::vector<std::string_view> lamps;
        for (const auto& source : sources) {
            if (source->is_lamp() && std::ranges::find(lamps, source->name()) == lamps.end()) {
                lamps.emplace_back(source->name());
            }
        }
        const bool fits = std::ranges::any_of(
            sources, [&](const auto& source) { return controls(control, *source); });
        if (!fits && given.is_whole) {
            table_.fault_at(
                "sources", fmt::format("no lamp is called '{}'", control.sources),
                lamps.empty() ? "there are no lamps" : "",
                lamps.empty() ? "add a source that is a lamp" : there_is(lamps));
        }
    }

    void check_sensors(const std::string& name) {
        const auto found = std::ranges::find(sensors_, name, &NamedSensors::name);
        if (name.empty()) {
            return;
        }
        if (sensors_.empty()) {
            table_.fault_at(
                "sensors", fmt::format("no sensors are called '{}'", name), "there are no sensors",
                "add them above the crop");
        } else if (found == sensors_.end()) {
            std::vector<std::string_view> names;
            for (const NamedSensors& set : sensors_) {
                names.emplace_back(set.name);
            }
            table_.fault_at(
                "sensors", fmt::format("no sensors are called '{}'", name), "", there_is(names));
        } else if (found->is_sphere) {
            table_.fault_at(
                "sensors", fmt::format("sensors '{}' are spheres", name),
                "a control takes the light on upper sides", "name flat sensors");
        }
    }

    /// "there is a", "there are a, b".
    static std::string there_is(std::vector<std::string_view> names) {
        constexpr std::size_t kShown = 8;
        const std::size_t more = names.size() - std::min(names.size(), kShown);
        names.resize(names.size() - more);
        return fmt::format(
            "there {} {}{}", names.size() == 1 ? "is" : "are", joined(names, ", "),
            more > 0 ? fmt::format(" and {} more", more) : "");
    }

    std::size_t read_band() {
        const auto name = table_.text("band");
        const auto found = std::ranges::find(context_.bands, name.value_or(""), &Band::name);
        if (!name || found == context_.bands.end()) {
            if (name) {
                table_.fault_at(
                    "band", fmt::format("there is no band '{}'", *name), "",
                    did_you_mean(*name, names_in(context_.bands)));
            }
            return 0;
        }
        return static_cast<std::size_t>(found - context_.bands.begin());
    }

    void read_rules(LampControl& control) {
        control.on_below = table_.real("on_below", kLightAboveZero);
        control.set_point = table_.real("set_point", kLightAboveZero);
        if (const auto target = table_.real("daily_target", kLightAboveZero)) {
            control.daily_target = *target / summed_unit(context_.bands[control.band].unit).factor;
        }
        const auto dim_min = table_.real("dim_min", {0, 1});
        control.dim_min = dim_min.value_or(control.dim_min);
        control.electrical_power_w =
            table_.real("electrical_power_w", TableReader::kNotNegative).value_or(0);
        if (dim_min && table_.any("set_point") == nullptr) {
            table_.fault_at(
                "dim_min", "dim_min without set_point", "the lamps are not dimmed",
                "give set_point, or remove it");
        }
        constexpr std::array kRules{"on_below", "daily_target", "set_point"};
        if (std::ranges::none_of(
                kRules, [&](const char* key) { return table_.any(key) != nullptr; })) {
            table_.fault("it has no rule", "", "give on_below, daily_target or set_point");
        }
    }

    void check_times(const TimeSeries& series) {
        if (series.cumulative_sky != CumulativeSky::none) {
            table_.fault(
                fmt::format("it needs times, and {} has cumulative_sky", time_),
                "no instants are left", "remove cumulative_sky");
        } else if (table_.any("daily_target") != nullptr) {
            check_days(series);
        }
    }

    /// A daily sum needs all times of a day.
    void check_days(const TimeSeries& series) {
        constexpr double kDay = 86400, kHour = 3600, kRounding = 1;
        std::vector<double> seconds(series.days.size());
        for (const TimeStep& step : series.time_steps) {
            seconds[step.day] += step.seconds;
        }
        const auto is_short = [](double of_day) { return of_day < kDay - kRounding; };
        const auto found = std::ranges::find_if(seconds, is_short);
        if (found != seconds.end()) {
            table_.fault_at(
                "daily_target", "daily_target needs times of a whole day",
                fmt::format(
                    "{} has {:.4g} h of {}", time_, *found / kHour,
                    series.days[static_cast<std::size_t>(found - seconds.begin())]),
                "leave hours out, or remove daily_target");
        }
    }

    const RunFileContext& context_;
    std::vector<NamedSensors> sensors_;
    TableReader table_;
    std::string time_;  // name of the table of times
};

}  // namespace

std::vector<LampControl> read_controls(
    TableReader& top,
    const RunFileContext& context,
    const SourceList& sources,
    const TimeSeries* series,
    const Scene* scene) {
    std::vector<LampControl> all;
    const std::vector<NamedSensors> sensors =
        scene != nullptr ? named_sensors(*scene) : named_sensors(top);
    for (const Node* node : top.tables("control")) {
        ControlReader reader(*node, context, sensors);
        LampControl control = reader.read(sources, series);
        for (const LampControl& other : all) {
            const auto shared = std::ranges::find_if(sources.sources, [&](const auto& source) {
                return controls(control, *source) && controls(other, *source);
            });
            if (shared != sources.sources.end()) {
                reader.refuse_lamp((*shared)->name(), other);
                break;
            }
        }
        all.push_back(std::move(control));
    }
    return all;
}

}  // namespace quasimc
