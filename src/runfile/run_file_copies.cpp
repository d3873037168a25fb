// Reads `at`: the copies of an organ, a file or a lamp.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/angles.h"
#include "base/text.h"
#include "results/where_expression.h"
#include "runfile/copies.h"
#include "runfile/ground_height.h"

namespace quasimc {
namespace {

constexpr std::string_view kKey = "at";
constexpr std::array<std::string_view, 7> kNumbers{"x",        "y",        "z",    "heading_deg",
                                                   "tilt_deg", "roll_deg", "scale"};

/// p -> linear * p in z-up axes.
using Linear = std::array<Vec3, 3>;

Linear product(const Linear& a, const Linear& b) {
    Linear result;
    for (std::size_t i = 0; i < 3; ++i) {
        result[i] = a[i].x * b[0] + a[i].y * b[1] + a[i].z * b[2];
    }
    return result;
}

/// Scaling and clockwise rotation seen from above, z up.
Linear turned(double heading_deg, double scale) {
    const double angle = heading_deg * kRadians;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    return {Vec3{c, s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, scale}};
}

/// The rotation that leans the up axis by an angle towards north, z up.
Linear leaned(double tilt_deg, const Orientation& orientation) {
    const Vec3 north = normalized(orientation.inward(orientation.north()));
    const Vec3 east{north.y, -north.x, 0};
    return rotation(east, -tilt_deg * kRadians);
}

/// Scales, turns about the up axis by roll, leans by tilt towards north, turns by heading, moves.
Affine transform_of(const CopyRow& row, const Orientation& orientation) {
    Linear linear = turned(row.heading_deg, row.scale);
    if (row.tilt_deg != 0) {
        linear =
            product(linear, product(leaned(row.tilt_deg, orientation), turned(row.roll_deg, 1)));
    } else if (row.roll_deg != 0) {
        linear = turned(row.heading_deg + row.roll_deg, row.scale);
    }
    Affine affine;
    if (orientation.up() == UpAxis::z) {
        affine.rows = linear;
    } else {
        // y up: z, x and y of the file are x, y and z.
        const auto& [x, y, z] = linear;
        affine.rows = {Vec3{y.y, y.z, y.x}, Vec3{z.y, z.z, z.x}, Vec3{x.y, x.z, x.x}};
    }
    affine.shift = row.position;
    return affine;
}

/// Reads the copies of a table by the form of `at`.
class CopyReader {
  public:
    CopyReader(TableReader& table, std::string_view name, RunFileContext& context)
        : table_(table), name_(name), context_(context) {}

    std::vector<Copy> read(const Node& node) {
        if (const auto* list = node.as<Node::List>()) {
            read_list(node, *list);
        } else if (node.as<Node::Table>() != nullptr) {
            TableReader keys(node, table_.what() + ": at", table_.reporter());
            keys.any("file") != nullptr ? read_table(keys) : read_regular(keys);
            above_ground_ = keys.boolean("above_ground").value_or(false);
            keys.finish();
        } else {
            refuse_form(node);
        }
        for (std::size_t i = 0; i < copies_.size(); ++i) {
            finish(copies_[i], static_cast<std::int64_t>(i) + 1);
        }
        return std::move(copies_);
    }

  private:
    void refuse_form(const Node& node) {
        table_.fault_at(
            node, "at is not a list of copies",
            "it must be [[x, y, z], ...], [{ x = 0, y = 0 }, ...], { file = \"...\" } or "
            "{ start = [x, y, z], along = [x, y, z], counts = 3 }");
    }

    void read_list(const Node& node, const Node::List& list) {
        const auto is_row = [](const Node& item) {
            return item.as<Node::List>() != nullptr || item.as<Node::Table>() != nullptr;
        };
        if (list.empty()) {
            table_.fault_at(
                node, "at is empty", "there would be no copy", "give at least one position");
            return;
        }
        if (std::none_of(list.begin(), list.end(), is_row)) {
            refuse_form(node);
            return;
        }
        for (const Node& item : list) {
            if (table_.reporter().is_full()) {
                return;
            }
            if (item.as<Node::Table>() != nullptr) {
                read_table_row(item);
            } else {
                read_number_row(item);
            }
        }
    }

    /// [x, y], [x, y, z], [x, y, z, heading_deg] or [x, y, z, heading_deg, scale].
    void read_number_row(const Node& node) {
        constexpr std::size_t kFewest = 2, kMost = 5;
        const auto* list = node.as<Node::List>();
        if (list == nullptr || list->size() < kFewest || list->size() > kMost) {
            table_.fault_at(
                node, "a copy in at is not a list of 2 to 5 numbers",
                "it must be [x, y], [x, y, z], [x, y, z, heading_deg] or [x, y, z, heading_deg, "
                "scale]");
            return;
        }
        CopyRow row{.line = node.line};
        const auto axes = horizontal_keys(context_.orientation.up());
        constexpr std::array<std::string_view, kMost> kKeys{"x", "y", "z", "heading_deg", "scale"};
        for (std::size_t i = 0; i < list->size(); ++i) {
            const auto number = table_.real_at(kKey, (*list)[i], TableReader::kFinite);
            if (!number) {
                return;
            }
            *number_of_row(row, list->size() == kFewest ? axes[i] : kKeys[i]) = *number;
        }
        add(std::move(row));
    }

