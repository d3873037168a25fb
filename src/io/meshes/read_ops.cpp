#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/meshes/file_axes.h"
#include "io/meshes/formats.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

/// A line that places a plant.
struct OpsRow {
    std::string plant, file, kind;  ///< its id; path; the group that it belongs to
    Affine transform;
    std::uint32_t line = 0;
};

/// The rotation by an angle about the vertical, and by another one that inclines it towards an
/// azimuth; radians, counter-clockwise from x. As PlantGeom.jl does it: first the turn, then the
/// scale, the inclination and the shift.
Affine ops_transform(const std::vector<double>& numbers) {
    const double scale = numbers[3], azimuth = numbers[4], angle = numbers[5], turn = numbers[6];
    const double c = std::cos(turn), s = std::sin(turn);
    const Affine turned{
        {Vec3{c * scale, -s * scale, 0}, Vec3{s * scale, c * scale, 0}, Vec3{0, 0, scale}}, {}};
    // Rodrigues' formula about the horizontal axis (-sin azimuth, cos azimuth, 0).
    const double x = -std::sin(azimuth), y = std::cos(azimuth);
    const double cosine = std::cos(angle), sine = std::sin(angle), rest = 1 - cosine;
    const Affine inclined{
        {Vec3{cosine + x * x * rest, x * y * rest, y * sine},
         Vec3{x * y * rest, cosine + y * y * rest, -x * sine}, Vec3{-y * sine, x * sine, cosine}},
        Vec3{numbers[0], numbers[1], numbers[2]}};
    return after(inclined, turned);
}

class OpsReader {
  public:
    explicit OpsReader(FormatContext& context) : context_(context), reporter_(context.reporter) {}

    MeshFile read(std::string_view bytes) {
        LineScanner scanner(bytes);
        std::string kind;
        while (scanner.next() && !reporter_.is_full()) {
            const std::string_view line = trimmed(scanner.line());
            constexpr std::string_view kGroup = "#[Archimed]";
            if (line.starts_with(kGroup)) {
                kind = trimmed(line.substr(kGroup.size()));
            } else if (!line.empty() && !line.starts_with('#')) {
                read_line(line, kind, scanner.number());
            }
        }
        return std::move(file_);
    }

  private:
    void read_line(std::string_view line, const std::string& kind, std::uint32_t number) {
        std::string_view rest = line;
        if (take_word(rest) == "T") {
            return;  // the plot
        }
        const std::vector<std::string_view> fields = fields_of(line);
        constexpr std::size_t kFields = 10, kChaining = 3;
        if (fields.size() == kChaining) {
            return;  // which plants follow which
        }
        if (fields.size() != kFields) {
            reporter_.fault(
                number, fmt::format("{} fields", fields.size()),
                "a plant has ten: scene, plant, file, x, y, z, scale, azimuth and angle of "
                "inclination, twist");
            return;
        }
        std::vector<double> numbers;
        for (std::size_t i = 3; i < kFields; ++i) {
            const auto real = parse_real(fields[i]);
            if (!real || !std::isfinite(*real)) {
                reporter_.fault(number, shown(fields[i]) + " is not a finite number", "");
                return;
            }
            numbers.push_back(*real);
        }
        add_plant(
            {std::string(fields[1]), std::string(fields[2]), kind, ops_transform(numbers), number});
    }

    /// Between tabs, if there are any: names of files may hold blanks.
    static std::vector<std::string_view> fields_of(std::string_view line) {
        const Separators separators = line.find('\t') == line.npos ? kBlanks : "\t";
        std::vector<std::string_view> fields;
        for (std::string_view word = take_word(line, separators); !word.empty();
             word = take_word(line, separators)) {
            fields.push_back(trimmed(word));
        }
        return fields;
    }

    void add_plant(const OpsRow& row) {
        const MeshFile* plant = plant_of(row);
        if (plant == nullptr) {
            return;
        }
        constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
        if (file_.vertices.size() + plant->vertices.size() >= kMost) {
            reporter_.fault(row.line, "the scene has more than 4294967294 vertices", "");
            return;
        }
        const auto first = static_cast<std::uint32_t>(file_.vertices.size());
        for (const Vec3& point : plant->vertices) {
            file_.vertices.push_back(row.transform.point(point));
        }
        for (const MeshGroup& group : plant->groups) {
            add_group(row, group, first);
        }
    }

    /// @param first  the number of the plant's first vertex
    void add_group(const OpsRow& row, MeshGroup group, std::uint32_t first) {
        if (group.id) {
            group.labels.emplace_back("node", std::to_string(*group.id));
            group.id.reset();
        }
        add_label("plant", row.plant, group);
        add_label("group", row.kind, group);
        group.name = row.plant + (group.name.empty() ? "" : " ") + group.name;
        const bool is_mirrored = determinant(row.transform) < 0;
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

    /// The geometry of a plant's file, read once; null after a fault, which is told once.
    const MeshFile* plant_of(const OpsRow& row) {
        const auto [entry, is_new] = plants_.try_emplace(row.file);
        if (is_new) {
            entry->second = read_plant(row);
        }
        return entry->second ? &*entry->second : nullptr;
    }

    std::optional<MeshFile> read_plant(const OpsRow& row) {
        const FormatEntry* format = format_of_path(row.file);
        if (format == nullptr || format->read == read_ops) {
            reporter_.fault(
                row.line, fmt::format("the format of {} can't be read", shown(row.file)), "",
                "plants are OPF, or of another format of geometry");
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
        name_materials(path.substr(slash == std::string::npos ? 0 : slash + 1), plant);
        return is_good ? std::optional(std::move(plant)) : std::nullopt;
    }

    /// Files number their materials each for itself: "coffee.opf material 0".
    void name_materials(const std::string& file, MeshFile& plant) {
        const auto name = [&](std::string& material) {
            material = material.empty() ? "" : fmt::format("{} {}", one_line(file), material);
        };
        for (MeshGroup& group : plant.groups) {
            for (MeshPart& part : group.parts) {
                name(part.material);
            }
        }
        for (MeshMaterial& material : plant.materials) {
            name(material.name);
            file_.materials.push_back(material);
        }
    }

    FormatContext& context_;
    Reporter& reporter_;
    MeshFile file_{{}, {}, "line", {}};
    std::map<std::string, std::optional<MeshFile>> plants_;  // by path; none: it has faults
};

}  // namespace

MeshFile read_ops(std::string_view bytes, FormatContext& context) {
    return OpsReader(context).read(bytes);
}

}  // namespace quasimc
