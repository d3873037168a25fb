#include "coupling/step_files.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "files/atomic_file.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// Areas of an organ and the light on it.
class TableRow {
  public:
    TableRow(const StepView& view, std::uint32_t query)
        : view_(view), query_(query), organ_(view.light.organs[query]) {}

    [[nodiscard]] std::string text() const {
        const double projected = projected_area();
        const double sunlit = sunlit_area();
        // The sampling error may make the sunlit area larger than the projected area.
        const double rest = projected - sunlit;
        const double shaded = rest < 0 ? 0 : rest;  // NaN stays NaN
        std::string row = fmt::format("{:g} {:g} {:g} {:g}", area(), projected, sunlit, shaded);
        const double on_horizontal = view_.lighting.on_horizontal();
        const std::size_t bands = view_.spec.band_count();
        for (std::size_t b = 0; b < bands; ++b) {
            const Estimate value = view_.returned(query_, b);
            const double relative = on_horizontal > 0 ? value.mean / on_horizontal : 0;
            row += fmt::format(
                " {:g} {:g} {:g}", value.mean, relative, variance_of(value.standard_error));
        }
        return row + (bands == 2 ? ratio_text() : "") + "\n";
    }

  private:
    /// Variance between runs; 0 where it is unknown: for a single run, and for H.
    [[nodiscard]] double variance_of(double standard_error) const {
        return std::isfinite(standard_error)
                   ? standard_error * standard_error * view_.spec.run.replicates
                   : 0;
    }

    [[nodiscard]] double area() const {
        return organ_ == kNoOrgan ? 0 : view_.light.scene->organs()[organ_].area;
    }

    /// Projected area along the light, the mean over all directions of light.
    [[nodiscard]] double projected_area() const {
        if (organ_ == kNoOrgan) {
            return 0;
        }
        const Organ& organ = view_.light.scene->organs()[organ_];
        double sum = 0;
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            const Vec3 n =
                area_vector(data_of(*view_.light.scene).triangles()[organ.first_triangle + i]);
            for (const LightShare& light : view_.lighting.shares) {
                sum += 0.5 * light.share * std::abs(dot(n, light.travel));
            }
        }
        return sum;
    }

    /// The part of the projected area that receives direct light, from the first band that has
    /// light. NaN if direct light is excluded.
    [[nodiscard]] double sunlit_area() const {
        if (view_.spec.run.direct_light == DirectLight::excluded) {
            return std::numeric_limits<double>::quiet_NaN();
        }
        for (std::size_t b = 0; b < view_.spec.band_count(); ++b) {
            if (view_.spec.irradiance[b] > 0) {
                return view_.light.at(organ_, Quantity::incident_direct, b).mean * area() /
                       view_.spec.irradiance[b];
            }
        }
        return 0;
    }

    /// The ratio of both bands; its variance as if they were independent (to first order).
    [[nodiscard]] std::string ratio_text() const {
        const Estimate a = view_.returned(query_, 0), b = view_.returned(query_, 1);
        if (b.mean == 0) {
            return " nan 0";
        }
        const double ratio = a.mean / b.mean;
        const double relative_error =
            std::hypot(a.standard_error / a.mean, b.standard_error / b.mean);
        return fmt::format(" {:g} {:g}", ratio, variance_of(ratio * relative_error));
    }

    const StepView& view_;
    std::uint32_t query_;
    std::uint32_t organ_;
};

std::string table_header(const Specification& spec) {
    std::string header = "actual_leaf_area mean_projected_area sunlit_area shaded_area";
    for (std::size_t b = 0; b < spec.band_count(); ++b) {
        header += fmt::format(" mean_flux{0} rel_mean_flux{0} variance{0}", b);
    }
    return header + (spec.band_count() == 2 ? " ratio variance_of_ratio\n" : "\n");
}

std::string default_name(const Specification& spec) {
    return fmt::format(
        "{}.{}.{}.dat", spec.run.sampler, spec.run.replicates, spec.one_ray_per_spectrum ? 1 : 0);
}

}  // namespace

std::string numbered_name(const std::string& name, std::uint64_t step) {
    const std::filesystem::path path(name);
    std::filesystem::path numbered = path.parent_path() / path.stem();
    numbered += fmt::format("{:04}", step);
    numbered += path.extension();
    return numbered.string();
}

std::string variance_table(const StepView& view) {
    std::string table = table_header(view.spec);
    for (std::uint32_t i = 0; i < view.pass.queries.size(); ++i) {
        const Query& query = view.pass.queries[i];
        if (view.spec.is_answered(query.asks) && query.organ != "Q" && query.organ != "J") {
            table += TableRow(view, i).text();
        }
    }
    return table;
}

void write_variance_file(const StepView& view) {
    const std::string& given = view.spec.variance_file->name;
    // The first step has the name of the specification.
    const bool is_exact = !given.empty() && view.step == 0;
    AtomicFile file(
        is_exact ? given
                 : numbered_name(given.empty() ? default_name(view.spec) : given, view.step));
    file.write(variance_table(view));
    file.commit();
}

}  // namespace quasimc
