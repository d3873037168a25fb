#include "io/meshes/gltf_container.h"

#include <fmt/format.h>

#include "io/base64.h"
#include "io/line_scanner.h"
#include "io/little_endian.h"

namespace quasimc {
namespace {

constexpr std::size_t kGlbHeader = 12, kGlbChunkHeader = 8;
constexpr std::uint32_t kGlbVersion = 2, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

std::optional<GltfContainer> open_glb(std::string_view bytes, Reporter& reporter) {
    if (bytes.size() < kGlbHeader + kGlbChunkHeader) {
        reporter.fault(0, "the file is cut short", "a GLB file has a header and a part of JSON");
        return std::nullopt;
    }
    const auto version = little_endian_at<std::uint32_t>(bytes, 4);
    if (version != kGlbVersion) {
        reporter.fault(
            0, fmt::format("it is GLB of version {}", version), "version 2 is read",
            "export it as glTF 2.0");
        return std::nullopt;
    }
    const auto stated = little_endian_at<std::uint32_t>(bytes, 8);
    if (stated > bytes.size()) {
        reporter.fault(
            0, "the file is cut short",
            fmt::format("its header states {} bytes, it has {}", stated, bytes.size()));
        return std::nullopt;
    }
    if (stated < bytes.size()) {
        reporter.warnings.push_back(
            {reporter.file, fmt::format(
                                "its header states {} bytes, it has {}: the rest is not read",
                                stated, bytes.size())});
    }
    GltfContainer parts;
    bytes = bytes.substr(0, stated).substr(std::min<std::size_t>(kGlbHeader, stated));
    while (bytes.size() >= kGlbChunkHeader) {
        const auto size = little_endian_at<std::uint32_t>(bytes, 0);
        const auto type = little_endian_at<std::uint32_t>(bytes, 4);
        bytes.remove_prefix(kGlbChunkHeader);
        if (size > bytes.size()) {
            reporter.fault(0, "a part of the file reaches beyond its end", "its length is wrong");
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

/// A URI with what "%20" and the like stand for.
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

}  // namespace

std::optional<GltfContainer> open_gltf(std::string_view bytes, Reporter& reporter) {
    return bytes.starts_with("glTF") ? open_glb(bytes, reporter)
                                     : GltfContainer{without_bom(bytes), {}};
}

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
        return bytes ? *bytes : refuse("its data are no base64 text");
    }
    const std::string path = without_escapes(uri);
    if (path.find("://") != std::string::npos) {
        return refuse("files on the network are not read");
    }
    if (path.empty() || path.find('\0') != std::string::npos) {
        return refuse("its name is no name of a file");
    }
    return context.files.read(path.front() == '/' ? path : context.folder + path);
}

}  // namespace quasimc
