#include <map>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/formats.h"
#include "meshio/number_line.h"

namespace quasimc {
namespace {

constexpr std::size_t kColumns = 17, kIds = 5;
const std::string kFastTracerLine =
    "a line contains 17 numbers: five ids, x y z of three corners, nitrogen, transmittance, "
    "reflectance";

/// Builds groups and materials from the lines of a file: a group for each five ids, a material for
/// each pair of reflectance and transmittance.
class FastTracerReader {
  public:
    explicit FastTracerReader(Reporter& reporter) : reporter_(reporter) {}

    MeshFile read(std::string_view bytes) {
        take_number_lines(
            bytes, kColumns, kFastTracerLine, reporter_,
            [this](const std::vector<double>& columns, std::uint32_t line) {
                read_columns(columns, line);
            });
        return std::move(mesh_);
    }

  private:
    void read_columns(const std::vector<double>& columns, std::uint32_t line) {
        const double transmittance = columns[15], reflectance = columns[16];
        if (!(transmittance >= 0 && reflectance >= 0 && transmittance + reflectance <= 1)) {
            reporter_.fault(
                line,
                fmt::format("transmittance {} and reflectance {}", transmittance, reflectance),
                "both must be at least 0, and their sum at most 1");
            return;
        }
        const auto first = static_cast<std::uint32_t>(mesh_.vertices.size());
        for (std::size_t corner = 0; corner < 3; ++corner) {
            mesh_.vertices.push_back(point_at(columns, kIds + 3 * corner));
        }
        MeshPart& part = group_of(columns).part(material_of(reflectance, transmittance));
        part.faces.push_back({first, first + 1, first + 2});
        part.lines.push_back(line);
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

    Reporter& reporter_;
    MeshFile mesh_{{}, {}, "line", {}};
    std::map<std::vector<double>, std::size_t> groups_;
    std::map<std::pair<double, double>, std::string> materials_;
};

}  // namespace

MeshFile read_fasttracer(std::string_view bytes, FormatContext& context) {
    return FastTracerReader(context.reporter).read(bytes);
}

}  // namespace quasimc
