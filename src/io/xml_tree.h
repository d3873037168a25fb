#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace quasimc {

/// An element of an XML text. Names and texts are parts of that text: entities stay as they are.
struct XmlElement {
    std::string_view name;
    std::vector<std::pair<std::string_view, std::string_view>> attributes;
    std::string_view text;  ///< what stands in it, of an element without others in it
    std::uint32_t line = 0;
    std::size_t parent = 0;
    std::vector<std::size_t> children;

    /// The value of an attribute; empty if it has none of that name.
    [[nodiscard]] std::string_view attribute(std::string_view key) const;
};

/// What is wrong with an XML text.
struct XmlFault {
    std::uint32_t line = 0;
    std::string_view problem;
};

/// The elements of an XML text, for formats whose parts refer to each other. Built and taken apart
/// without recursion: no depth of nesting is too much.
class XmlTree {
  public:
    /// @param text  must outlive the tree
    explicit XmlTree(std::string_view text);

    /// What is wrong; the tree then holds what was before.
    [[nodiscard]] const std::optional<XmlFault>& fault() const { return fault_; }
    /// Element 0 is the outermost one.
    [[nodiscard]] bool empty() const { return elements_.empty(); }
    [[nodiscard]] std::size_t size() const { return elements_.size(); }
    [[nodiscard]] const XmlElement& operator[](std::size_t number) const {
        return elements_[number];
    }

    /// The first child of that name.
    [[nodiscard]] std::optional<std::size_t> child(std::size_t of, std::string_view name) const;
    /// All children of that name.
    [[nodiscard]] std::vector<std::size_t> children(std::size_t of, std::string_view name) const;
    /// The first element of that name in an element, however deep, in the order of the text.
    [[nodiscard]] std::optional<std::size_t> find_in(std::size_t of, std::string_view name) const;

  private:
    std::vector<XmlElement> elements_;  // in the order of the text
    std::optional<XmlFault> fault_;
};

}  // namespace quasimc
