// Environment file and messages, separated by a zero byte: read, answered in chunks.

#include <algorithm>
#include <cstddef>
#include <string_view>

#include "coupling/protocol/session.h"
#include "coupling/protocol/trailing_values.h"
#include "coupling/vlab/organ_shapes.h"
#include "readers.h"

namespace quasimc::fuzz {
namespace {

void converse(std::string_view file, std::string_view bytes) {
    Notices silent([](const std::string&) {});
    MessageParser parser(read_comm_text(file, "comm.e", silent));
    TrailingValues trailing;
    const Specification spec;
    OrganShapes shapes(spec, silent);
    Pass pass;
    for (std::size_t end = message_end(bytes); end != std::string_view::npos;
         end = message_end(bytes)) {
        pass.clear();
        static_cast<void>(parser.parse(bytes.substr(0, end), pass));
        bytes.remove_prefix(end);
        trailing.remove(pass, parser.style());
        Answers answers;
        for (std::uint32_t i = 0; i < pass.queries.size(); ++i) {
            static_cast<void>(shapes.make(pass, pass.queries[i]));
            static_cast<void>(shapes.make_sensor(pass, pass.queries[i]));
            answers.values.push_back(pass.queries[i].turtle.position.x);
            answers.list.push_back({i, {i, 1}});
        }
        static_cast<void>(reply_chunks(pass, answers, 3, 1000));
    }
    static_cast<void>(parser.parse(bytes, pass));  // it breaks off
}

}  // namespace

void fuzz_protocol(const std::string& bytes) {
    const std::size_t zero = std::min(bytes.find('\0'), bytes.size());
    const std::string_view all(bytes);
    try {
        converse(all.substr(0, zero), all.substr(std::min(zero + 1, bytes.size())));
    } catch (const InputError&) {
        return;
    }
}

}  // namespace quasimc::fuzz
