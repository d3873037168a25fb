#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec3.h"
#include "coupling/vlab/comm_file.h"

namespace quasimc {

/// Largest number of parameters of a module; more are a fault of the message.
inline constexpr std::size_t kMaxParameters = 64;
/// Largest number of slots of an answer.
inline constexpr std::size_t kMaxSlots = 20;

/// Position and directions of an organ. Directions need not be of unit length.
struct Turtle {
    Vec3 position, heading, left, up;
};

/// A part of one of the lists of a pass.
struct ListPart {
    std::uint32_t first = 0, count = 0;
};

/// A query of the plant simulator for the light on an organ, or (asks == false) an organ that only
/// shades.
struct Query {
    std::int64_t id = 0;  ///< opaque, returned in the answer
    std::uint32_t slots = 0;
    bool asks = false;
    std::string organ;    ///< name of the module that follows; "" if there is none
    ListPart parameters;  ///< in Pass::parameters; NaN if not set
    ListPart polygons;    ///< in Pass::polygons
    Turtle turtle;
};

/// All queries of the plant simulator in one step.
struct Pass {
    std::vector<Query> queries;
    std::vector<double> parameters;
    std::vector<ListPart> polygons;            ///< in `vertices`
    std::vector<std::uint32_t> polygon_lines;  ///< first line of each in its message, or 0
    std::vector<Vec3> vertices;
    /// Keywords of graphics other than polygons in the queries ("cylinder").
    std::vector<std::string> other_graphics;
    std::int64_t step = 0;  ///< number given by the simulator; lpfg always sends 0

    [[nodiscard]] std::span<const double> parameters_of(const Query& query) const {
        return std::span(parameters).subspan(query.parameters.first, query.parameters.count);
    }
    void clear();
};

/// The "Control" line of a message.
struct Control {
    bool is_last = true;  ///< chunk of the pass
    bool is_exit = false;
    std::int64_t step = 0;
};

/// How the simulator writes numbers: cpfg as %g, lpfg as %f (always six decimals).
enum class NumberStyle { unknown, general, fixed };

/// The style of a number; unknown if both styles give the same text.
[[nodiscard]] NumberStyle style_of(std::string_view number);

/// Reads the messages of one session. The result depends only on the messages so far.
class MessageParser {
  public:
    /// @param format  defines the lines that follow a query
    explicit MessageParser(const CommFile& format) : format_(format) {}

    /// Adds the queries of a message (up to and with its "Control" line) to `pass`.
    /// @throws InputError  if a message violates the protocol: line and content
    [[nodiscard]] Control parse(std::string_view message, Pass& pass);

    /// Style of the numbers read so far.
    [[nodiscard]] NumberStyle style() const { return style_; }

  private:
    class Reader;

    CommFile format_;
    NumberStyle style_ = NumberStyle::unknown;
    bool position_settled_ = false;
};

/// Searches for the end of a message in bytes that arrive in pieces; examines each byte once.
class MessageEndFinder {
  public:
    /// End of the first message in `bytes`, after its "Control" line; npos if that has not arrived.
    /// @param bytes  those of the last call, and later ones
    [[nodiscard]] std::size_t find(std::string_view bytes);
    /// The offset where the next call begins to search.
    [[nodiscard]] std::size_t offset() const { return offset_; }

  private:
    std::size_t offset_ = 0;  // nothing ends before it
    bool in_control_ = false;
};

/// End of the first message in `bytes`; npos without its "Control" line.
[[nodiscard]] std::size_t message_end(std::string_view bytes);

/// Adds the line "id E(v,v,,)" with `slots` values, empty where `values` has none or is NaN. At
/// most 255 characters: the simulators read no more.
void append_answer(
    std::string& text, std::int64_t id, std::size_t slots, std::span<const double> values);

/// "Control: flags".
enum class ChunkPosition { only, first, middle, last };
void append_control(std::string& text, ChunkPosition position);

}  // namespace quasimc
