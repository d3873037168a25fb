#include "geometry/shapes/ear_cutter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "geometry/shapes/corner_tree.h"

namespace quasimc {
namespace {

constexpr std::array kBlockings{Blocking::inside_or_on_border, Blocking::inside};

/// Whether the triangle at corner `i` is an ear: it turns left and contains no other corner.
bool is_ear(const std::vector<FlatCorner>& rest, std::size_t i, Blocking blocking) {
    const std::size_t n = rest.size();
    const FlatCorner &a = rest[(i + n - 1) % n], &b = rest[i], &c = rest[(i + 1) % n];
    return turn(a, b, c) > 0 && std::none_of(rest.begin(), rest.end(), [&](const FlatCorner& p) {
               return blocks_ear(a, b, c, p, blocking);
           });
}

/// Whether the polygon has no area at corner `i`: a straight side, or a spike.
bool is_flat(const std::vector<FlatCorner>& rest, std::size_t i) {
    const std::size_t n = rest.size();
    return turn(rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]) == 0;
}

/// The corner to cut off next; `rest.size()` if there is none.
std::size_t find_ear(const std::vector<FlatCorner>& rest) {
    for (std::size_t i = 0; i < rest.size(); ++i) {
        if (is_flat(rest, i)) {
            return i;
        }
    }
    for (const Blocking blocking : kBlockings) {
        for (std::size_t i = 0; i < rest.size(); ++i) {
            if (is_ear(rest, i, blocking)) {
                return i;
            }
        }
    }
    return rest.size();
}

Face face_of(const FlatCorner& a, const FlatCorner& b, const FlatCorner& c) {
    return {
        static_cast<std::uint32_t>(a.index), static_cast<std::uint32_t>(b.index),
        static_cast<std::uint32_t>(c.index)};
}

/// Corners that may be ears, and blocked ones that wait for another corner to be cut off.
struct Candidates {
    std::set<std::uint32_t> open;
    std::vector<std::vector<std::uint32_t>> waiting;  // by the blocking corner
};

class EarCutter {
  public:
    explicit EarCutter(const std::vector<FlatCorner>& corners)
        : corners_(corners), tree_(corners), before_(corners.size()), after_(corners.size()) {
        const auto n = static_cast<std::uint32_t>(corners.size());
        for (Candidates& candidates : candidates_) {
            candidates.waiting.resize(n);
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            note(i);
        }
    }

    std::optional<std::vector<Face>> cut() {
        constexpr std::size_t kFewest = 3;
        std::vector<Face> faces;
        for (std::size_t left = corners_.size(); left >= kFewest; --left) {
            const std::optional<std::uint32_t> next = find_next();
            if (!next) {
                return std::nullopt;
            }
            if (turn_at(*next) != 0) {
                faces.push_back(
                    face_of(corners_[before_[*next]], corners_[*next], corners_[after_[*next]]));
            }
            remove(*next);
        }
        return faces;
    }

  private:
    [[nodiscard]] double turn_at(std::uint32_t i) const {
        return turn(corners_[before_[i]], corners_[i], corners_[after_[i]]);
    }

    /// Classifies a corner by its neighbours.
    void note(std::uint32_t i) {
        turn_at(i) == 0 ? static_cast<void>(flat_.insert(i)) : static_cast<void>(flat_.erase(i));
        for (Candidates& candidates : candidates_) {
            candidates.open.insert(i);
        }
    }

    std::optional<std::uint32_t> find_next() {
        if (!flat_.empty()) {
            return *flat_.begin();
        }
        for (std::size_t k = 0; k < kBlockings.size(); ++k) {
            if (const auto ear = find_ear_among(candidates_[k], kBlockings[k])) {
                return ear;
            }
        }
        return std::nullopt;
    }

    /// The first of the candidates that is an ear; the ones before it are not at present.
    std::optional<std::uint32_t> find_ear_among(Candidates& candidates, Blocking blocking) {
        while (!candidates.open.empty()) {
            const std::uint32_t i = *candidates.open.begin();
            const bool turns_left = turn_at(i) > 0;
            const auto in_the_way =
                turns_left ? tree_.find_blocking(
                                 {corners_[before_[i]], corners_[i], corners_[after_[i]]}, blocking)
                           : std::nullopt;
            if (turns_left && !in_the_way) {
                return i;
            }
            candidates.open.erase(i);
            if (in_the_way) {
                candidates.waiting[*in_the_way].push_back(i);
            }
        }
        return std::nullopt;
    }

    void remove(std::uint32_t i) {
        tree_.remove(i);
        flat_.erase(i);
        is_cut_[i] = true;
        for (Candidates& candidates : candidates_) {
            candidates.open.erase(i);
            for (const std::uint32_t other : candidates.waiting[i]) {
                if (!is_cut_[other]) {
                    candidates.open.insert(other);
                }
            }
        }
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        note(before_[i]);
        note(after_[i]);
    }

    const std::vector<FlatCorner>& corners_;
    CornerTree tree_;
    std::vector<std::uint32_t> before_, after_;  // neighbours of the remaining corners
    std::vector<bool> is_cut_ = std::vector<bool>(corners_.size());
    std::set<std::uint32_t> flat_;
    std::array<Candidates, kBlockings.size()> candidates_;
};

}  // namespace

std::optional<std::vector<Face>> cut_ears_of_few(std::vector<FlatCorner> rest) {
    std::vector<Face> faces;
    while (rest.size() >= 3) {
        const std::size_t n = rest.size(), i = find_ear(rest);
        if (i == n) {
            return std::nullopt;
        }
        if (!is_flat(rest, i)) {
            faces.push_back(face_of(rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]));
        }
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return faces;
}

std::optional<std::vector<Face>> cut_ears_of_many(const std::vector<FlatCorner>& corners) {
    const bool is_finite = std::all_of(corners.begin(), corners.end(), [](const FlatCorner& p) {
        return std::isfinite(p.s) && std::isfinite(p.t);
    });
    return is_finite ? EarCutter(corners).cut() : std::nullopt;
}

}  // namespace quasimc
