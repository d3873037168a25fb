#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "coupling/plants/number_line.h"
#include "coupling/protocol/messages.h"
#include "growth/environment.h"

namespace quasimc {

/// Writes queries as an environment file describes them.
class QueryWriter {
  public:
    /// @throws InputError  for invalid formats of turtle lines
    explicit QueryWriter(const CommFile& format);

    /// Appends the lines of a query, without graphics.
    void append(std::string& text, const PlantQuery& query) const;

  private:
    bool following_module_;
    std::array<NumberLine, kTurtleFields> turtle_;
};

/// Reads a line "id E(v,v,,)" of a reply.
/// @param program  the environment program, for messages
/// @throws InputError  if it is no answer
[[nodiscard]] PlantAnswer read_answer(std::string_view line, const std::string& program);

/// Whether a line "Control: flags" ends a reply; otherwise the next chunk follows.
[[nodiscard]] bool ends_reply(std::string_view control);

/// "Control: flags step" of the simulator.
void append_master_control(std::string& text, ChunkPosition position, std::int64_t step);

}  // namespace quasimc
