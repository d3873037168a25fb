#pragma once

#include "command_line.h"

/// The command that prints a script by which a shell completes commands, flags and their values.
/// @param program  complete when the command runs
[[nodiscard]] Command completion_command(const Program& program);
