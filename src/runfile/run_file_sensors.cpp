// Reads [[sensors]].

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/copies.h"
#include "runfile/ground_height.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr Range kRadius{0, 1e30}, kHeights{-1e30, 1e30};

/// Reads one table.
class SensorReader {
  public:
    SensorReader(const Node& node, RunFileContext& context)
        : context_(context), table_(node, "sensors", *context.reporter) {}

    /// The set, or one for each of its heights; empty after a fault.
    std::vector<SensorSet> read() {
        SensorSet set{.name = table_.text("name").value_or("sensors")};
        if (set.name.empty()) {
            table_.fault_at("name", "its name is empty");
        }
        table_.rename(fmt::format("sensors '{}'", set.name));
        set.where = table_.where();
        set.radius = table_.real("size", kRadius).value_or(0);
        set.is_averaged = table_.boolean("average").value_or(false);
        read_receiver(set);
        const Vec3 facing = read_facing();
        const Labels labels = read_labels(table_);
        const std::vector<double> heights = read_heights();
        const auto copies = read_copies(table_, set.name, context_);
        if (table_.any("at") == nullptr) {
            table_.missing("at");
        }
        table_.finish();
        if (!copies || table_.failed()) {
            return {};
        }
        add_points(*copies, facing, labels, set);
        check_above_ground(*copies, heights.empty() ? 0 : std::ranges::min(heights));
        return table_.failed() ? std::vector<SensorSet>{} : at_heights(std::move(set), heights);
    }

  private:
    /// Reads heights; empty if there are none, or after a fault.
    std::vector<double> read_heights() {
        const Node* node = table_.any("heights");
        std::vector<double> heights;
        if (node == nullptr) {
            return heights;
        }
        const auto* list = node->as<Node::List>();
        if (list == nullptr || list->empty()) {
            table_.fault_at(
                "heights", list == nullptr ? "heights is not a list" : "heights is empty", "",
                "give [0.2, 0.5, 1], or leave it out for the points alone");
            return heights;
        }
        for (const Node& item : *list) {
            const auto height = table_.real_at("heights", item, kHeights);
            if (height && std::ranges::find(heights, *height) != heights.end()) {
                table_.fault_at("heights", fmt::format("heights has {} twice", shortest(*height)));
            }
            heights.push_back(height.value_or(0));
        }
        return heights;
    }

    /// Repeats a set above its points.
    [[nodiscard]] std::vector<SensorSet> at_heights(
        SensorSet set, const std::vector<double>& heights) const {
        if (heights.empty()) {
            return {std::move(set)};
        }
        std::vector<SensorSet> sets;
        for (const double height : heights) {
            SensorSet& own = sets.emplace_back(set);
            const std::string suffix = fmt::format(" at {}", shortest(height));
            own.name += suffix;
            for (SensorPoint& point : own.points) {
                point.name += suffix;
                point.position += context_.orientation.outward({0, 0, height});
            }
        }
        return sets;
    }

    void read_receiver(SensorSet& set) {
        constexpr std::array<std::string_view, 2> kReceivers{"cosine", "sphere"};
        const bool is_sphere = table_.choice("receiver", kReceivers) == "sphere";
        set.receiver = is_sphere ? Receiver::sphere : Receiver::cosine;
        const auto angle = table_.real("field_of_view_deg", {0, 90});
        if (is_sphere && angle) {
            table_.fault_at(
                "field_of_view_deg", "field_of_view_deg of a sphere",
                "it receives light from all directions", "remove it, or receiver");
        } else if (angle && *angle == 0) {
            table_.fault_at(
                "field_of_view_deg", "field_of_view_deg is 0", "it must be more than 0");
        }
        set.field_of_view_deg = angle.value_or(set.field_of_view_deg);
    }

