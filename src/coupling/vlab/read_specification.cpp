#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/vlab/directive_table.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

using Tables = std::vector<DirectiveEntry>;

/// All directives that a kind of specification knows.
Tables known_directives(SpecificationKind kind) {
    const Dialect other =
        kind == SpecificationKind::montecarlo ? Dialect::quasimc : Dialect::montecarlo;
    Tables all;
    for (const auto table :
         {light_directives(), material_directives(), run_directives(), scene_directives(),
          montecarlo_directives()}) {
        std::copy_if(
            table.begin(), table.end(), std::back_inserter(all),
            [&](const DirectiveEntry& entry) { return entry.dialect != other; });
    }
    return all;
}

const DirectiveEntry* find_directive(const Tables& tables, std::string_view name) {
    const auto found = std::find_if(
        tables.begin(), tables.end(), [&](const DirectiveEntry& e) { return e.name == name; });
    return found == tables.end() ? nullptr : &*found;
}

/// MonteCarlo if some directive is known to it alone, and none to QuasiMC alone.
SpecificationKind recognized_kind(const std::vector<DirectiveLine>& lines) {
    const Tables quasimc = known_directives(SpecificationKind::quasimc);
    const Tables montecarlo = known_directives(SpecificationKind::montecarlo);
    const auto has = [&](const Tables& only, const Tables& not_in) {
        return std::any_of(lines.begin(), lines.end(), [&](const DirectiveLine& line) {
            return find_directive(only, line.name) != nullptr &&
                   find_directive(not_in, line.name) == nullptr;
        });
    };
    return has(montecarlo, quasimc) && !has(quasimc, montecarlo) ? SpecificationKind::montecarlo
                                                                 : SpecificationKind::quasimc;
}

/// Sends a notice of an unknown directive, which is skipped as in the original program.
void unknown_directive(
    const DirectiveLine& line, const std::string& where, const Tables& tables, Notices& notices) {
    std::vector<std::string_view> names;
    names.reserve(tables.size());
    for (const DirectiveEntry& entry : tables) {
        names.push_back(entry.name);
    }
    const std::string_view nearest = nearest_word(line.name, names);
    notices.once(fmt::format(
        "{}: {} is not a directive and is ignored; {}", where, shown(line.name),
        nearest.empty() ? "docs/reference/specification.md lists them"
                        : fmt::format("did you mean '{}'?", nearest)));
}

/// Reads the directives of a kind, first those that others depend on.
class SpecificationReader {
  public:
    SpecificationReader(const std::string& name, InputFiles& files, Notices& notices)
        : context_{spec_, files, notices, nullptr, name} {}

    Specification read(const std::vector<DirectiveLine>& lines, Faults& faults) {
        const Tables tables = known_directives(spec_.kind);
        constexpr std::string_view kFirst = "spectrum samples";
        for (const bool first : {true, false}) {
            for (const DirectiveLine& line : lines) {
                if ((line.name == kFirst) == first) {
                    read_line(line, tables, faults);
                }
            }
        }
        finish(faults);
        return std::move(spec_);
    }
    void set_kind(SpecificationKind kind) {
        spec_.kind = kind;
        spec_.run.sampler = "sobol";
        spec_.run.replicates = 1;
        spec_.run.max_depth = kind == SpecificationKind::montecarlo ? 3 : 5;
    }

  private:
    void read_line(const DirectiveLine& line, const Tables& tables, Faults& faults) {
        const std::string where = fmt::format("{}:{}", context_.file, line.number);
        const DirectiveEntry* entry = find_directive(tables, line.name);
        if (entry == nullptr) {
            unknown_directive(line, where, tables, context_.notices);
            return;
        }
        Values values(where, line.name, line.value, faults, context_.notices);
        context_.line = &line;
        entry->read(values, context_);
        values.finish();
        const bool has_block = line.name == "material" || line.name.starts_with("leaf material");
        if (!has_block && !line.block.empty()) {
            faults.add(
                {fmt::format("{}:{}", context_.file, line.block.front().first),
                 "a line of a material is here",
                 fmt::format("the directive before it is '{}'", line.name),
                 "lines that begin with ':' must follow a material"});
        }
    }

