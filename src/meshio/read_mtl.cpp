#include <algorithm>
#include <array>
#include <set>

#include <fmt/format.h>

#include "meshio/formats.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Reads the statements of a library, one material after the other.
class MtlReader {
  public:
    MtlReader(FormatContext& context, MeshFile& file) : context_(context), file_(file) {
        for (const MeshMaterial& material : file.materials) {
            known_.insert(material.name);
        }
    }

    void read(std::string_view bytes) {
        LineScanner scanner(bytes);
        while (scanner.next() && !context_.reporter.is_full()) {
            line_ = scanner.number();
            std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
            const std::string_view word = take_word(line);
            if (word == "newmtl") {
                finish();
                material_ = MeshMaterial{rest_of_line(line), 0};
                material_->has_optics = false;
            } else if (material_) {
                read_statement(word, line);
            }
        }
        finish();
    }

  private:
    void read_statement(std::string_view word, std::string_view line) {
        if (word == "Kd") {
            read_color(line);
        } else if (word == "map_d" || (word == "map_Kd" && may_have_alpha(trimmed(line)))) {
            if (mask_ != "map_d") {
                mask_ = word;
            }
        } else if (word == "d") {
            const std::string_view first = take_word(line);
            note_opacity(word, first == "-halo" ? take_word(line) : first, 1);
        } else if (word == "Tr" && transparent_.empty()) {
            note_opacity(word, take_word(line), 0);
        }
    }

    /// Red, green and blue; red alone is all three. Spectral curves and CIE XYZ are not read.
    void read_color(std::string_view line) {
        constexpr std::array<std::string_view, 2> kUnread{"spectral", "xyz"};
        std::string_view text = take_word(line);
        if (std::find(kUnread.begin(), kUnread.end(), text) != kUnread.end()) {
            return;
        }
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            if (const std::string_view word = i > 0 ? take_word(line) : text; !word.empty()) {
                text = word;
            }
            const std::optional<double> number = parse_real(text);
            if (!number || !(*number >= 0 && *number <= 1)) {
                context_.reporter.fault(
                    line_, "Kd " + shown(text) + " is not a number from 0 to 1", "");
                break;
            }
            sum += *number;
        }
        material_->reflectance = sum / 3;
        material_->has_optics = true;
    }

    /// Records the statement of a transparent material. @param opaque  number of an opaque one
    void note_opacity(std::string_view word, std::string_view text, double opaque) {
        const std::optional<double> number = parse_real(text);
        is_opaque_by_d_ = is_opaque_by_d_ || (word == "d" && number == opaque);
        transparent_ = number && *number != opaque ? fmt::format("{} {}", word, *number) : "";
    }

    /// Adds the material, unless an earlier one has its name, as with several libraries.
    void finish() {
        if (material_ && !own_.insert(material_->name).second) {
            context_.reporter.warn(fmt::format(
                "material {} is given twice; the first is used", shown(material_->name)));
        }
        if (material_ && known_.insert(material_->name).second) {
            if (!mask_.empty()) {
                file_.masks.emplace(material_->name, mask_);
            }
            if (!transparent_.empty() && !is_opaque_by_d_) {
                file_.transparent.emplace(material_->name, transparent_);
            }
            file_.materials.push_back(std::move(*material_));
        }
        material_.reset();
        mask_.clear();
        transparent_.clear();
        is_opaque_by_d_ = false;
    }

    FormatContext& context_;
    MeshFile& file_;
    std::set<std::string> known_, own_;  // names in all libraries of the file, and in this one
    std::optional<MeshMaterial> material_;
    std::string mask_, transparent_;  // of the material
    bool is_opaque_by_d_ = false;     // some programs write Tr 1 beside d 1
    std::uint32_t line_ = 0;
};

}  // namespace

void read_mtl(std::string_view bytes, FormatContext& context, MeshFile& file) {
    MtlReader(context, file).read(bytes);
}

}  // namespace quasimc
