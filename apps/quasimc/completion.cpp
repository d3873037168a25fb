// Completion of command lines, from the tables of flags.

#include "completion.h"

#include <algorithm>
#include <cstdio>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace {

/// The valid words for a flag or an argument; empty: any.
std::vector<std::string> values_of(const Flag& flag) {
    constexpr std::string_view kOneOf = "one of ";
    if (!flag.choices.empty() || !flag.takes.starts_with(kOneOf)) {
        return flag.choices;
    }
    std::vector<std::string> values;
    for (std::string_view rest = std::string_view(flag.takes).substr(kOneOf.size());
         !rest.empty();) {
        const std::size_t end = std::min(rest.find(", "), rest.size());
        values.emplace_back(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 2, rest.size()));
    }
    return values;
}

bool takes_value(const Flag& flag) {
    return !is_argument(flag) && !std::holds_alternative<bool*>(flag.target);
}

/// A case of bash for each flag that has choices, and one for the other words of a command.
std::string bash_cases(const Command& command) {
    std::string cases;
    std::vector<std::string_view> names{"--help"};
    std::vector<std::string> words;
    for (const Flag& flag : command.flags) {
        if (is_argument(flag)) {
            words = values_of(flag);
            continue;
        }
        const auto own = names_of(flag);
        names.insert(names.end(), own.begin(), own.end());
        if (!values_of(flag).empty()) {
            cases += fmt::format(
                "    \"{0} {1}\") words=\"{2}\" ;;\n", command.name,
                fmt::join(own, fmt::format("\" | \"{} ", command.name)),
                fmt::join(values_of(flag), " "));
        }
    }
    return cases +
           fmt::format(
               "    \"{} \"*) case $word in -*) words=\"{}\" ;; *) words=\"{}\" ;; esac ;;\n",
               command.name, fmt::join(names, " "), fmt::join(words, " "));
}

std::string bash_script(const Program& program) {
    std::string cases;
    std::vector<std::string_view> names;
    for (const Command& command : program.commands) {
        names.push_back(command.name);
        cases += bash_cases(command);
    }
    return fmt::format(
        R"(_quasimc() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} words=
    if [ "$COMP_CWORD" = 1 ]; then
        words="{} --help --version --dump-default"
    else
        case "${{COMP_WORDS[1]}} ${{COMP_WORDS[COMP_CWORD-1]}}" in
{}        esac
    fi
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _quasimc quasimc
)",
        fmt::join(names, " "), cases);
}

std::string in_quotes(std::string_view text) {
    std::string quoted = "'";
    for (const char c : text) {
        quoted += c == '\'' || c == '\\' ? fmt::format("\\{}", c) : std::string(1, c);
    }
    return quoted + "'";
}

std::string fish_script(const Program& program) {
    std::string lines;
    for (const Command& command : program.commands) {
        lines += fmt::format(
            "complete -c quasimc -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
            in_quotes(command.summary));
        for (const Flag& flag : command.flags) {
            std::string line = fmt::format(
                "complete -c quasimc -n '__fish_seen_subcommand_from {}'", command.name);
            for (const std::string_view name :
                 is_argument(flag) ? std::vector<std::string_view>() : names_of(flag)) {
                line += name.starts_with("--") ? fmt::format(" -l {}", name.substr(2))
                                               : fmt::format(" -s {}", name.substr(1));
            }
            const std::vector<std::string> values = values_of(flag);
            line += takes_value(flag) ? " -r" : "";
            line += values.empty() ? "" : fmt::format(" -f -a '{}'", fmt::join(values, " "));
            const bool is_listed = !is_argument(flag) || !values.empty();
            lines += is_listed ? line + fmt::format(" -d {}\n", in_quotes(flag.summary)) : "";
        }
    }
    return lines;
}

}  // namespace

Command completion_command(const Program& program) {
    const auto shell = std::make_shared<std::string>();
    return {
        "completion",
        "print a script by which a shell completes command lines",
        {{.name = "SHELL",
          .target = shell.get(),
          .summary = "bash: source <(quasimc completion bash); zsh alike; fish: quasimc completion "
                     "fish | source",
          .required = true,
          .choices = {"bash", "zsh", "fish"}}},
        [shell, &program] {
            const std::string script =
                *shell == "fish" ? fish_script(program)
                : *shell == "zsh"
                    ? "autoload -U +X bashcompinit && bashcompinit\n" + bash_script(program)
                    : bash_script(program);
            std::fputs(script.c_str(), stdout);
            return Exit::done;
        }};
}
