#pragma once

#include <csignal>

#include "coupling/protocol/byte_stream.h"
#include "master.h"
#include "support/temporary_folder.h"

namespace quasimc::test {

/// Sessions in a temporary folder; writing to an ended program is an error instead of a signal.
class SessionTest : public FolderTest {
  protected:
    void SetUp() override { std::signal(SIGPIPE, SIG_IGN); }
};

/// A horizontal leaf in full sun and one that only shades, below it; queries as cpfg writes them.
inline const std::string kTwoLeaves =
    "0 E(1)P(0.5,2)\n 0 1 0\n 0 0 -1\n -1 0 0\n 0 1 0\n"
    "41 E(-1)P(0.5,2)\n 0 0.5 0\n 0 0 -1\n -1 0 0\n 0 1 0\nControl: 5 0\n";
inline const std::string kExit = "Control: 8 0\n";

/// Black leaves in light from above: what a leaf absorbs is known exactly.
inline const std::string kBlackLeaves =
    "number of rays: 64\nmethod: light_tracing\nreturn type: D\nleaf material (top): 0 0 0 0\n"
    "verbose: 0\n";

}  // namespace quasimc::test
