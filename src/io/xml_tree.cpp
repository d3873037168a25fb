#include "io/xml_tree.h"

#include "io/xml_scanner.h"

namespace quasimc {

std::string_view XmlElement::attribute(std::string_view key) const {
    for (const auto& [own, value] : attributes) {
        if (own == key) {
            return value;
        }
    }
    return {};
}

XmlTree::XmlTree(std::string_view text) {
    using Kind = XmlScanner::Kind;
    XmlScanner scanner(text);
    std::vector<std::size_t> open;
    for (Kind kind = scanner.next(); kind != Kind::end; kind = scanner.next()) {
        if (kind == Kind::broken) {
            fault_ = {scanner.line(), scanner.problem()};
            return;
        }
        if (kind == Kind::close) {
            if (open.empty() || elements_[open.back()].name != scanner.name()) {
                fault_ = {scanner.line(), "a tag closes what is not open"};
                return;
            }
            if (elements_[open.back()].children.empty()) {
                elements_[open.back()].text = scanner.text();
            }
            open.pop_back();
            continue;
        }
        const std::size_t number = elements_.size();
        if (open.empty() && number > 0) {
            fault_ = {scanner.line(), "a second element outside the first one"};
            return;
        }
        XmlElement& element = elements_.emplace_back();
        element.name = scanner.name();
        element.line = scanner.line();
        element.attributes.assign(scanner.attributes().begin(), scanner.attributes().end());
        if (!open.empty()) {
            element.parent = open.back();
            elements_[open.back()].children.push_back(number);
        }
        open.push_back(number);
    }
    if (!open.empty()) {
        fault_ = {elements_[open.back()].line, "a tag is not closed"};
    }
}

std::optional<std::size_t> XmlTree::child(std::size_t of, std::string_view name) const {
    for (const std::size_t number : elements_[of].children) {
        if (elements_[number].name == name) {
            return number;
        }
    }
    return std::nullopt;
}

std::vector<std::size_t> XmlTree::children(std::size_t of, std::string_view name) const {
    std::vector<std::size_t> found;
    for (const std::size_t number : elements_[of].children) {
        if (elements_[number].name == name) {
            found.push_back(number);
        }
    }
    return found;
}

std::optional<std::size_t> XmlTree::find_in(std::size_t of, std::string_view name) const {
    // What is in an element follows it, until one whose parent stands before it.
    for (std::size_t number = of + 1; number < elements_.size() && elements_[number].parent >= of;
         ++number) {
        if (elements_[number].name == name) {
            return number;
        }
    }
    return std::nullopt;
}

}  // namespace quasimc
