#include "coupling/vlab/arguments.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "coupling/vlab/directive.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// The arguments that are not read yet.
class ArgumentReader {
  public:
    explicit ArgumentReader(std::span<const char* const> words) : words_(words) {}

    [[nodiscard]] bool empty() const { return words_.empty(); }
    std::string_view take() {
        const std::string_view word = words_.front();
        words_ = words_.subspan(1);
        return word;
    }
    /// The value of a switch.
    std::string_view value_of(std::string_view name) {
        if (words_.empty()) {
            throw UsageError(fmt::format("{} needs a value", name));
        }
        return take();
    }

  private:
    std::span<const char* const> words_;
};

void read_key(ArgumentReader& words, Arguments& arguments) {
    const std::string_view word = words.value_of("-k");
    const auto key = parse_integer(word);
    if (!key) {
        throw UsageError(fmt::format("-k {}: it must be a whole number", word));
    }
    if (*key == 0) {
        // Semaphores of key 0 (IPC_PRIVATE) are those of one process alone; 0 is no port either.
        throw UsageError("-k 0: the simulator can't be found with this key; start it again");
    }
    arguments.key = static_cast<long>(*key);
}

void read_kind(ArgumentReader& words, Arguments& arguments) {
    constexpr std::array<std::string_view, 3> kNames{"automatic", "quasimc", "montecarlo"};
    const std::string_view word = words.value_of("--spec");
    const auto* found = std::find(kNames.begin(), kNames.end(), word);
    if (found == kNames.end()) {
        throw UsageError(fmt::format("--spec {}: {}", word, did_you_mean(word, kNames)));
    }
    arguments.kind = static_cast<SpecificationKind>(found - kNames.begin());
}

void refuse_distribution(ArgumentReader& /*words*/, Arguments& /*arguments*/) {
    throw UsageError("-C: programs distributed over several computers are not supported");
}

/// One row of the table of switches.
struct Switch {
    std::string_view name;
    void (*read)(ArgumentReader& words, Arguments& arguments);
};

constexpr std::array kSwitches{
    Switch{"-e", [](ArgumentReader& w, Arguments& a) { a.comm_file = w.value_of("-e"); }},
    Switch{"-k", read_key},
    Switch{"-ext", [](ArgumentReader& w, Arguments& a) { a.extension = w.value_of("-ext"); }},
    Switch{"-host", [](ArgumentReader& w, Arguments& a) { a.host = w.value_of("-host"); }},
    Switch{"-C", refuse_distribution},
    Switch{"--spec", read_kind},
    Switch{"-no_xserver", [](ArgumentReader&, Arguments&) {}},  // there is no window
    Switch{"--view", [](ArgumentReader&, Arguments& a) { a.view = true; }},
    Switch{"-debug", [](ArgumentReader&, Arguments& a) { a.debug = true; }},
    Switch{"--help", [](ArgumentReader&, Arguments& a) { a.wants_help = true; }},
    Switch{"--version", [](ArgumentReader&, Arguments& a) { a.wants_version = true; }},
};

/// The row of a word; the original takes every word that begins with -h for -host.
const Switch* find_switch(std::string_view word) {
    const std::string_view name = word.starts_with("-h") ? "-host" : word;
    const auto* found = std::find_if(
        kSwitches.begin(), kSwitches.end(), [&](const Switch& s) { return s.name == name; });
    return found == kSwitches.end() ? nullptr : found;
}

[[noreturn]] void unknown_switch(std::string_view word) {
    std::vector<std::string_view> names;
    names.reserve(kSwitches.size());
    for (const Switch& s : kSwitches) {
        names.push_back(s.name);
    }
    throw UsageError(fmt::format("{} is not a switch; {}", word, did_you_mean(word, names)));
}

}  // namespace

SpecificationKind kind_of_program(std::string_view path) {
    // npos + 1 is 0: the whole path.
    const std::string name = lower_case(path.substr(path.find_last_of('/') + 1));
    return name == "montecarlo" ? SpecificationKind::montecarlo : SpecificationKind::automatic;
}

Arguments parse_arguments(std::span<const char* const> list, SpecificationKind kind) {
    Arguments arguments;
    arguments.kind = kind;
    ArgumentReader words(list);
    while (!words.empty()) {
        const std::string_view word = words.take();
        if (word.starts_with('-') && word.size() > 1) {
            const Switch* found = find_switch(word);
            found != nullptr ? found->read(words, arguments) : unknown_switch(word);
        } else if (arguments.specification.empty()) {
            arguments.specification = word;
        } else {
            throw UsageError(fmt::format(
                "{}: a specification file is given already, {}", word, arguments.specification));
        }
    }
    return arguments;
}

std::string usage_text() {
    return R"(QuasiMC [-e comm.e] [-k KEY -ext EXT | -k KEY -host HOST] [--spec KIND] specification_file
        [--view] [-no_xserver | -debug]

The environment process of cpfg and lpfg: computes the light on the organs of a plant at every step.
The plant simulators start it by the line "executable:" of their environment file (.e), and add -e,
-k, -ext or -host. Without -k, standard input and output are the line to the simulator.

  --spec KIND    what the specification file was written for: quasimc, montecarlo, or automatic
                 (the default: montecarlo if it has directives that only MonteCarlo knows;
                 always montecarlo if the program is called by the name MonteCarlo)
  --view         shows every step in a browser of this machine, as 'view: yes' in the specification
  -no_xserver    accepted; no display is needed
  -debug         reports every step on stderr
  --version      prints the version
  --help         prints this

Exit status: 0 done, 1 the input has faults or the simulator is gone, 2 wrong usage,
3 internal error, 128 + a signal (SIGTERM, SIGINT, SIGHUP).
)";
}

}  // namespace quasimc
