#include "coupling_testing.h"

#include <algorithm>

#include <fmt/format.h>

namespace quasimc::test {

bool RecordedNotices::has(const std::string& word) const {
    return std::any_of(texts.begin(), texts.end(), [&](const std::string& text) {
        return text.find(word) != std::string::npos;
    });
}

CommFile usual_format() {
    RecordedNotices kept;
    return read_comm_text(
        "turtle position: %f %f %f\nturtle heading: %f %f %f\nturtle left: %f %f %f\n"
        "turtle up: %f %f %f\nfollowing module: yes\n",
        "comm.e", kept.notices);
}

Specification specification(
    const std::string& text,
    RecordedNotices& kept,
    const std::map<std::string, std::string>& files,
    SpecificationKind kind) {
    InputFiles input("/", [&](const std::filesystem::path& path) {
        const auto found = files.find(path.filename().string());
        if (found == files.end()) {
            throw InputError({{path.string(), "can't be read", "", ""}});
        }
        return found->second;
    });
    return read_specification_text(text, "light.qmc", kind, input, kept.notices);
}

std::string faults_of(const std::string& text, const std::map<std::string, std::string>& files) {
    RecordedNotices kept;
    try {
        static_cast<void>(specification(text, kept, files));
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

std::string flat(int id, const std::string& module, double height, const std::string& question) {
    return fmt::format(
        "{} {}{}\n 0 {} 0\n 0 0 -1\n -1 0 0\n 0 1 0\n", id, question, module, height);
}

Pass pass_of(const std::string& queries) {
    MessageParser parser(usual_format());
    Pass pass;
    static_cast<void>(parser.parse(queries + "Control: 5 0\n", pass));
    return pass;
}

std::map<std::int64_t, std::vector<double>> answers_of(
    PlantLight& light, const std::string& queries) {
    const Pass pass = pass_of(queries);
    Answers answers;
    light.answer(
        pass, [] {}, answers);
    std::map<std::int64_t, std::vector<double>> by_id;
    for (const Answer& answer : answers.list) {
        const auto first = answers.values.begin() + answer.values.first;
        by_id[pass.queries[answer.query].id] = {first, first + answer.values.count};
    }
    return by_id;
}

std::string square_surface() {
    std::string text =
        "-0.5 0.5 0 1 0 0\nPRECISION S: 5 T: 5\nCONTACT POINT X: 0 Y: 0 Z: 0\n"
        "END POINT X: 0 Y: 1 Z: 0\nHEADING X: 0 Y: 1 Z: 0\nUP X: 0 Y: 0 Z: 1\nSIZE: 1\nleaf\n"
        "TOP COLOR: 1 DIFFUSE: 0.5 BOTTOM COLOR: 2 DIFFUSE: 0.5\nAL: ~ A: ~ AR: ~\nL: ~ R: ~\n"
        "BL: ~ B: ~ BR: ~\n";
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) {
            text += fmt::format("{} {} 0 ", -0.5 + j / 3.0, i / 3.0);
        }
        text += "\n";
    }
    return text;
}

}  // namespace quasimc::test
