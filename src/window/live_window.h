#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/source.h"
#include "scene/scene.h"
#include "window/window_site.h"

namespace quasimc {

/// The scene of frames, and the names of its numbers.
struct LiveScene {
    std::shared_ptr<const Scene> scene;
    std::vector<Band> bands;  ///< bands of all results
    std::vector<std::string> ratios = {};
    std::string title;
    std::vector<std::string> coming = {};  ///< labels of all frames, as far as they are known
    std::string head = "{}";               ///< JSON: the run, as in a result
    bool grows = false;  ///< a growing plant; the page also shows it without light
};

/// A state of a run that is being computed: a step of growth, or the light of a time as it is known
/// so far.
struct LiveFrame {
    std::string label = {};  ///< "step 12"; may be empty
    std::shared_ptr<const LiveScene> scene = nullptr;
    /// One result with all bands, or one per band; empty values: no light.
    std::shared_ptr<const std::vector<Result>> results = nullptr;
    Sources sources = {};     ///< sources of this light
    std::string head = "{}";  ///< JSON: method, energy and so on, as in a result
};

/// Limits on the frames that are kept; older ones are dropped.
struct LiveLimits {
    std::size_t frames = 200;
    std::size_t bytes = std::size_t{256} << 20U;  ///< about; the newest frame is always kept
};

/// The state of a run in progress, for pages that follow it. One thread adds frames, another one
/// reads them: frames are shared, and converted when a page requests them.
class LiveWindow {
  public:
    explicit LiveWindow(const LiveLimits& limits = {}) : limits_(limits) {}

    /// Adds a frame.
    void add(LiveFrame frame);
    /// Replaces the newest frame by a more exact one.
    void replace_newest(LiveFrame frame);
    /// Sets the progress of the run. @param fraction  0 to 1; negative: unknown
    void send(std::string words, double fraction = -1);
    /// Marks the run as finished. @param words  how it ended
    void end(std::string words);

    /// Whether a page has asked for news within the last seconds.
    [[nodiscard]] bool is_watched() const;
    /// The bytes that frames take, about.
    [[nodiscard]] std::size_t bytes() const;

    /// The files of pages: "live", "scene-S", "shape-S", "light-F-V" and "values-F-V-C" for scene
    /// S, frame F and column C. The version V only keeps browsers from using cached data: the
    /// current state of the frame is returned.
    [[nodiscard]] std::optional<WindowFile> file(std::string_view name);

  private:
    struct Kept {
        std::uint64_t number = 0, version = 0, scene = 0;
        std::size_t bytes = 0;
        std::shared_ptr<const LiveFrame> frame = nullptr;
    };
    void put(Kept kept, LiveFrame frame);
    [[nodiscard]] std::string news() const;
    [[nodiscard]] std::shared_ptr<const LiveFrame> frame(std::uint64_t number) const;
    [[nodiscard]] std::shared_ptr<const LiveScene> scene(std::uint64_t number) const;

    LiveLimits limits_;
    mutable std::mutex mutex_;  // guards all members below
    std::deque<Kept> frames_;
    std::uint64_t frame_count_ = 0, scene_count_ = 0, version_ = 0;
    std::size_t bytes_ = 0;
    std::string words_, ending_;
    double fraction_ = -1;
    std::atomic<std::int64_t> last_request_{0};  // milliseconds of the steady clock
};

}  // namespace quasimc
