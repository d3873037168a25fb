#include <algorithm>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/copies.h"

namespace quasimc {
namespace {

/// A piece of a text: as it is, or the key of a placeholder.
struct TextPiece {
    std::string_view text;
    bool is_key = false;
};

/// The pieces of a text. An unmatched brace is text.
std::vector<TextPiece> pieces_of(std::string_view text) {
    std::vector<TextPiece> pieces;
    while (!text.empty()) {
        const std::size_t begin = text.find('{');
        const std::size_t end = begin == text.npos ? text.npos : text.find('}', begin);
        if (end == text.npos) {
            pieces.push_back({text});
            break;
        }
        if (begin > 0) {
            pieces.push_back({text.substr(0, begin)});
        }
        pieces.push_back({text.substr(begin + 1, end - begin - 1), true});
        text.remove_prefix(end + 1);
    }
    return pieces;
}

const Member* other_of(const Copy& copy, std::string_view key) {
    const auto found = std::find_if(
        copy.row.others.begin(), copy.row.others.end(),
        [&](const Member& member) { return member.key == key; });
    return found == copy.row.others.end() ? nullptr : &*found;
}

/// The value of a placeholder; empty if the copy has none.
std::optional<std::string> value_of_key(const Copy& copy, std::string_view key) {
    if (const Member* other = other_of(copy, key)) {
        return text_of_value(other->node);
    }
    if (key == "copy") {
        return std::to_string(copy.number);
    }
    const auto& index = key == "i" ? copy.i : key == "j" ? copy.j : std::nullopt;
    return index ? std::optional(std::to_string(*index)) : std::nullopt;
}

std::vector<std::string> known_keys(const Copy& copy) {
    std::vector<std::string> keys{"copy"};
    if (copy.i) {
        keys.insert(keys.end(), {"i", "j"});
    }
    for (const Member& other : copy.row.others) {
        keys.push_back(other.key);
    }
    return keys;
}

}  // namespace

std::optional<std::string> text_of_value(const Node& node) {
    if (const auto* text = node.as<std::string>()) {
        return *text;
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return std::to_string(*integer);
    }
    const auto* real = node.as<double>();
    return real != nullptr ? std::optional(shortest(*real)) : std::nullopt;
}

std::vector<std::string> placeholders_of(std::string_view text) {
    std::vector<std::string> keys;
    for (const TextPiece& piece : pieces_of(text)) {
        if (piece.is_key) {
            keys.emplace_back(piece.text);
        }
    }
    return keys;
}

bool CopyTexts::is_used(std::string_view key) const {
    return std::find(used_.begin(), used_.end(), key) != used_.end();
}

std::vector<std::string> CopyTexts::fill(std::string_view key, const std::string& text) {
    std::vector<std::string> texts;
    const std::vector<TextPiece> pieces = pieces_of(text);
    for (const Copy& copy : copies_) {
        std::string& filled = texts.emplace_back();
        for (const TextPiece& piece : pieces) {
            const auto value =
                piece.is_key ? value_of_key(copy, piece.text) : std::string(piece.text);
            if (!value) {
                const std::vector<std::string> known = known_keys(copy);
                const std::vector<std::string_view> names(known.begin(), known.end());
                table_.fault_at(
                    key, fmt::format("{}: copy {} has no '{}'", key, copy.number, piece.text),
                    fmt::format("it has {}", joined(names, ", ")),
                    near_word_text(piece.text, names));
                return {};
            }
            filled += *value;
        }
    }
    for (std::string& used : placeholders_of(text)) {
        used_.push_back(std::move(used));
    }
    return texts;
}

std::vector<std::string> CopyTexts::names(const std::string& name, std::string_view fallback) {
    const std::vector<std::string> used = used_;
    const std::string start = name.empty() ? std::string(fallback) : name;
    const bool has_number = start.empty() || !placeholders_of(start).empty();
    std::vector<std::string> names = fill("name", has_number ? start : start + " {copy}");
    used_ = used;  // what a name uses may be a label too
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (const Member* own = other_of(copies_[i], "name")) {
            names[i] = text_of_value(own->node).value_or(names[i]);
        }
    }
    return names;
}

std::vector<Labels> CopyTexts::labels(const Labels& labels) {
    std::vector<Labels> all(copies_.size());
    for (const auto& [key, text] : labels) {
        const std::vector<std::string> texts = fill("labels", text);
        for (std::size_t i = 0; i < texts.size(); ++i) {
            all[i].emplace_back(key, texts[i]);
        }
    }
    for (std::size_t i = 0; i < copies_.size(); ++i) {
        for (const Member& other : copies_[i].row.others) {
            if (is_used(other.key)) {
                continue;
            }
            if (find_label(labels, other.key) != nullptr) {
                table_.fault_at(
                    "labels", fmt::format("the label '{}' is in labels and in at", other.key), "",
                    "keep one");
                return all;
            }
            const std::optional<std::string> value = text_of_value(other.node);
            if (!value) {
                table_.fault_at(
                    other.node,
                    fmt::format("at: label {} is {}", other.key, other.node.type_name()),
                    "it must be a text or a number");
                return all;
            }
            if (!value->empty()) {
                all[i].emplace_back(other.key, *value);
            }
        }
    }
    return all;
}

}  // namespace quasimc
