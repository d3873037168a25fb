#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "meshio/gltf_values.h"

namespace quasimc {
namespace {

using Keys = std::span<const std::string_view>;

// The keys of glTF 2.0 (ISO/IEC 12113:2022, section 5). All objects have `extensions` and `extras`.
constexpr std::array<std::string_view, 19> kRootKeys{
    "accessors",
    "animations",
    "asset",
    "buffers",
    "bufferViews",
    "cameras",
    "extensions",
    "extras",
    "images",
    "materials",
    "extensionsRequired",
    "extensionsUsed",
    "meshes",
    "nodes",
    "samplers",
    "scene",
    "scenes",
    "skins",
    "textures"};
constexpr std::array<std::string_view, 4> kSceneKeys{"nodes", "name", "extensions", "extras"};
constexpr std::array<std::string_view, 12> kNodeKeys{
    "camera", "children",    "skin",    "matrix", "mesh",       "rotation",
    "scale",  "translation", "weights", "name",   "extensions", "extras"};
constexpr std::array<std::string_view, 5> kMeshKeys{
    "primitives", "weights", "name", "extensions", "extras"};
constexpr std::array<std::string_view, 7> kPrimitiveKeys{
    "attributes", "indices", "material", "mode", "targets", "extensions", "extras"};
constexpr std::array<std::string_view, 12> kAccessorKeys{
    "bufferView", "byteOffset", "componentType", "normalized", "count",      "type",
    "max",        "min",        "sparse",        "name",       "extensions", "extras"};
constexpr std::array<std::string_view, 8> kViewKeys{
    "buffer", "byteOffset", "byteLength", "byteStride", "target", "name", "extensions", "extras"};
constexpr std::array<std::string_view, 5> kBufferKeys{
    "uri", "byteLength", "name", "extensions", "extras"};

/// A list of the file, with the name and the keys of its objects.
struct ListKeys {
    std::string_view list, word;
    Keys keys;
};
constexpr std::array kListKeys{
    ListKeys{"scenes", "scene", kSceneKeys},
    ListKeys{"nodes", "node", kNodeKeys},
    ListKeys{"meshes", "mesh", kMeshKeys},
    ListKeys{"accessors", "accessor", kAccessorKeys},
    ListKeys{"bufferViews", "bufferView", kViewKeys},
    ListKeys{"buffers", "buffer", kBufferKeys}};

/// Number of unknown keys, and the first one.
struct UnknownKeys {
    std::size_t count = 0;
    std::string first;
};

void check_keys(const Node& object, std::string_view where, Keys keys, UnknownKeys& unknown) {
    const auto* members = object.as<Node::Table>();
    for (std::size_t i = 0; members != nullptr && i < members->size(); ++i) {
        const std::string& key = (*members)[i].key;
        if (std::find(keys.begin(), keys.end(), key) == keys.end() && unknown.count++ == 0) {
            const std::string_view near = nearest_word(key, keys);
            unknown.first = fmt::format(
                "{} in {}{}", shown(key), where,
                near.empty() ? "" : fmt::format("; did you mean '{}'?", near));
        }
    }
}

}  // namespace

void warn_of_unknown_keys(const Node& root, Reporter& reporter) {
    UnknownKeys unknown;
    check_keys(root, "the file", kRootKeys, unknown);
    for (const auto& [list, word, keys] : kListKeys) {
        std::size_t number = 0;
        for (const Node& object : gltf_list(root, list)) {
            const std::string where = fmt::format("{} {}", word, number++);
            check_keys(object, where, keys, unknown);
            for (const Node& primitive : gltf_list(object, "primitives")) {
                check_keys(primitive, where, kPrimitiveKeys, unknown);
            }
        }
    }
    if (unknown.count > 0) {
        reporter.warn(fmt::format(
            "keys that glTF 2.0 does not have are ignored: {} in total, the first is {}",
            unknown.count, unknown.first));
    }
}

}  // namespace quasimc
