#include "io/results/write_opf.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/xml_scanner.h"
#include "quasimc/error.h"

namespace quasimc {
namespace {

/// A name of an attribute is a name of an element.
std::string element_name(const std::string& name) {
    std::string element =
        name.empty() || std::isalpha(static_cast<unsigned char>(name[0])) == 0 ? "_" + name : name;
    std::replace_if(
        element.begin(), element.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c < 0x80; }, '_');
    return element;
}

/// Copies a file from tag to tag, and puts in what is new.
class OpfWriter {
  public:
    OpfWriter(std::string_view bytes, const FieldScene& shown, const TextSink& sink)
        : bytes_(without_bom(bytes)), scanner_(bytes), shown_(shown), sink_(sink) {
        for (std::size_t i = 0; i < shown.scene.organs().size(); ++i) {
            organs_[shown.scene.organs()[i].id] = i;
        }
        for (const OrganField& field : shown.fields) {
            names_.push_back(element_name(field.name));
        }
    }

    OpfMatches write() {
        XmlScanner::Kind kind = scanner_.next();
        for (; kind == XmlScanner::Kind::open || kind == XmlScanner::Kind::close;
             kind = scanner_.next()) {
            kind == XmlScanner::Kind::open ? open() : close();
        }
        if (kind == XmlScanner::Kind::broken) {
            throw InputError({{"OPF", std::string(scanner_.problem()), "it is no XML", ""}});
        }
        if (found_.empty()) {
            throw InputError(
                {{"OPF", "no organ of the result is a node of the file",
                  "their ids are not those of its nodes",
                  "leave first_id and at out of [[geometry]]"}});
        }
        copy_to(bytes_.size());
        return {found_.size(), shown_.scene.organs().size() - found_.size()};
    }

  private:
    void open() {
        const std::string_view name = scanner_.name();
        if (name == "topology" && !has_table_) {
            copy_to(scanner_.tag_begin());
            sink_("<attributeBDD>" + table() + "</attributeBDD>\n");
            has_table_ = true;
        }
        is_in_table_ = is_in_table_ || (name == "attributeBDD" && !scanner_.closes_itself());
        if (skipped_level_ == 0 && is_replaced(name)) {
            const bool is_blank = trimmed(scanner_.text()).empty();
            copy_to(scanner_.tag_begin() - (is_blank ? scanner_.text().size() : 0));
            skipped_level_ = levels_.size() + 1;
        }
        const auto organ = organ_of_node();
        levels_.push_back(organ.has_value());
        if (organ) {
            copy_to(scanner_.tag_end());
            sink_(values_of(*organ));
            found_.insert(*organ);
        }
    }

    /// Whether an element is what an earlier result has left: an attribute of a node, or what the
    /// table says of it. An empty table is written anew.
    [[nodiscard]] bool is_replaced(std::string_view name) const {
        if (is_in_table_) {
            return name == "attribute" && is_ours(scanner_.attribute("name").value_or(""));
        }
        const bool is_empty_table = name == "attributeBDD" && scanner_.closes_itself();
        return is_empty_table || (!levels_.empty() && levels_.back() && is_ours(name));
    }

    void close() {
        if (is_in_table_ && scanner_.name() == "attributeBDD") {
            copy_to(scanner_.tag_begin());
            sink_(table());
            has_table_ = true;
            is_in_table_ = false;
        }
        if (skipped_level_ == levels_.size()) {
            done_ = scanner_.tag_end();
            skipped_level_ = 0;
        }
        if (!levels_.empty()) {
            levels_.pop_back();
        }
    }

    /// The organ that was made of the node whose tag has been read.
    [[nodiscard]] std::optional<std::size_t> organ_of_node() const {
        const auto word = scanner_.attribute("id");
        const auto id = word ? parse_integer(trimmed(*word)) : std::nullopt;
        const auto organ = id ? organs_.find(*id) : organs_.end();
        if (organ == organs_.end()) {
            return std::nullopt;
        }
        const std::string kind = xml_text(scanner_.attribute("class").value_or(""));
        const Labels& labels = shown_.scene.organs()[organ->second].labels;
        const bool is_same = std::any_of(labels.begin(), labels.end(), [&](const auto& label) {
            return label.first == "class" && label.second == kind;
        });
        return is_same ? std::optional(organ->second) : std::nullopt;
    }

    [[nodiscard]] bool is_ours(std::string_view name) const {
        return std::find(names_.begin(), names_.end(), name) != names_.end();
    }

    [[nodiscard]] std::string values_of(std::size_t organ) const {
        std::string text;
        for (std::size_t i = 0; i < names_.size(); ++i) {
            const double value = shown_.fields[i].values[organ];
            if (std::isfinite(value)) {
                text += fmt::format("\n<{0}>{1}</{0}>", names_[i], shortest(value));
            }
        }
        return text;
    }

    /// What the head of the file says of the attributes.
    [[nodiscard]] std::string table() const {
        std::string text;
        for (const std::string& name : names_) {
            text += fmt::format("\n<attribute name=\"{}\" class=\"Double\"/>", name);
        }
        return text;
    }

    void copy_to(std::size_t end) {
        if (end > done_) {
            sink_(bytes_.substr(done_, end - done_));
            done_ = end;
        }
    }

    std::string_view bytes_;
    XmlScanner scanner_;
    const FieldScene& shown_;
    const TextSink& sink_;
    std::map<std::int64_t, std::size_t> organs_;  // by id
    std::vector<std::string> names_;              // of the fields
    std::set<std::size_t> found_;
    std::size_t done_ = 0;           // bytes of the file that are written or left out
    std::vector<bool> levels_;       // open elements: whether they are nodes of organs
    std::size_t skipped_level_ = 0;  // of the element that is left out; 0: none is
    bool has_table_ = false, is_in_table_ = false;
};

}  // namespace

OpfMatches write_opf(std::string_view bytes, const FieldScene& shown, const TextSink& sink) {
    return OpfWriter(bytes, shown, sink).write();
}

}  // namespace quasimc
