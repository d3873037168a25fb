#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace quasimc::fuzz {

/// Something that reads bytes from outside. It may refuse them, but never crash.
struct FuzzedReader {
    std::string name;  ///< of its corpus
    std::function<void(const std::string& bytes)> read;
};

/// All of them: the table in readers.cpp, and each format of geometry.
[[nodiscard]] std::vector<FuzzedReader> fuzzed_readers();

/// @throws std::invalid_argument  if there is none of that name
[[nodiscard]] FuzzedReader find_reader(std::string_view name);

void fuzz_ies(const std::string& bytes);
void fuzz_model(const std::string& bytes);
void fuzz_protocol(const std::string& bytes);
void fuzz_result(const std::string& bytes);
void fuzz_run_file(const std::string& bytes);
void fuzz_sky_table(const std::string& bytes);
void fuzz_specification(const std::string& bytes);
void fuzz_weather(const std::string& bytes);
void fuzz_window_request(const std::string& bytes);

}  // namespace quasimc::fuzz
