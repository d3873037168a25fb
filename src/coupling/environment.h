#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>

#include "coupling/lighting.h"
#include "coupling/protocol/byte_stream.h"
#include "coupling/protocol/notices.h"
#include "coupling/step_light.h"
#include "coupling/vlab/arguments.h"
#include "coupling/vlab/specification.h"

namespace quasimc {

/// Where pipes to the simulator begin and end.
struct Descriptors {
    int in, out;
};

/// The line to the simulator that a command line and an environment file ask for, which must agree.
/// @throws InputError
[[nodiscard]] std::unique_ptr<ByteStream> open_stream(
    const Arguments& arguments, const CommFile& format, const Descriptors& descriptors);

/// How a conversation went that the simulator has ended. Later is worse.
enum class SessionOutcome {
    good,
    faulty,  ///< the input was refused, or some step was answered with nothing for its faults
    failed,  ///< the same for a fault of ours, or for want of memory
};

/// A step that was answered, for who looks on.
struct StepSnapshot {
    std::int64_t step = 0;  ///< as the simulator counts
    const Specification& specification;
    const Lighting& lighting;
    std::shared_ptr<const StepLight> light;  ///< may be kept
};

/// Shows steps while a plant grows. Nothing of the answers depends on it.
class StepViewer {
  public:
    virtual ~StepViewer() = default;
    /// Opens the view if the command line or the specification asks for it. Otherwise nothing else
    /// is called.
    /// @param port  0: any. @throws InputError  if it can't be had
    virtual void open(int port) = 0;
    /// The light of a step will be computed.
    virtual void on_begin(std::int64_t step) = 0;
    virtual void on_step(const StepSnapshot& step) = 0;

  protected:
    StepViewer() = default;
};

/// The environment process, from reading its files to the order to exit. What is wrong with the
/// files is told at once, and the simulator is told that there will be no light or, where the line
/// can't carry that, answered with nothing until it says exit. What is wrong in a step is told, as
/// often as it changes, and the step answered with nothing. SIGTERM, SIGINT and SIGHUP end the
/// process with the status 128 + signal, after an empty answer.
/// @param tell  takes what a person may want to know, line by line; from any thread
/// @param viewer  shows steps if it is asked to; may be null
/// @throws InputError  if there is no line to the simulator
/// @throws PeerDisconnected  when the simulator is gone without having said exit
[[nodiscard]] SessionOutcome run_environment(
    const Arguments& arguments,
    const Descriptors& descriptors,
    const std::function<void(const std::string&)>& send,
    StepViewer* viewer = nullptr);

/// For a command line that can't be understood: a simulator that its switches name is told that
/// there will be no light, or answered with nothing until it says exit. Throws nothing.
/// @param list  without the name of the program
void refuse_simulator(std::span<const char* const> list);

}  // namespace quasimc
