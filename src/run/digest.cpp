#include "run/digest.h"

#include <bit>
#include <span>
#include <string_view>

#include "base/model_parameters.h"
#include "light/models/source.h"
#include "samplers/hash.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

/// Hashes numbers in order.
class Mixer {
  public:
    void add(std::uint64_t x) { hash_ = mix64(hash_ ^ x) + 0x9E3779B97F4A7C15U; }
    void add(double x) { add(std::bit_cast<std::uint64_t>(x)); }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    void add(std::span<const double> values) {
        add(std::uint64_t{values.size()});
        for (const double x : values) {
            add(x);
        }
    }
    void add(std::string_view text) {
        add(std::uint64_t{text.size()});
        for (const char c : text) {
            add(std::uint64_t{static_cast<unsigned char>(c)});
        }
    }
    void add(const ModelParameters& model) {
        add(model.model);
        add(model.values);
    }
    [[nodiscard]] std::uint64_t value() const { return hash_; }

  private:
    std::uint64_t hash_ = 0x51A4C0DE;
};

void add_geometry(const PreparedScene& prepared, Mixer& mixer) {
    const LocalMesh& mesh = prepared.caster().mesh();
    mixer.add(mesh.origin);
    mixer.add(mesh.scale);
    const Cell& cell = prepared.scene().cell();
    mixer.add(std::uint64_t{cell.along_x ? 2U : 0U} + (cell.along_y ? 1U : 0U));
    mixer.add(Vec3{cell.low_x, cell.low_y, 0});
    mixer.add(Vec3{cell.size_x, cell.size_y, 0});
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        for (const int corner : {0, 1, 2}) {
            mixer.add(mesh.vertex(i, corner));
        }
        mixer.add(std::uint64_t{prepared.region(i)});
    }
    for (const Organ& organ : prepared.scene().organs()) {
        mixer.add(organ.area);
        mixer.add(organ.least_cosine);
        mixer.add(std::uint64_t{organ.is_ground ? 2U : 0U} + (organ.measured ? 1U : 0U));
    }
}

void add_material(const Material& material, Mixer& mixer) {
    mixer.add(std::uint64_t{material.is_transparent() ? 1U : 0U});
    for (const SurfaceSide side : kSurfaceSides) {
        const std::vector<Lobe>& lobes = material.side(side).lobes();
        mixer.add(std::uint64_t{lobes.size()});
        for (const Lobe& lobe : lobes) {
            mixer.add(lobe.albedo);
            mixer.add(std::uint64_t{lobe.shape->hemisphere() == Hemisphere::reflected ? 0U : 1U});
            mixer.add(lobe.shape->parameters());
        }
    }
}

void add_optics(const PreparedScene& prepared, Mixer& mixer) {
    mixer.add(std::uint64_t{prepared.scene().regions().size()});
    for (const Region& region : prepared.scene().regions()) {
        mixer.add(std::uint64_t{region.material.value});
        mixer.add(std::uint64_t{region.organ.value});
    }
    for (const Material& material : data_of(prepared.scene()).materials) {
        add_material(material, mixer);
    }
}

void add_sources(const PreparedScene& prepared, Mixer& mixer) {
    mixer.add(std::uint64_t{prepared.lights().size()});
    for (const BoundSource& light : prepared.lights()) {
        mixer.add(light.source->spectrum());
        mixer.add(model_of(*light.source).parameters());
    }
    for (const std::string& origin : prepared.lights().origins()) {
        mixer.add(std::string_view(origin));
    }
    for (std::size_t i = 0; i < prepared.lights().size(); ++i) {
        if (prepared.lights().origin_count() > 1) {
            mixer.add(std::uint64_t{prepared.lights()[i].origin});
        }
    }
}

void add_detectors(const Scene& scene, Mixer& mixer) {
    for (const DetectorSpec& detector : scene.detectors()) {
        mixer.add(std::string_view(detector.type));
        mixer.add(std::string_view(detector.name));
        for (const auto& [name, value] : detector.parameters) {
            mixer.add(std::string_view(name));
            mixer.add(value);
        }
    }
}

void add_spec(const RunSpec& spec, Mixer& mixer) {
    mixer.add(std::string_view(spec.sampler));
    mixer.add(static_cast<std::uint64_t>(spec.method));
    mixer.add(spec.seed);
    mixer.add(std::uint64_t{spec.max_depth});
    mixer.add(spec.roulette_threshold);
    mixer.add(static_cast<std::uint64_t>(spec.start_area));
    mixer.add(static_cast<std::uint64_t>(spec.accelerator));
    if (spec.sun_shade == SunShade::apart) {
        mixer.add(std::string_view("sun_shade"));
    }
}

}  // namespace

std::uint64_t digest_of(const PreparedScene& prepared, const RunSpec& spec) {
    Mixer mixer;
    add_geometry(prepared, mixer);
    add_optics(prepared, mixer);
    add_sources(prepared, mixer);
    add_detectors(prepared.scene(), mixer);
    add_spec(spec, mixer);
    return mixer.value();
}

}  // namespace quasimc
