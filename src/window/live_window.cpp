#include "window/live_window.h"

#include <chrono>
#include <utility>

#include <nlohmann/json.hpp>

#include "runfile/table_rows.h"
#include "scene/sensors.h"
#include "window/window_names.h"
#include "window/window_organs.h"
#include "window/window_parts.h"
#include "window/window_shape.h"

namespace quasimc {
namespace {

std::int64_t now_in_ms() {
    using namespace std::chrono;
    return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
}

/// Approximate memory of a frame. @param is_new  whether no other frame has its scene
std::size_t bytes_of(const LiveFrame& frame, bool is_new) {
    constexpr std::size_t kTriangle = 100, kOrgan = 300;
    const Scene& scene = *frame.scene->scene;
    std::size_t bytes = is_new ? scene.triangle_count() * kTriangle : 0;
    bytes += is_new ? scene.organs().size() * kOrgan : 0;
    for (const Result& result : *frame.results) {
        bytes += sizeof(Estimate) * (result.values.size() + result.sunlit_fraction.size() +
                                     result.ratio_values.size());
    }
    return bytes;
}

/// The known numbers of a column.
class ColumnValues {
  public:
    ColumnValues(const LiveFrame& frame, std::size_t column)
        : frame_(frame), bands_(frame.scene->bands.size()), column_(column) {}

    /// Whether the column has values.
    [[nodiscard]] bool is_known() const {
        const auto& results = *frame_.results;
        const std::size_t quantities = kQuantities * bands_;
        if (column_ < quantities) {
            const std::size_t index = result_of_band();
            return index < results.size() && !results[index].values.empty();
        }
        if (results.empty() || results.front().values.empty()) {
            return false;
        }
        return column_ == quantities ? !results.front().sunlit_fraction.empty()
                                     : !results.front().ratio_values.empty();
    }

    /// Means, standard errors, low and high ends of all organs, single precision.
    [[nodiscard]] std::string bytes() const {
        const Scene& scene = *frame_.scene->scene;
        std::vector<Estimate> column;
        for (std::size_t i = 0; i < scene.organs().size(); ++i) {
            column.push_back(reported(at(result_of_column(), i)));
        }
        const std::shared_ptr<const Result> sensors = result_of_column().sensors;
        for (std::size_t i = 0; i < sensor_rows(scene); ++i) {
            column.push_back(
                sensors && has_sensors() ? reported(at(*sensors, i)) : kUnknownEstimate);
        }
        return window_values(column);
    }

  private:
    [[nodiscard]] std::size_t band() const { return column_ % bands_; }
    [[nodiscard]] std::size_t result_of_band() const {
        return frame_.results->size() > 1 ? band() : 0;
    }
    /// The quantity of this column, in the order of window_columns().
    [[nodiscard]] Quantity quantity() const {
        const std::size_t position = column_ / bands_;
        const auto first = static_cast<std::size_t>(Quantity::absorbed_flux_density);
        const std::size_t index = position == 0       ? first
                                  : position <= first ? position - 1
                                                      : position;
        return static_cast<Quantity>(index);
    }
    /// The result that has the column.
    [[nodiscard]] const Result& result_of_column() const {
        const bool has_band = column_ < kQuantities * bands_;
        return (*frame_.results)[has_band ? result_of_band() : 0];
    }
    /// Whether sensors have the column: they absorb no light.
    [[nodiscard]] bool has_sensors() const {
        return column_ >= kQuantities * bands_ || is_of_sensors(quantity());
    }
    /// @param result  of organs or of sensors
    [[nodiscard]] Estimate at(const Result& result, std::size_t row) const {
        const std::size_t quantities = kQuantities * bands_;
        if (column_ < quantities) {
            return result.at(row, quantity(), frame_.results->size() > 1 ? 0 : band());
        }
        if (column_ > quantities) {
            return result.ratio_values.empty() ? kUnknownEstimate
                                               : result.ratio(row, column_ - quantities - 1);
        }
        return row < result.sunlit_fraction.size() ? result.sunlit_fraction[row] : kUnknownEstimate;
    }

    const LiveFrame& frame_;
    std::size_t bands_, column_;
};

std::vector<WindowColumn> columns_of(const LiveScene& scene) {
    return window_columns(scene.bands, scene.scene->length_unit(), scene.ratios);
}

std::string scene_json(const LiveScene& scene) {
    Json json = json_window_scene(*scene.scene, WindowOrgans(*scene.scene), columns_of(scene));
    json["title"] = scene.title;
    json["coming"] = scene.coming;
    json["grows"] = scene.grows;
    return json_text_with(json, "head", scene.head);
}

/// Columns that have values carry their own number, others -1.
std::string light_json(const LiveFrame& frame) {
    Json json = json_lights(frame.sources, window_middle(*frame.scene->scene));
    json["label"] = frame.label;
    Json& values = json["values"] = Json::array();
    const std::size_t count = columns_of(*frame.scene).size();
    for (std::size_t i = 0; i < count; ++i) {
        values.push_back(ColumnValues(frame, i).is_known() ? static_cast<std::int64_t>(i) : -1);
    }
    return json_text_with(json, "head", frame.head);
}

/// The light that organs absorb in each band, for the bars of the page.
Json absorbed_light(const LiveFrame& frame) {
    Json light = Json::object();
    const std::vector<Band>& bands = frame.scene->bands;
    const std::vector<Result>& results = *frame.results;
    for (std::size_t band = 0; band < bands.size(); ++band) {
        const std::size_t index = results.size() > 1 ? band : 0;
        const std::size_t own = results.size() > 1 ? 0 : band;
        if (index < results.size() && own < results[index].budget.size()) {
            light[bands[band].name] = results[index].budget[own].absorbed_by_organs.mean;
        }
    }
    return light;
}

/// The corners of a scene in its own coordinates: pages fit all frames of a growing plant.
Json extent(const Scene& scene) {
    const auto [low, high] = std::pair(scene.bounds().low, scene.bounds().high);
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}};
}

