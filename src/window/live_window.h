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

/// The scene of frames, and how its numbers are called.
struct LiveScene {
    std::shared_ptr<const Scene> scene;
    std::vector<Band> bands;  ///< of all results
    std::vector<std::string> ratios = {};
    std::string title;
    std::string head = "{}";  ///< JSON: what was run, as a result has it
    bool grows = false;       ///< a plant's, which the page shows beside its light
};

/// A state of a run that is being computed: a step of growth, or the light of a time as it is known
/// so far.
struct LiveFrame {
    std::string label = {};  ///< "step 12"; may be empty
    std::shared_ptr<const LiveScene> scene = nullptr;
    /// Of all bands together, or of each by itself; one without values has no light.
    std::shared_ptr<const std::vector<Result>> results = nullptr;
    Sources sources = {};     ///< of this light
    std::string head = "{}";  ///< JSON: method, energy and the like, as a result has them
};

/// How much of a run the window keeps: its newest frames.
struct LiveLimits {
    std::size_t frames = 200;
    std::size_t bytes = std::size_t{256} << 20U;  ///< about; the newest frame is always kept
};

/// What is known of a run that goes on, for the pages that follow it. Made by one thread, read by
/// another: frames are shared, and turned into what a page takes when it asks.
class LiveWindow {
  public:
    explicit LiveWindow(const LiveLimits& limits = {}) : limits_(limits) {}

    /// A further frame.
    void add(LiveFrame frame);
    /// The newest frame is known better now.
    void replace_newest(LiveFrame frame);
    /// How far the run is. @param fraction  0 to 1; negative: it is not known
    void send(std::string words, double fraction = -1);
    /// The run is over: nothing will follow. @param words  how it ended
    void end(std::string words);

    /// Whether a page has asked for news within the last seconds.
    [[nodiscard]] bool is_watched() const;
    /// The bytes that frames take, about.
    [[nodiscard]] std::size_t bytes() const;

    /// What pages ask for: "live", "scene-S", "shape-S", "light-F-V" and "values-F-V-C", of
    /// scene S, frame F and column C. Of a frame that is known better than in its version V, what
    /// is known now: a version tells browsers apart what is new.
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
    mutable std::mutex mutex_;  // of all that follows
    std::deque<Kept> frames_;
    std::uint64_t frame_count_ = 0, scene_count_ = 0, version_ = 0;
    std::size_t bytes_ = 0;
    std::string words_, ending_;
    double fraction_ = -1;
    std::atomic<std::int64_t> last_asked_{0};  // milliseconds of the steady clock
};

}  // namespace quasimc
