#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>

namespace quasimc {

/// Sends notices to the user, each once.
class Notices {
  public:
    using MessageSink = std::function<void(const std::string& text)>;
    explicit Notices(MessageSink send) : send_(std::move(send)) {}

    /// @param key  identifies the notice; later texts with the same key are dropped
    void once(const std::string& key, const std::string& text) {
        if (sent_.insert(key).second) {
            send_(text);
        }
    }
    void once(const std::string& text) { once(text, text); }
    [[nodiscard]] bool was_sent(const std::string& key) const { return sent_.contains(key); }

  private:
    MessageSink send_;
    std::set<std::string> sent_;
};

}  // namespace quasimc