WindowFile made(std::string_view type, std::string text) {
    auto owner = std::make_shared<const std::string>(std::move(text));
    return {type, *owner, owner};
}

}  // namespace

void LiveWindow::add(LiveFrame frame) {
    const std::lock_guard lock(mutex_);
    put({.number = ++frame_count_}, std::move(frame));
}

void LiveWindow::replace_newest(LiveFrame frame) {
    const std::lock_guard lock(mutex_);
    if (frames_.empty()) {
        put({.number = ++frame_count_}, std::move(frame));
        return;
    }
    const std::uint64_t number = frames_.back().number;
    bytes_ -= frames_.back().bytes;
    const Kept old = std::move(frames_.back());
    frames_.pop_back();
    const bool is_same = old.frame->scene == frame.scene;
    put({.number = number, .scene = is_same ? old.scene : 0}, std::move(frame));
}

/// @param kept  if its scene is 0, it gets the number of the last frame's scene, if that is the
/// same
void LiveWindow::put(Kept kept, LiveFrame frame) {
    const bool has_same = !frames_.empty() && frames_.back().frame->scene == frame.scene;
    if (kept.scene == 0) {
        kept.scene = has_same ? frames_.back().scene : ++scene_count_;
    }
    kept.version = ++version_;
    kept.bytes = bytes_of(frame, !has_same);
    kept.frame = std::make_shared<const LiveFrame>(std::move(frame));
    bytes_ += kept.bytes;
    frames_.push_back(std::move(kept));
    while (frames_.size() > 1 && (frames_.size() > limits_.frames || bytes_ > limits_.bytes)) {
        bytes_ -= frames_.front().bytes;
        frames_.pop_front();
    }
}

void LiveWindow::send(std::string words, double fraction) {
    const std::lock_guard lock(mutex_);
    words_ = std::move(words);
    fraction_ = fraction;
}

void LiveWindow::end(std::string words) {
    const std::lock_guard lock(mutex_);
    ending_ = std::move(words);
    words_.clear();
}

bool LiveWindow::is_watched() const {
    constexpr std::int64_t kAwayAfter = 5000;  // pages ask several times within it
    const std::int64_t last = last_request_;
    return last > 0 && now_in_ms() - last < kAwayAfter;
}

std::size_t LiveWindow::bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
}

std::optional<WindowFile> LiveWindow::file(std::string_view name) {
    if (name == "live") {
        last_request_ = now_in_ms();
        return made(kJsonType, news());
    }
    if (const auto numbers = numbers_behind<1>("scene", name)) {
        const auto found = scene((*numbers)[0]);
        return found ? std::optional(made(kJsonType, scene_json(*found))) : std::nullopt;
    }
    if (const auto numbers = numbers_behind<1>("shape", name)) {
        const auto found = scene((*numbers)[0]);
        return found ? std::optional(made(kBytesType, window_shape(*found->scene))) : std::nullopt;
    }
    if (const auto numbers = numbers_behind<2>("light", name)) {
        const auto found = frame((*numbers)[0]);
        return found ? std::optional(made(kJsonType, light_json(*found))) : std::nullopt;
    }
    if (const auto numbers = numbers_behind<3>("values", name)) {
        const auto found = frame((*numbers)[0]);
        const std::uint64_t column = (*numbers)[2];
        if (found && column < columns_of(*found->scene).size()) {
            const ColumnValues values(*found, column);
            return values.is_known() ? std::optional(made(kBytesType, values.bytes()))
                                     : std::nullopt;
        }
    }
    return std::nullopt;
}

std::string LiveWindow::news() const {
    const std::lock_guard lock(mutex_);
    Json frames = Json::array();
    for (const Kept& kept : frames_) {
        frames.push_back(
            {{"number", kept.number},
             {"version", kept.version},
             {"scene", kept.scene},
             {"label", kept.frame->label},
             {"extent", extent(*kept.frame->scene->scene)},
             {"light", absorbed_light(*kept.frame)}});
    }
    return json_text(
        {{"words", words_}, {"fraction", fraction_}, {"ended", ending_}, {"frames", frames}});
}

std::shared_ptr<const LiveFrame> LiveWindow::frame(std::uint64_t number) const {
    const std::lock_guard lock(mutex_);
    for (const Kept& kept : frames_) {
        if (kept.number == number) {
            return kept.frame;
        }
    }
    return nullptr;
}

std::shared_ptr<const LiveScene> LiveWindow::scene(std::uint64_t number) const {
    const std::lock_guard lock(mutex_);
    for (const Kept& kept : frames_) {
        if (kept.scene == number) {
            return kept.frame->scene;
        }
    }
    return nullptr;
}

}  // namespace quasimc