    /// The direction of the upper side before a copy turns it, the file's axes.
    Vec3 read_facing() {
        const Orientation& axes = context_.orientation;
        const Vec3 up = axes.outward({0, 0, 1});
        const Node* node = table_.any("facing");
        if (node == nullptr) {
            return up;
        }
        if (node->as<Node::Table>() != nullptr) {
            return read_angles(*node);
        }
        if (node->as<Node::List>() != nullptr) {
            const Vec3 facing = table_.vector("facing").value_or(up);
            if (facing == Vec3{}) {
                table_.fault_at("facing", "facing is [0, 0, 0]", "it has no direction");
            }
            return facing;
        }
        const auto* text = node->as<std::string>();
        if (text == nullptr || (*text != "up" && *text != "down")) {
            table_.fault_at(
                *node, "facing is not a direction",
                "it must be \"up\", \"down\", [x, y, z] or { azimuth_deg = 180, elevation_deg = 30 "
                "}");
            return up;
        }
        return *text == "down" ? -up : up;
    }

    Vec3 read_angles(const Node& node) {
        TableReader keys(node, table_.what() + ": facing", table_.reporter());
        const double azimuth = keys.real("azimuth_deg").value_or(0);
        const double elevation = keys.real("elevation_deg", {-90, 90}).value_or(0);
        keys.finish();
        const Orientation& axes = context_.orientation;
        return axes.outward(axes.towards(azimuth, elevation));
    }

    void add_points(
        const std::vector<Copy>& copies, const Vec3& facing, const Labels& given, SensorSet& set) {
        CopyTexts texts(table_, copies);
        const std::vector<Labels> labels = texts.labels(given);
        const std::vector<std::string> names = texts.names(set.name, "");
        for (std::size_t i = 0; i < copies.size() && i < names.size(); ++i) {
            const Copy& copy = copies[i];
            if (copy.row.scale != 1) {
                table_.fault_at(
                    "at",
                    fmt::format("at: the scale of copy {} is {}", copy.number, copy.row.scale),
                    "a sensor has a size of its own", "give size");
                return;
            }
            SensorPoint point{
                names[i], labels[i], copy.row.position, copy.transform.vector(facing)};
            add_index(copy, point.labels);
            set.points.push_back(std::move(point));
        }
        if (!copies.empty() && copies.back().i) {
            set.counts = {
                static_cast<std::size_t>(*copies.back().i),
                static_cast<std::size_t>(*copies.back().j)};
        }
    }

    /// The labels i and j of a point of an array.
    static void add_index(const Copy& copy, Labels& labels) {
        const std::array<std::pair<const char*, std::optional<std::int64_t>>, 2> indices{
            {{"i", copy.i}, {"j", copy.j}}};
        for (const auto& [key, index] : indices) {
            if (index && find_label(labels, key) == nullptr) {
                labels.emplace_back(key, std::to_string(*index));
            }
        }
    }

    /// Reports points below the ground. @param lift  of all points
    void check_above_ground(const std::vector<Copy>& copies, double lift) {
        const Orientation& axes = context_.orientation;
        std::size_t below = 0;
        std::string first;
        for (const Copy& copy : copies) {
            const Vec3 p = axes.inward(copy.row.position);
            const auto height = context_.ground != nullptr
                                    ? ground_height(*context_.ground, axes, p.x, p.y)
                                    : std::nullopt;
            if (height && p.z + lift < *height) {
                first = below > 0 ? first
                        : copy.i  ? fmt::format("{},{}", *copy.i, *copy.j)
                                  : std::to_string(copy.number);
                ++below;
            }
        }
        if (below > 0) {
            table_.fault_at(
                "at",
                fmt::format(
                    "{} is below the ground at {} of {} points (first: {})",
                    axes.up() == UpAxis::z ? "z" : "y", below, copies.size(), first),
                "", "say above_ground = true, or raise them");
        }
    }

    RunFileContext& context_;
    TableReader table_;
};

}  // namespace

void read_sensors(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("sensors")) {
        for (SensorSet& set : SensorReader(*node, context).read()) {
            builder.add_sensors(std::move(set));
        }
    }
}

}  // namespace quasimc
