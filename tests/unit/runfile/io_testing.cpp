#include "unit/runfile/io_testing.h"

#include <algorithm>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

InputFiles::Reader reader_of(const FakeFiles& files) {
    return [files](const std::filesystem::path& path) {
        const auto found = files.find(path.lexically_relative("/run").string());
        if (found == files.end()) {
            throw InputError({{path.string(), "can't be read", "No such file or directory", ""}});
        }
        return found->second;
    };
}

std::vector<std::string> texts_of(const InputError& error) {
    std::vector<std::string> texts;
    for (const Fault& fault : error.faults()) {
        texts.push_back(fault.text());
    }
    return texts;
}

}  // namespace

RunFile read_text(
    const std::string& text, const FakeFiles& files, const std::vector<Override>& overrides) {
    InputFiles inputs("/run", reader_of(files));
    return read_run_text(text, "run.toml", inputs, overrides);
}

std::vector<std::string> faults_of(
    const std::string& text, const FakeFiles& files, const std::vector<Override>& overrides) {
    try {
        static_cast<void>(read_text(text, files, overrides));
    } catch (const InputError& error) {
        return texts_of(error);
    }
    return {};
}

ReadMesh read_mesh_text(std::string_view format, std::string_view bytes, const FakeFiles& files) {
    Reporter reporter{"file", {}, {}};
    InputFiles inputs("/run", reader_of(files));
    FormatContext context{reporter, inputs, ""};
    ReadMesh result;
    result.mesh = read_mesh(*find_format(format), bytes, context);
    try {
        reporter.faults.throw_if_any();
    } catch (const InputError& error) {
        result.faults = texts_of(error);
    }
    for (const Warning& warning : reporter.warnings) {
        result.warnings.push_back(warning.where + ": " + warning.text);
    }
    return result;
}

std::vector<Triangle> triangles_of(const MeshFile& mesh) {
    std::vector<Triangle> triangles;
    for (const MeshGroup& group : mesh.groups) {
        for (const MeshPart& part : group.parts) {
            for (std::size_t i = 0; i < part.faces.size(); ++i) {
                triangles.push_back(mesh.triangle(part, i));
            }
        }
    }
    return triangles;
}

std::vector<std::string> warning_texts(const std::vector<Warning>& warnings) {
    std::vector<std::string> texts;
    for (const Warning& warning : warnings) {
        texts.push_back(warning.text);
    }
    return texts;
}

bool mentions(const std::vector<std::string>& texts, std::string_view part) {
    return std::any_of(texts.begin(), texts.end(), [part](const std::string& text) {
        return text.find(part) != std::string::npos;
    });
}

std::string repository_file(const std::string& path) {
    return read_file(std::filesystem::path(QUASIMC_SOURCE_DIR) / path);
}

}  // namespace quasimc::test
