#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/notices.h"
#include "quasimc/error.h"

namespace quasimc {

/// Channel of messages between the plant simulator and this process.
enum class Transport { pipes, files, memory, sockets };

/// Format of a line about the turtle that follows a query.
struct TurtleLine {
    bool is_sent = false;
    std::size_t skip = 0;     ///< characters before the first number, without blanks
    std::size_t values = 0;   ///< numbers on the line, up to 3
    std::string format = {};  ///< as for printf, with all blanks
    std::string where = {};   ///< its line of the file
};

/// Modules that are sent with their shapes.
struct InterpretedModules {
    std::string name;                       ///< empty: all
    std::optional<std::size_t> parameters;  ///< empty: any number
};

/// The lines that may follow a query, in this order.
enum class TurtleField { position, heading, left, up, line_width, scale_factor };
inline constexpr std::size_t kTurtleFields = 6;

/// Content of an environment file (.e), which both processes read.
struct CommFile {
    Transport transport = Transport::pipes;
    /// Queries or answers in a chunk; empty: the transport's default.
    std::optional<std::size_t> chunk;
    std::array<TurtleLine, kTurtleFields> turtle{};
    /// Whether a query names the module that follows it.
    bool following_module = true;
    /// Whether modules are interpreted: organs come as polygons in space, which need no turtle.
    bool interprets_modules = false;
    std::vector<InterpretedModules> interpreted;
    bool verbose = false;
    std::string executable;   ///< command line of the environment program
    std::string remote_host;  ///< empty: this computer

    [[nodiscard]] const TurtleLine& line(TurtleField field) const {
        return turtle[static_cast<std::size_t>(field)];
    }
    /// Whether the shapes of a module are sent.
    [[nodiscard]] bool interprets(std::string_view module, std::size_t parameters) const;
};

/// Reads the text of an environment file as both simulators do: names are matched exactly, unknown
/// names are skipped (with a notice). Faults: a transport that does not exist, chunks of no size,
/// binary data.
/// @param name  of the file, for messages
[[nodiscard]] CommFile read_comm_text(
    std::string_view text, const std::string& name, Notices& notices);

}  // namespace quasimc
