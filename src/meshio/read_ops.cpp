#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/file_axes.h"
#include "meshio/formats.h"
#include "meshio/ops_columns.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// The line of a plant.
struct OpsRow {
    std::string plant, file, kind;  ///< id, path of the file, group
    OpsNumbers numbers;
    std::uint32_t line = 0;
};

class OpsReader {
  public:
    explicit OpsReader(FormatContext& context)
        : context_(context), reporter_(context.reporter), unit_(context.units_per_metre()) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        std::string kind;
        while (scanner.next() && !reporter_.is_full()) {
            const std::string_view line = trimmed(scanner.line());
            constexpr std::string_view kGroup = "#[Archimed]";
            if (line.starts_with(kGroup)) {
                kind = trimmed(line.substr(kGroup.size()));
            } else if (line.starts_with('#')) {
                columns_.read_comment(line);
            } else if (!line.empty()) {
                read_line(line, kind, scanner.number());
            }
        }
        warn();
        return std::move(file_);
    }

  private:
    void read_line(std::string_view line, const std::string& kind, std::uint32_t number) {
        std::string_view rest = line;
        if (take_word(rest) == "T") {
            return;  // a line of the plot
        }
        const std::vector<std::string_view> fields = ops_fields(line);
        constexpr std::size_t kChaining = 3;
        if (fields.size() == kChaining) {
            return;  // a line of the order of plants
        }
        if (const auto numbers = columns_.numbers_of(fields, number, reporter_)) {
            add_plant({std::string(fields[1]), std::string(fields[2]), kind, *numbers, number});
        }
    }

    void add_plant(const OpsRow& row) {
        const Plant* plant = plant_of(row);
        if (plant == nullptr) {
            return;
        }
        constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
        if (file_.vertices.size() + plant->mesh.vertices.size() >= kMost) {
            reporter_.fault(row.line, "the scene has more than 4294967294 vertices", "");
            return;
        }
        const auto first = static_cast<std::uint32_t>(file_.vertices.size());
        const Affine transform = ops_transform(row.numbers, unit_, plant->size);
        Bounds bounds;
        for (const Vec3& point : plant->mesh.vertices) {
            file_.vertices.push_back(transform.point(point));
            bounds.add(file_.vertices.back());
        }
        if (plant->is_assumed && !plant->mesh.vertices.empty()) {
            const Vec3 size = bounds.size();
            largest_ = std::max({largest_, size.x, size.y, size.z});
        }
        for (const MeshGroup& group : plant->mesh.groups) {
            add_group(row, group, first, determinant(transform) < 0);
        }
    }

    /// @param first  index of the plant's first vertex
    void add_group(const OpsRow& row, MeshGroup group, std::uint32_t first, bool is_mirrored) {
        if (group.id) {
            group.labels.emplace_back("node", std::to_string(*group.id));
            group.id.reset();
        }
        add_label("plant", row.plant, group);
        add_label("group", row.kind, group);
        group.name = row.plant + (group.name.empty() ? "" : " ") + group.name;
        for (MeshPart& part : group.parts) {
            part.lines.assign(part.faces.size(), row.line);
            for (auto& [a, b, c] : part.faces) {
                a += first;
                b += first;
                c += first;
                if (is_mirrored) {
                    std::swap(b, c);
                }
            }
        }
        file_.groups.push_back(std::move(group));
    }

    static void add_label(std::string_view key, const std::string& value, MeshGroup& group) {
        std::erase_if(group.labels, [key](const auto& label) { return label.first == key; });
        if (!value.empty()) {
            group.labels.emplace_back(key, value);
        }
    }

    /// A plant's file.
    struct Plant {
        MeshFile mesh;
        double size = 1;          ///< units of the scene per unit of the file
        bool is_assumed = false;  ///< whether the unit is the assumed one of AMAP's programs
    };

    /// A plant's file, read once; null after a fault, which is reported once.
    const Plant* plant_of(const OpsRow& row) {
        const auto [entry, is_new] = plants_.try_emplace(row.file);
        if (is_new) {
            entry->second = read_plant(row);
        }
        return entry->second ? &*entry->second : nullptr;
    }

    std::optional<Plant> read_plant(const OpsRow& row) {
        const FormatEntry* format = format_of_path(row.file);
        if (format == nullptr || format->read == read_ops) {
            const ForeignFormat* foreign = foreign_format_of_path(row.file);
            reporter_.fault(
                row.line, fmt::format("the format of {} can't be read", shown(row.file)), "",
                foreign != nullptr ? std::string(foreign->advice)
                                   : "plants must be OPF or another geometry format");
            return std::nullopt;
        }
        const std::string path = context_.folder + row.file;
        Reporter inner{path, {}, {}};
        const std::size_t slash = path.rfind('/');
        FormatContext context{
            inner, context_.files, slash == std::string::npos ? "" : path.substr(0, slash + 1),
            context_.up, context_.length_unit};
        MeshFile plant;
        try {
            const std::string bytes = context_.files.read(path);
            plant = read_mesh(*format, bytes, context);
        } catch (const InputError& error) {
            reporter_.fault(
                row.line, fmt::format("{} can't be read", shown(path)), error.faults().front().why);
            return std::nullopt;
        }
        const bool is_good = inner.faults.empty();
        reporter_.add(inner);
        if (!is_good) {
            return std::nullopt;
        }
        name_materials(path, plant);
        if (format->has_units) {
            return Plant{std::move(plant), 1, false};
        }
        const bool is_assumed = !context_.plant_metres && format->plant_metres != 1;
        return Plant{
            std::move(plant), unit_ * context_.plant_metres.value_or(format->plant_metres),
            is_assumed};
    }

    /// Prefixes the materials with the file, as each file numbers its own: "coffee.opf material 0".
    /// If files in several folders share a name, the first uses its name, the others their paths.
    void name_materials(const std::string& path, MeshFile& plant) {
        const std::size_t slash = path.rfind('/');
        const std::string last = path.substr(slash == std::string::npos ? 0 : slash + 1);
        const std::string& first = first_paths_.try_emplace(last, path).first->second;
        const auto with = [](const std::string& file, const std::string& material) {
            return material.empty() ? "" : fmt::format("{} {}", one_line(file), material);
        };
        const auto renamed = [&](const std::string& material) {
            return with(first == path ? last : path, material);
        };
        for (const auto& [name, other] : plant.aliases) {
            file_.aliases.emplace(renamed(name), with(last, other));
        }
        for (MeshGroup& group : plant.groups) {
            for (MeshPart& part : group.parts) {
                if (first != path) {
                    file_.aliases.emplace(renamed(part.material), with(last, part.material));
                }
                part.material = renamed(part.material);
            }
        }
        for (MeshMaterial& material : plant.materials) {
            material.name = renamed(material.name);
            file_.materials.push_back(material);
        }
    }

    void warn() {
        columns_.warn(reporter_);
        if (largest_ > 0) {
            reporter_.warn(fmt::format(
                "plants are read in centimetres and their positions in metres, as in AMAP's "
                "programs; the largest plant is {:.3g} m large; set plant_unit "
                "(\"cm\", \"m\", ...) to confirm or change it",
                largest_ / unit_));
        }
    }

    FormatContext& context_;
    Reporter& reporter_;
    double unit_;  // units of the scene per metre
    MeshFile file_{{}, {}, "line", {}};
    std::map<std::string, std::optional<Plant>> plants_;  // by path; empty if it has faults
    std::map<std::string, std::string> first_paths_;      // by name without folder
    OpsColumns columns_;
    double largest_ = 0;  // size of plants whose unit is assumed
};

}  // namespace

MeshFile read_ops(std::string_view bytes, FormatContext& context) {
    return OpsReader(context).read(bytes);
}

}  // namespace quasimc
