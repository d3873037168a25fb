#include "captures.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace quasimc::test {
namespace {

std::vector<std::string> lines_of(const std::string& name) {
    std::ifstream file(QUASIMC_SOURCE_DIR "/tests/protocol/captures/" + name);
    if (!file) {
        throw std::runtime_error("no capture " + name);
    }
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        lines.push_back(line == "\x01" ? "" : line[0] == '\x01' ? line.substr(1) : line);
    }
    return lines;
}

/// Lines joined to messages, each of which ends with its Control line.
std::vector<std::string> messages_in(const std::vector<std::string>& lines) {
    std::vector<std::string> messages;
    std::string message;
    for (const std::string& line : lines) {
        message += line.empty() ? "" : line + "\n";
        if (line.starts_with("Control")) {
            messages.push_back(message);
            message.clear();
        }
    }
    return messages;
}

}  // namespace

Capture read_pipe_capture(const std::string& to, const std::string& from) {
    return {messages_in(lines_of(to)), messages_in(lines_of(from))};
}

Capture read_file_capture(const std::string& name) {
    Capture capture;
    std::string* current = nullptr;
    for (const std::string& line : lines_of(name)) {
        const bool to = line.find("write .to_field") != std::string::npos;
        const bool from = line.find("write .from_field") != std::string::npos;
        if (line.starts_with("==")) {
            current = to     ? &capture.messages.emplace_back()
                      : from ? &capture.replies.emplace_back()
                             : nullptr;
        } else if (current != nullptr) {
            *current += line + "\n";
        }
    }
    return capture;
}

std::string structure_of(const std::string& reply) {
    std::string structure;
    bool inside = false, in_value = false;
    for (const char c : reply) {
        if (c == '(' || c == ')' || c == ',') {
            inside = c != ')';
            in_value = false;
            structure += c;
        } else if (!inside) {
            structure += c;
        } else if (!in_value) {
            in_value = true;
            structure += '#';
        }
    }
    return structure;
}

std::string without_controls(const std::string& reply) {
    std::istringstream lines(reply);
    std::string kept;
    for (std::string line; std::getline(lines, line);) {
        kept += line.starts_with("Control") ? "" : line + "\n";
    }
    return kept;
}

std::map<long, double> values_of(const std::string& reply) {
    std::istringstream lines(without_controls(reply));
    std::map<long, double> values;
    for (std::string line; std::getline(lines, line);) {
        values[std::stol(line)] = std::stod(line.substr(line.find('(') + 1));
    }
    return values;
}

}  // namespace quasimc::test
