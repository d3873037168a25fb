#pragma once

#include <functional>
#include <memory>
#include <string>

#include "coupling/arguments.h"
#include "coupling/byte_stream.h"
#include "coupling/notices.h"

namespace quasimc {

/// Where pipes to the simulator begin and end.
struct Descriptors {
    int in, out;
};

/// The line to the simulator that a command line and an environment file ask for, which must agree.
/// @throws InputError
[[nodiscard]] std::unique_ptr<ByteStream> open_stream(
    const Arguments& arguments, const CommFile& format, const Descriptors& descriptors);

/// The environment process, from reading its files to the order to exit. What is wrong with the
/// files is found before the simulator is told that we are there.
/// @param tell  takes what a person may want to know, line by line
/// @throws InputError, PeerDisconnected
void run_environment(
    const Arguments& arguments,
    const Descriptors& descriptors,
    const std::function<void(const std::string&)>& tell);

}  // namespace quasimc
