#include "meshio/gltf_buffers.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "text/base64.h"
#include "text/line_scanner.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

constexpr std::uint32_t kGltfInt8 = 5120, kGltfUint8 = 5121, kGltfInt16 = 5122, kGltfUint16 = 5123,
                        kGltfUint32 = 5125, kGltfFloat = 5126;

std::size_t component_bytes(std::uint32_t type) {
    switch (type) {
        case kGltfInt8:
        case kGltfUint8:
            return 1;
        case kGltfInt16:
        case kGltfUint16:
            return 2;
        case kGltfUint32:
        case kGltfFloat:
            return 4;
        default:
            return 0;
    }
}

std::size_t components_of(const std::string& type) {
    constexpr std::array<std::string_view, 4> kTypes{"SCALAR", "VEC2", "VEC3", "VEC4"};
    const auto* const found = std::find(kTypes.begin(), kTypes.end(), type);
    return found == kTypes.end() ? 0 : static_cast<std::size_t>(found - kTypes.begin()) + 1;
}

/// Reads a number of the file; a normalized integer becomes a fraction.
template <typename T>
double component_at(const GltfAccessor& accessor, std::size_t at) {
    const auto number = static_cast<double>(little_endian_at<T>(accessor.bytes, at));
    if constexpr (std::numeric_limits<T>::is_integer) {
        return accessor.is_normalized
                   ? std::max(number / static_cast<double>(std::numeric_limits<T>::max()), -1.0)
                   : number;
    }
    return number;
}

constexpr std::size_t kGlbHeader = 12, kGlbChunkHeader = 8;
constexpr std::uint32_t kGlbVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::optional<GltfContainer> open_glb(std::string_view bytes, Reporter& reporter) {
    if (bytes.size() < kGlbHeader + kGlbChunkHeader) {
        reporter.fault(0, "the file is incomplete", "a GLB file needs a header and a JSON chunk");
        return std::nullopt;
    }
    const auto version = little_endian_at<std::uint32_t>(bytes, 4);
    if (version != kGlbVersion) {
        reporter.fault(
            0, fmt::format("it is GLB of version {}", version), "version 2 is read",
            "export it as glTF 2.0");
        return std::nullopt;
    }
    const auto given = little_endian_at<std::uint32_t>(bytes, 8);
    if (given > bytes.size()) {
        reporter.fault(
            0, "the file is incomplete",
            fmt::format("its header says {} bytes, it has {}", given, bytes.size()));
        return std::nullopt;
    }
    if (given < bytes.size()) {
        reporter.warn(fmt::format(
            "its header says {} bytes, it has {}; the rest is not read", given, bytes.size()));
    }
    GltfContainer parts;
    bytes = bytes.substr(0, given).substr(std::min<std::size_t>(kGlbHeader, given));
    while (bytes.size() >= kGlbChunkHeader) {
        const auto size = little_endian_at<std::uint32_t>(bytes, 0);
        const auto type = little_endian_at<std::uint32_t>(bytes, 4);
        bytes.remove_prefix(kGlbChunkHeader);
        if (size > bytes.size()) {
            reporter.fault(0, "a chunk extends beyond the end of the file", "its length is wrong");
            return std::nullopt;
        }
        if (type == kJsonChunk && parts.json.empty()) {
            parts.json = bytes.substr(0, size);
        } else if (type == kBinaryChunk && !parts.binary) {
            parts.binary = bytes.substr(0, size);
        }
        bytes.remove_prefix(size);
    }
    return parts;
}

