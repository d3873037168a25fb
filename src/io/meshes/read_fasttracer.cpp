#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "io/meshes/formats.h"
#include "io/meshes/number_line.h"

namespace quasimc {
namespace {

constexpr std::size_t kColumns = 17, kIds = 5;
const std::string kFastTracerLine =
    "a line holds 17 numbers: five ids, x y z of three corners, nitrogen, transmittance, "
    "reflectance";

/// What the lines of a file have built so far: a group for each five ids, a material for each pair
/// of reflectance and transmittance.
class FastTracerReader {
  public:
    explicit FastTracerReader(Reporter& reporter) : reporter_(reporter) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        while (scanner.next() && !reporter_.is_full()) {
            line_ = scanner.number();
            const std::string_view text = scanner.line().substr(0, scanner.line().find('#'));
            const auto numbers = numbers_of_line(text, line_, kFastTracerLine, reporter_);
            if (numbers && !numbers->empty()) {
                read_columns(*numbers);
            }
        }
        return std::move(mesh_);
    }

  private:
    void read_columns(const std::vector<double>& columns) {
        if (columns.size() != kColumns) {
            reporter_.fault(line_, fmt::format("{} numbers", columns.size()), kFastTracerLine);
            return;
        }
        const double transmittance = columns[15], reflectance = columns[16];
        if (!(transmittance >= 0 && reflectance >= 0 && transmittance + reflectance <= 1)) {
            reporter_.fault(
                line_,
                fmt::format("transmittance {} and reflectance {}", transmittance, reflectance),
                "both are 0 or more, and at most 1 together");
            return;
        }
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::size_t corner = 0; corner < 3; ++corner) {
            mesh_.vertices.push_back(point_at(columns, kIds + 3 * corner));
        }
        MeshPart& part = part_of(group_of(columns), material_of(reflectance, transmittance));
        part.faces.push_back({first, first + 1, first + 2});
        part.lines.push_back(line_);
    }

    MeshGroup& group_of(const std::vector<double>& columns) {
        const std::vector<double> ids(columns.begin(), columns.begin() + kIds);
        const auto [group, is_new] = groups_.try_emplace(ids, mesh_.groups.size());
        if (is_new) {
            MeshGroup& made = mesh_.groups.emplace_back();
            for (std::size_t i = 0; i < kIds; ++i) {
                const std::string id = shortest(ids[i]);
                made.name += (i == 0 ? "" : "-") + id;
                made.labels.emplace_back(fmt::format("id{}", i + 1), id);
            }
        }
        return mesh_.groups[group->second];
    }

    const std::string& material_of(double reflectance, double transmittance) {
        std::string& name = materials_[{reflectance, transmittance}];
        if (name.empty()) {
            name = fmt::format("reflectance {} transmittance {}", reflectance, transmittance);
            mesh_.materials.push_back({name, reflectance, transmittance, false});
        }
        return name;
    }

    static MeshPart& part_of(MeshGroup& group, const std::string& material) {
        const auto known = std::find_if(
            group.parts.begin(), group.parts.end(),
            [&](const MeshPart& part) { return part.material == material; });
        return known != group.parts.end() ? *known
                                          : group.parts.emplace_back(MeshPart{material, {}, {}});
    }

    Reporter& reporter_;
    MeshFile mesh_{{}, {}, "line", {}};
    std::map<std::vector<double>, std::size_t> groups_;
    std::map<std::pair<double, double>, std::string> materials_;
    std::uint32_t line_ = 0;
};

}  // namespace

MeshFile read_fasttracer(std::string_view bytes, FormatContext& context) {
    return FastTracerReader(context.reporter).read(bytes);
}

}  // namespace quasimc
