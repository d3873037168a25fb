#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>

namespace quasimc {

/// Tells a person what may be of interest, everything once however often it happens.
class Notices {
  public:
    using Tell = std::function<void(const std::string& text)>;
    explicit Notices(Tell tell) : tell_(std::move(tell)) {}

    /// @param key  what is told once; a later text with the same key is dropped
    void once(const std::string& key, const std::string& text) {
        if (told_.insert(key).second) {
            tell_(text);
        }
    }
    void once(const std::string& text) { once(text, text); }
    [[nodiscard]] bool was_told(const std::string& key) const { return told_.contains(key); }

  private:
    Tell tell_;
    std::set<std::string> told_;
};

}  // namespace quasimc
