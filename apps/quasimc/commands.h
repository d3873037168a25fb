#pragma once

#include "command_line.h"

// The commands of the program, one file each.
[[nodiscard]] Command run_command();
[[nodiscard]] Command merge_command();
[[nodiscard]] Command check_command();
[[nodiscard]] Command convert_command();
[[nodiscard]] Command gaps_command();
[[nodiscard]] Command grow_command();
[[nodiscard]] Command info_command();
[[nodiscard]] Command list_command();
[[nodiscard]] Command report_command();
[[nodiscard]] Command show_command();
[[nodiscard]] Command sky_command();
[[nodiscard]] Command view_command();