    void read_table_row(const Node& node) {
        TableReader keys(node, table_.what() + ": at", table_.reporter());
        CopyRow row{.line = node.line};
        for (const Member& member : *node.as<Node::Table>()) {
            double* number = number_of_row(row, member.key);
            if (number == nullptr) {
                row.others.push_back(member);
            } else if (const auto given = keys.real(member.key)) {
                *number = *given;
            }
        }
        for (const std::string_view axis : horizontal_keys(context_.orientation.up())) {
            if (node.find(axis) == nullptr) {
                keys.missing(axis);
            }
        }
        if (!keys.failed()) {
            add(std::move(row));
        }
    }

    void read_table(TableReader& keys) {
        for (CopyRow& row : read_copy_table(keys, context_)) {
            add(std::move(row));
        }
    }

    void read_regular(TableReader& keys) {
        std::optional<CopyArray> array = read_array(keys, name_);
        if (!array) {
            return;
        }
        for (std::size_t k = 0; k < array->rows.size(); ++k) {
            const auto number = static_cast<std::int64_t>(k);
            add(std::move(array->rows[k]));
            copies_.back().i = number % array->along + 1;
            copies_.back().j = number / array->along + 1;
        }
    }

    void add(CopyRow row) {
        if (!(row.scale > 0)) {
            table_.fault_at(
                Node{{}, row.line}, fmt::format("at: the scale of a copy is {}", row.scale),
                "it must be more than 0");
            return;
        }
        copies_.push_back({.row = std::move(row)});
    }

    /// Sets what follows from the row.
    void finish(Copy& copy, std::int64_t number) {
        copy.number = number;
        if (above_ground_) {
            raise(copy);
        }
        copy.transform = transform_of(copy.row, context_.orientation);
    }

    void raise(Copy& copy) {
        const Orientation& axes = context_.orientation;
        const Vec3 p = axes.inward(copy.row.position);
        const auto height = context_.ground != nullptr
                                ? ground_height(*context_.ground, axes, p.x, p.y)
                                : std::nullopt;
        if (height) {
            copy.row.position += axes.outward({0, 0, *height});
        } else if (!is_off_ground_) {
            is_off_ground_ = true;
            table_.fault_at(
                kKey, fmt::format("at: copy {} is not above the ground", copy.number),
                context_.ground != nullptr ? "above_ground needs a ground below every copy"
                                           : "above_ground needs a ground",
                "give its height as z");
        }
    }

    TableReader& table_;
    std::string_view name_;
    RunFileContext& context_;
    std::vector<Copy> copies_;
    bool above_ground_ = false, is_off_ground_ = false;
};

}  // namespace

std::array<std::string_view, 2> horizontal_keys(UpAxis up) {
    return up == UpAxis::z ? std::array<std::string_view, 2>{"x", "y"}
                           : std::array<std::string_view, 2>{"x", "z"};
}

double* number_of_row(CopyRow& row, std::string_view key) {
    const std::array<double*, kNumbers.size()> numbers{
        &row.position.x, &row.position.y, &row.position.z, &row.heading_deg,
        &row.tilt_deg,   &row.roll_deg,   &row.scale};
    const auto found = std::find(kNumbers.begin(), kNumbers.end(), key);
    return found == kNumbers.end() ? nullptr
                                   : numbers[static_cast<std::size_t>(found - kNumbers.begin())];
}

std::optional<std::vector<Copy>> read_copies(
    TableReader& table, std::string_view name, RunFileContext& context) {
    const Node* node = table.any(kKey);
    if (node == nullptr) {
        return std::nullopt;
    }
    const std::size_t before = table.reporter().faults.size();
    std::vector<Copy> copies = CopyReader(table, name, context).read(*node);
    const bool failed = table.reporter().faults.size() > before;
    return failed ? std::nullopt : std::optional(std::move(copies));
}

std::optional<WhereExpression> read_where(TableReader& table, std::string_view key) {
    const std::optional<std::string> text = table.text(key);
    try {
        return text ? std::optional(WhereExpression(*text)) : std::nullopt;
    } catch (const InputError& error) {
        const Fault& fault = error.faults().front();
        table.fault_at(key, fmt::format("{}: {}", key, fault.problem), fault.why, fault.suggestion);
        return std::nullopt;
    }
}

}  // namespace quasimc