    /// Checks that need all directives.
    void finish(Faults& faults) {
        if (!spec_.one_ray_per_spectrum && spec_.band_count() == 1) {
            spec_.one_ray_per_spectrum = true;  // no difference for one band
        }
        if (spec_.kind == SpecificationKind::montecarlo) {
            finish_montecarlo(faults);
        }
        constexpr std::uint32_t kUsualRuns = 8;
        if (spec_.run.target_error > 0 && spec_.run.replicates < 2) {
            spec_.run.replicates = kUsualRuns;  // one replicate has no error estimate
        }
        spec_.returns.resize(spec_.band_count(), ReturnType::flux);
        for (auto& material : spec_.materials) {
            for (SideOptics& optics : material) {
                set_model(optics.reflection_model, optics.reflection_parameters);
                set_model(optics.transmission_model, optics.transmission_parameters);
            }
        }
        if (spec_.ground && spec_.ground->material >= spec_.materials.size()) {
            faults.add(
                {context_.ground_where,
                 fmt::format(
                     "the ground is of material {}",
                     spec_.first_material() + spec_.ground->material),
                 fmt::format(
                     "materials are {} to {}", spec_.first_material(),
                     spec_.first_material() + spec_.materials.size() - 1),
                 ""});
        }
        if (spec_.lights.empty() && !spec_.sky && !spec_.sky_table && !spec_.has_uniform_sky) {
            spec_.lights.push_back({{0, -1, 0}, 1});
        }
        if (spec_.run.sampler == "korobov") {
            round_paths();
        }
    }

    /// A negative exponent, or one of 100 and more, means a mirror (or light that goes straight
    /// on).
    void set_model(std::string& model, BsdfParameters& parameters) const {
        constexpr double kMirror = 100;
        const double exponent = parameters["exponent"];
        const bool is_mirror = exponent < 0 || exponent >= kMirror;
        model = is_mirror ? "mirror" : spec_.light_model;
        if (is_mirror || model == "lambertian") {
            parameters.clear();
        }
    }

    void finish_montecarlo(Faults& faults) {
        if (context_.is_periodic && !context_.domain) {
            faults.add(
                {context_.file, "a periodic canopy has no domain", "the size is the period",
                 "add 'domain size: x y z'"});
        }
        if (context_.is_periodic) {
            spec_.cell = context_.domain;
        }
        if (spec_.ray_density && context_.domain) {
            const double paths =
                *spec_.ray_density * context_.domain->size_x * context_.domain->size_z;
            constexpr double kMost = 1 << 30;
            spec_.run.paths = static_cast<std::uint64_t>(std::clamp(std::ceil(paths), 1.0, kMost));
        }
    }

    /// Rounds the number of paths to the nearest power of two, for lattices.
    void round_paths() {
        const std::uint64_t rounded = nearest_power_of_two(spec_.run.paths);
        if (rounded != spec_.run.paths) {
            context_.notices.once(fmt::format(
                "{}: korobov needs powers of two; {} rays are used instead of {}", context_.file,
                rounded, spec_.run.paths));
        }
        spec_.run.paths = rounded;
    }

    Specification spec_;
    DirectiveContext context_;
};

}  // namespace

std::uint64_t nearest_power_of_two(std::uint64_t count) {
    const double exponent = std::round(std::log2(static_cast<double>(count)));
    return std::uint64_t{1} << static_cast<unsigned>(exponent);
}

std::optional<std::string> file_text(
    const std::string& name, Values& values, DirectiveContext& context) {
    if (name.empty()) {
        values.fault("the name of a file is missing");
        return std::nullopt;
    }
    try {
        return context.files.read(name);
    } catch (const InputError& error) {
        values.fault(error.what());
        return std::nullopt;
    }
}

Specification read_specification_text(
    std::string_view text,
    const std::string& name,
    SpecificationKind kind,
    InputFiles& files,
    Notices& notices) {
    Faults faults;
    const std::vector<DirectiveLine> lines = split_directives(text, name, notices);
    SpecificationReader reader(name, files, notices);
    reader.set_kind(kind == SpecificationKind::automatic ? recognized_kind(lines) : kind);
    Specification spec = reader.read(lines, faults);
    faults.throw_if_any();
    return spec;
}

Specification read_specification(
    const std::string& path, SpecificationKind kind, Notices& notices) {
    InputFiles files(std::filesystem::path{});
    return read_specification_text(read_file(path), path, kind, files, notices);
}

}  // namespace quasimc
