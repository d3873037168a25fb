// Lamps with `at`: one table for each copy, as it would be written without `at`.

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "runfile/copies.h"
#include "runfile/run_file_source_kinds.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

constexpr std::array<std::string_view, 3> kFluxes{"power", "photon_flux", "luminous_flux"};

void set_key(Node::Table& table, std::string_view key, Node value) {
    const auto known = std::find_if(
        table.begin(), table.end(), [&](const Member& member) { return member.key == key; });
    if (known == table.end()) {
        table.push_back({std::string(key), value.line, std::move(value)});
    } else {
        known->node = std::move(value);
    }
}

Node node_of(const Vec3& v, std::uint32_t line) {
    const auto number = [&](double x) { return Node{x, line}; };
    return {Node::List{number(v.x), number(v.y), number(v.z)}, line};
}

/// The value of a row's key: a number, if it is a flux from a file.
Node value_of_row(const Member& member, std::uint32_t line) {
    Node value = member.node;
    const auto* text = value.as<std::string>();
    const bool is_flux = std::find(kFluxes.begin(), kFluxes.end(), member.key) != kFluxes.end();
    if (const auto number = is_flux && text != nullptr ? parse_real(*text) : std::nullopt) {
        value.value = *number;
    }
    value.line = line;
    return value;
}

/// Makes the tables of the copies of a lamp.
class LampCopies {
  public:
    LampCopies(const Node& source, RunFileContext& context)
        : source_(source), context_(context), table_(source, "source", *context.reporter) {}

    std::vector<Node> make() {
        const std::string type = table_.text("type").value_or("");
        const std::string name = table_.text("name").value_or(type);
        table_.rename(fmt::format("source '{}'", name));
        const auto copies = read_copies(table_, name, context_);
        if (!copies) {
            return {};
        }
        CopyTexts texts(table_, *copies);
        const std::string file = table_.text("file").value_or("");
        const std::vector<std::string> files = texts.fill("file", file);
        const std::vector<std::string> names = texts.names(name, "");
        std::vector<Node> tables;
        for (std::size_t i = 0; i < std::min(files.size(), names.size()); ++i) {
            if (!check_row((*copies)[i], {file, name})) {
                return {};
            }
            tables.push_back(table_of((*copies)[i], names[i], files[i]));
        }
        return tables;
    }

  private:
    /// Whether a row has only keys of lamps; others may be used by placeholders of `texts`.
    bool check_row(const Copy& copy, const std::vector<std::string>& texts) {
        for (const Member& member : copy.row.others) {
            const bool is_key =
                member.key == "name" ||
                std::find(kFluxes.begin(), kFluxes.end(), member.key) != kFluxes.end();
            const bool is_used = std::any_of(texts.begin(), texts.end(), [&](const auto& text) {
                const std::vector<std::string> used = placeholders_of(text);
                return std::find(used.begin(), used.end(), member.key) != used.end();
            });
            if (!is_key && !is_used) {
                table_.fault_at(
                    "at", fmt::format("at: a copy of a lamp has no '{}'", member.key),
                    "lamps have no labels",
                    "keys of copies are x, y, z, heading_deg, tilt_deg, roll_deg, name, "
                    "photon_flux, power, luminous_flux");
                return false;
            }
        }
        if (copy.row.scale != 1) {
            table_.fault_at(
                "at", fmt::format("at: the scale of copy {} is {}", copy.number, copy.row.scale),
                "a lamp has a size of its own", "give length, width or radius");
            return false;
        }
        return true;
    }

    [[nodiscard]] Vec3 vector_or(std::string_view key, const Vec3& usual) {
        return table_.vector(key).value_or(usual);
    }

    Node table_of(const Copy& copy, const std::string& name, const std::string& file) {
        Node::Table keys = *source_.as<Node::Table>();
        std::erase_if(keys, [](const Member& member) { return member.key == "at"; });
        const auto set = [&](std::string_view key, const Vec3& v) {
            set_key(keys, key, node_of(v, source_.line));
        };
        if (table_.any("from") != nullptr || table_.any("to") != nullptr) {
            for (const std::string_view end : {"from", "to"}) {
                if (const auto p = table_.vector(end)) {
                    set(end, copy.transform.point(*p));
                }
            }
        } else {
            set("position", copy.transform.point(vector_or("position", {})));
            const Orientation& axes = context_.orientation;
            const CopyRow& row = copy.row;
            if (row.heading_deg != 0 || row.tilt_deg != 0 || row.roll_deg != 0) {
                set_pose(keys, copy, axes);
            }
        }
        set_key(keys, "name", {name, source_.line});
        if (!file.empty()) {
            set_key(keys, "file", {file, source_.line});
        }
        for (const Member& member : copy.row.others) {
            if (std::find(kFluxes.begin(), kFluxes.end(), member.key) != kFluxes.end()) {
                set_key(keys, member.key, value_of_row(member, source_.line));
            }
        }
        return {std::move(keys), source_.line};
    }

    void set_pose(Node::Table& keys, const Copy& copy, const Orientation& axes) {
        const auto type = table_.text("type");
        if (type == "point" || type == "sphere") {
            return;  // the same in all directions
        }
        const Vec3 aim = vector_or("aim", axes.outward({0, 0, -1}));
        const Vec3 along = vector_or("along", axes.north());
        set_key(keys, "aim", node_of(copy.transform.vector(aim), source_.line));
        if (length(cross(aim, along)) > 0) {  // else the lamp has a default
            set_key(keys, "along", node_of(copy.transform.vector(along), source_.line));
        }
    }

    const Node& source_;
    RunFileContext& context_;
    TableReader table_;
};

}  // namespace

std::vector<Node> lamp_tables(const Node& source, RunFileContext& context) {
    return LampCopies(source, context).make();
}

}  // namespace quasimc