/// Decodes the percent-escapes of a URI ("%20").
std::string without_escapes(std::string_view uri) {
    const auto digit = [](char c) {
        return c >= '0' && c <= '9'   ? c - '0'
               : c >= 'a' && c <= 'f' ? c - 'a' + 10
               : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                      : -1;
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool is_escape =
            uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0;
        if (is_escape) {
            path += static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

/// Reads the bytes of a URI: embedded ("data:...;base64,...") or in a file.
/// @throws InputError  if they can't be read
std::string read_gltf_uri(std::string_view uri, FormatContext& context) {
    const auto refuse = [](std::string why) -> std::string {
        throw InputError({{"", "", std::move(why), ""}});
    };
    if (uri.starts_with("data:")) {
        constexpr std::string_view kBase64 = ";base64,";
        const std::size_t at = uri.find(kBase64);
        if (at == std::string_view::npos) {
            return refuse("its data are not in base64");
        }
        const auto bytes = decode_base64(uri.substr(at + kBase64.size()));
        return bytes ? *bytes : refuse("its data are not base64");
    }
    const std::string path = without_escapes(uri);
    if (path.find("://") != std::string::npos) {
        return refuse("network files are not supported");
    }
    if (path.empty() || path.find('\0') != std::string::npos) {
        return refuse("its URI is not a file name");
    }
    return context.files.read(path.front() == '/' ? path : context.folder + path);
}

}  // namespace

std::optional<GltfContainer> open_gltf(std::string_view bytes, Reporter& reporter) {
    return bytes.starts_with("glTF") ? open_glb(bytes, reporter)
                                     : GltfContainer{without_bom(bytes), {}};
}

bool GltfAccessor::is_whole() const {
    return component_type != kGltfFloat && !is_normalized;
}

double GltfAccessor::at(std::size_t element, std::size_t component) const {
    const std::size_t at = element * stride + component * component_bytes(component_type);
    switch (component_type) {
        case kGltfInt8:
            return component_at<std::int8_t>(*this, at);
        case kGltfUint8:
            return component_at<std::uint8_t>(*this, at);
        case kGltfInt16:
            return component_at<std::int16_t>(*this, at);
        case kGltfUint16:
            return component_at<std::uint16_t>(*this, at);
        case kGltfUint32:
            return component_at<std::uint32_t>(*this, at);
        default:
            return component_at<float>(*this, at);
    }
}

GltfBuffers::GltfBuffers(const Node& root, const GltfContainer& container, FormatContext& context)
    : root_(root), values_(context.reporter), binary_(container.binary) {
    const Node::List& buffers = gltf_list(root, "buffers");
    read_.resize(buffers.size());
    bytes_.resize(buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        read_buffer(buffers[i], i, context);
    }
}

void GltfBuffers::read_buffer(const Node& json, std::size_t number, FormatContext& context) {
    find_buffer(json, number, context);
    const std::string where = fmt::format("buffer {}", number);
    const auto length = values_.whole(json, "byteLength", where);
    if (!bytes_[number] || !length || *length == bytes_[number]->size()) {
        return;
    }
    constexpr std::uint64_t kPadding = 3;  // a chunk of a GLB ends on a multiple of four
    const std::uint64_t size = bytes_[number]->size();
    if (*length > size || size - *length > kPadding) {
        context.reporter.warn(fmt::format(
            "{} has {} bytes, its byteLength is {}: the file may be incomplete or damaged", where,
            size, *length));
    }
}

void GltfBuffers::find_buffer(const Node& json, std::size_t number, FormatContext& context) {
    if (json.find("uri") == nullptr) {
        bytes_[number] = number == 0 ? binary_ : std::nullopt;
        return;
    }
    const std::string uri = gltf_text(json, "uri");
    try {
        read_[number] = read_gltf_uri(uri, context);
        bytes_[number] = read_[number];
    } catch (const InputError& error) {
        const std::string name = uri.starts_with("data:") ? "" : " " + shown(uri);
        values_.fault(
            fmt::format("buffer {}{} can't be read", number, name), error.faults().front().why);
    }
}

std::optional<std::pair<std::string_view, std::uint64_t>> GltfBuffers::view_bytes(
    const Node& view, std::uint64_t offset, const std::string& where) {
    const auto buffer = values_.index(view, "buffer", bytes_.size(), where);
    const std::uint64_t first = values_.whole(view, "byteOffset", where).value_or(0);
    const std::uint64_t length = values_.whole(view, "byteLength", where).value_or(0);
    const std::uint64_t stride = values_.whole(view, "byteStride", where).value_or(0);
    if (!buffer) {
        return std::nullopt;
    }
    if (!bytes_[*buffer]) {
        values_.fault(
            fmt::format("{}: buffer {} has no bytes", where, *buffer),
            "they are neither in the file nor beside it");
        return std::nullopt;
    }
    const std::uint64_t size = bytes_[*buffer]->size();
    if (first > size || length > size - first || offset > length) {
        values_.fault(
            fmt::format("{}: its bytes are missing", where),
            fmt::format("buffer {} has {}", *buffer, size));
        return std::nullopt;
    }
    return std::pair(bytes_[*buffer]->substr(first + offset, length - offset), stride);
}

bool GltfBuffers::find_bytes(const Node& json, GltfAccessor& accessor, const std::string& where) {
    const Node::List& views = gltf_list(root_, "bufferViews");
    const auto number = values_.index(json, "bufferView", views.size(), where);
    const auto offset = values_.whole(json, "byteOffset", where).value_or(0);
    const std::uint64_t count = values_.whole(json, "count", where).value_or(0);
    const auto range = number ? view_bytes(views[*number], offset, where) : std::nullopt;
    if (!range) {
        return false;
    }
    const auto& [bytes, stride] = *range;
    const std::uint64_t element = component_bytes(accessor.component_type) * accessor.components;
    accessor.bytes = bytes;
    accessor.count = count;
    accessor.stride = stride == 0 ? element : stride;
    const bool fits = count == 0 || (accessor.stride >= element && bytes.size() >= element &&
                                     count - 1 <= (bytes.size() - element) / accessor.stride);
    if (!fits) {
        values_.fault(
            fmt::format("{}: {} elements do not fit in its bufferView", where, count),
            fmt::format("it has {} bytes after the offset", bytes.size()));
    }
    return fits;
}

std::optional<GltfAccessor> GltfBuffers::accessor(std::size_t number) {
    const Node& json = gltf_list(root_, "accessors")[number];
    const std::string where = fmt::format("accessor {}", number);
    GltfAccessor accessor;
    constexpr std::uint64_t kNoType = 0;
    accessor.component_type =
        static_cast<std::uint32_t>(values_.whole(json, "componentType", where).value_or(kNoType));
    accessor.components = components_of(gltf_text(json, "type"));
    const Node* normalized = json.find("normalized");
    const bool* flag = normalized != nullptr ? normalized->as<bool>() : nullptr;
    accessor.low = gltf_numbers(json, "min");
    accessor.high = gltf_numbers(json, "max");
    accessor.is_normalized = flag != nullptr && *flag;
    if (accessor.components == 0 || component_bytes(accessor.component_type) == 0) {
        values_.fault(where + " has an unknown type", "");
        return std::nullopt;
    }
    if (json.find("sparse") != nullptr) {
        values_.fault(
            where + " is sparse", "sparse accessors are not supported",
            "export without sparse accessors");
        return std::nullopt;
    }
    if (json.find("bufferView") == nullptr) {
        values_.fault(where + " has no bufferView", "all its numbers would be 0");
        return std::nullopt;
    }
    return find_bytes(json, accessor, where) ? std::optional(accessor) : std::nullopt;
}

}  // namespace quasimc
