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

/// A module sends no more parameters than this; more are a fault of the message.
inline constexpr std::size_t kMaxParameters = 64;
/// Answers have no more slots.
inline constexpr std::size_t kMaxSlots = 20;

/// Where and how an organ stands. Directions need not be of unit length.
struct Turtle {
    Vec3 position, heading, left, up;
};

/// A part of one of the lists of a pass.
struct ListPart {
    std::uint32_t first = 0, count = 0;
};

/// A question of the plant simulator: the light on an organ, or (asks == false) an organ that only
/// shades.
struct Query {
    std::int64_t id = 0;  ///< opaque, given back in the answer
    std::uint32_t slots = 0;
    bool asks = false;
    std::string organ;    ///< name of the module that follows; "" if there is none
    ListPart parameters;  ///< of Pass::parameters; one that is not set is NaN
    ListPart polygons;    ///< of Pass::polygons
    Turtle turtle;
};

/// All that the plant simulator asks in one step.
struct Pass {
    std::vector<Query> queries;
    std::vector<double> parameters;
    std::vector<ListPart> polygons;            ///< of vertices
    std::vector<std::uint32_t> polygon_lines;  ///< of their messages, where each begins
    std::vector<Vec3> vertices;
    /// Words of graphics other than polygons that came with the queries ("cylinder").
    std::vector<std::string> other_graphics;
    std::int64_t step = 0;  ///< as the simulator counts; lpfg says 0 always

    [[nodiscard]] std::span<const double> parameters_of(const Query& query) const {
        return std::span(parameters).subspan(query.parameters.first, query.parameters.count);
    }
    void clear();
};

/// What ends a message.
struct Control {
    bool is_last = true;  ///< chunk of the pass
    bool is_exit = false;
    std::int64_t step = 0;
};

/// How the simulator writes numbers: cpfg as %g, lpfg as %f (always six decimals).
enum class NumberStyle { unknown, general, fixed };

/// The style that a number betrays; unknown when either could have written it.
[[nodiscard]] NumberStyle style_of(std::string_view number);

/// Reads the messages of one conversation. A pure function of what it was given so far.
class MessageParser {
  public:
    /// @param format  which lines follow a query
    explicit MessageParser(const CommFile& format) : format_(format) {}

    /// Adds the queries of a message (up to and with its "Control" line) to `pass`.
    /// @throws InputError  where a message is not what the protocol says: line and content
    [[nodiscard]] Control parse(std::string_view message, Pass& pass);

    /// Of the numbers read so far.
    [[nodiscard]] NumberStyle style() const { return style_; }

  private:
    class Reader;

    CommFile format_;
    NumberStyle style_ = NumberStyle::unknown;
    bool position_settled_ = false;
};

/// Looks for the end of a message in bytes that come piece by piece; looks at each once, however
/// long the lines are.
class MessageEndFinder {
  public:
    /// Where the first message in `bytes` ends: after its "Control" line; npos if that is not there
    /// yet. @param bytes  those of the call before, and what came since
    [[nodiscard]] std::size_t find(std::string_view bytes);
    /// The offset where the next call begins to search.
    [[nodiscard]] std::size_t offset() const { return offset_; }

  private:
    std::size_t offset_ = 0;  // nothing ends before it
    bool in_control_ = false;
};

/// Where the first message in `bytes` ends; npos if its "Control" line is not there.
[[nodiscard]] std::size_t message_end(std::string_view bytes);

/// Adds the line "id E(v,v,,)" with `slots` values, empty where `values` has none or is NaN. At
/// most 255 characters: the simulators read no more.
void append_answer(
    std::string& text, std::int64_t id, std::size_t slots, std::span<const double> values);

/// "Control: flags".
enum class ChunkPosition { only, first, middle, last };
void append_control(std::string& text, ChunkPosition position);

}  // namespace quasimc
