#include "resultio/write_opf.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/text.h"
#include "quasimc/error.h"
#include "text/numbers.h"

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

void remove_with_blanks(pugi::xml_node child) {
    pugi::xml_node parent = child.parent();
    const pugi::xml_node before = child.previous_sibling();
    if (before.type() == pugi::node_pcdata && trimmed(before.value()).empty()) {
        parent.remove_child(before);
    }
    parent.remove_child(child);
}

/// Adds the numbers to the nodes of a file.
class OpfWriter : pugi::xml_tree_walker {
  public:
    explicit OpfWriter(const FieldScene& shown) : shown_(shown) {
        for (std::size_t i = 0; i < shown.scene.organs().size(); ++i) {
            organs_[shown.scene.organs()[i].id] = i;
        }
        for (const OrganField& field : shown.fields) {
            names_.push_back(element_name(field.name));
        }
    }

    OpfMatches write(pugi::xml_document& document) {
        pugi::xml_node root = document.document_element();
        pugi::xml_node table = root.child("attributeBDD");
        set_table(table ? table : root.insert_child_before("attributeBDD", root.child("topology")));
        document.traverse(*this);
        if (found_.empty()) {
            throw InputError(
                {{"OPF", "no organ of the result is a node of the file",
                  "their ids are not those of its nodes", "leave first_id and at out"}});
        }
        return {found_.size(), shown_.scene.organs().size() - found_.size()};
    }

  private:
    bool for_each(pugi::xml_node& node) override {
        if (const auto organ = organ_of(node)) {
            set_values(node, *organ);
            found_.insert(*organ);
        }
        return true;
    }

    /// The organ that was made of a node.
    [[nodiscard]] std::optional<std::size_t> organ_of(pugi::xml_node node) const {
        const auto id = parse_integer(trimmed(node.attribute("id").value()));
        const auto organ = id ? organs_.find(*id) : organs_.end();
        if (organ == organs_.end()) {
            return std::nullopt;
        }
        const std::string_view kind = trimmed(node.attribute("class").value());
        const Labels& labels = shown_.scene.organs()[organ->second].labels;
        const bool is_same = std::any_of(labels.begin(), labels.end(), [&](const auto& label) {
            return label.first == "class" && label.second == kind;
        });
        return is_same ? std::optional(organ->second) : std::nullopt;
    }

    /// Replaces the attributes of an earlier result.
    void set_values(pugi::xml_node node, std::size_t organ) const {
        for (std::size_t i = names_.size(); i-- > 0;) {
            const char* name = names_[i].c_str();
            while (const pugi::xml_node old = node.child(name)) {
                remove_with_blanks(old);
            }
            const double value = shown_.fields[i].values[organ];
            if (std::isfinite(value)) {
                node.prepend_child(name).text().set(shortest(value).c_str());
                node.prepend_child(pugi::node_pcdata).set_value("\n");
            }
        }
    }

    /// Sets the attributes' entries in the file's header.
    void set_table(pugi::xml_node table) const {
        for (const std::string& name : names_) {
            while (const pugi::xml_node old =
                       table.find_child_by_attribute("attribute", "name", name.c_str())) {
                remove_with_blanks(old);
            }
        }
        for (const std::string& name : names_) {
            table.append_child(pugi::node_pcdata).set_value("\n");
            pugi::xml_node attribute = table.append_child("attribute");
            attribute.append_attribute("name") = name.c_str();
            attribute.append_attribute("class") = "Double";
        }
    }

    const FieldScene& shown_;
    std::map<std::int64_t, std::size_t> organs_;  // by id
    std::vector<std::string> names_;              // of the fields
    std::set<std::size_t> found_;
};

/// The library removes elements recursively; no plant is this deep.
constexpr int kDeepest = 20'000;

struct DepthWalker : pugi::xml_tree_walker {
    bool for_each(pugi::xml_node& /*node*/) override { return depth() < kDeepest; }
};

class SinkWriter : public pugi::xml_writer {
  public:
    explicit SinkWriter(const TextSink& sink) : sink_(sink) {}
    void write(const void* data, std::size_t size) override {
        sink_({static_cast<const char*>(data), size});
    }

  private:
    const TextSink& sink_;
};

}  // namespace

OpfMatches write_opf(std::string_view bytes, const FieldScene& shown, const TextSink& sink) {
    constexpr unsigned int kAll =
        (pugi::parse_full | pugi::parse_ws_pcdata | pugi::parse_fragment) &
        ~static_cast<unsigned int>(pugi::parse_eol | pugi::parse_wconv_attribute);
    pugi::xml_document document;
    const pugi::xml_parse_result parsed =
        document.load_buffer(bytes.data(), bytes.size(), kAll, pugi::encoding_utf8);
    if (!parsed) {
        throw InputError({{"OPF", parsed.description(), "it is not XML", ""}});
    }
    DepthWalker walker;
    if (!document.traverse(walker)) {
        throw InputError(
            {{"OPF", fmt::format("elements are nested more than {} deep", kDeepest), "", ""}});
    }
    const OpfMatches matches = OpfWriter(shown).write(document);
    SinkWriter writer(sink);
    document.save(writer, "", pugi::format_raw | pugi::format_no_declaration, pugi::encoding_utf8);
    return matches;
}

}  // namespace quasimc
