#include "text/document.h"
#include "text/json_builder.h"

namespace quasimc {

Node read_json(std::string_view text, const std::string& file) {
    JsonNodeBuilder builder(file);
    static_cast<void>(nlohmann::ordered_json::sax_parse(text, &builder));
    return std::move(builder.result);
}

}  // namespace quasimc
