#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "base/notices.h"
#include "coupling/lighting.h"
#include "coupling/protocol/byte_stream.h"
#include "coupling/step_light.h"
#include "coupling/vlab/arguments.h"
#include "coupling/vlab/specification.h"

namespace quasimc {

/// File descriptors of the pipes from and to the simulator.
struct Descriptors {
    int in, out;
};

/// Opens the connection that the command line and the environment file describe; they must agree.
/// @throws InputError
[[nodiscard]] std::unique_ptr<ByteStream> open_stream(
    const Arguments& arguments, const CommFile& format, const Descriptors& descriptors);

/// Outcome of a session that the simulator has ended. Later is worse.
enum class SessionOutcome {
    good,
    rejected,  ///< the input was refused, or a step had faults and an empty answer
    failed,    ///< an internal error, or lack of memory
};

/// A step that was answered, for a viewer.
struct StepSnapshot {
    std::int64_t step = 0;  ///< number given by the simulator
    const Specification& specification;
    const Lighting& lighting;
    std::shared_ptr<const StepLight> light;  ///< may be kept
};

/// Shows steps while a plant grows. Answers do not depend on it.
class StepViewer {
  public:
    virtual ~StepViewer() = default;
    /// Opens the view if the command line or the specification requests it; otherwise no other
    /// function is called.
    /// @param port  0: any. @throws InputError  if the port can't be opened
    virtual void open(int port) = 0;
    /// Called before the light of a step is computed.
    virtual void on_begin(std::int64_t step) = 0;
    virtual void on_step(const StepSnapshot& step) = 0;

  protected:
    StepViewer() = default;
};

/// Runs the environment process, from reading its files to the order to exit. Faults of the files
/// are reported at once; the simulator receives a refusal or, where the connection has none, empty
/// answers until it sends exit. Faults of a step are reported whenever they change, and the answer
/// is empty. SIGTERM, SIGINT and SIGHUP end the process with the status 128 + signal, after an
/// empty answer.
/// @param send  receives messages for the user, line by line; called from any thread
/// @param viewer  shows steps; may be null
/// @throws InputError  if there is no connection to the simulator
/// @throws PeerDisconnected  if the simulator ends without the order to exit
[[nodiscard]] SessionOutcome run_environment(
    const Arguments& arguments,
    const Descriptors& descriptors,
    const std::function<void(const std::string&)>& send,
    StepViewer* viewer = nullptr);

/// Refuses the simulator that the switches of an invalid command line name: it receives a refusal,
/// or empty answers until it sends exit. Throws nothing.
/// @param list  without the name of the program
void refuse_simulator(std::span<const char* const> list);

}  // namespace quasimc
