#include "coupling/environment.h"

#include <fmt/format.h>

#include "coupling/plant_light.h"
#include "coupling/session.h"
#include "solvers/catalogue.h"

namespace quasimc {
namespace {

[[noreturn]] void disagree(const Arguments& arguments, std::string problem, std::string why) {
    throw InputError(
        {{arguments.comm_file.value_or("command line"), std::move(problem), std::move(why),
          "the simulator adds the switches: it and we must read the same environment file (-e)"}});
}

CommFile read_comm_file(const Arguments& arguments, Notices& notices) {
    if (!arguments.comm_file) {
        throw InputError(
            {{"command line", "the environment file is missing", "it says what the simulator sends",
              "add '-e FILE.e' to the line executable:"}});
    }
    CommFile format =
        read_comm_text(read_file(*arguments.comm_file), *arguments.comm_file, notices);
    Faults faults;
    for (const auto& [field, name] :
         {std::pair{TurtleField::heading, "turtle heading"}, {TurtleField::up, "turtle up"}}) {
        if (!format.line(field).is_sent) {
            faults.add(
                {*arguments.comm_file, fmt::format("'{}' is missing", name),
                 "organs stand in the frame of the turtle",
                 fmt::format("add '{}: %f %f %f'", name)});
        }
    }
    if (!format.following_module) {
        notices.once(
            *arguments.comm_file +
            ": without 'following module' only organs drawn as polygons are seen");
    }
    faults.throw_if_any();
    return format;
}

/// Tells what a step was like.
void tell_step(
    const PlantLight& light,
    const Pass& pass,
    const std::function<void(const std::string&)>& tell) {
    std::string text = fmt::format("step {}: {} queries", pass.step, pass.queries.size());
    for (const Result& result : light.last().results) {
        if (result.values.empty()) {
            continue;  // a band without light
        }
        text += fmt::format(
            ", {} rays in {:.3f} s by {} ({})", result.rays,
            result.build_seconds + result.trace_seconds, find_solver(result.chosen.method)->name,
            result.chosen.reason);
    }
    tell(text);
}

}  // namespace

std::unique_ptr<ByteStream> open_stream(
    const Arguments& arguments, const CommFile& format, const Descriptors& descriptors) {
    const bool has_key = arguments.key.has_value();
    if (arguments.host) {
        if (!has_key) {
            disagree(arguments, "-host without -k", "-k is the first port");
        }
        return make_socket_stream(*arguments.host, static_cast<int>(*arguments.key));
    }
    if (!has_key) {
        if (format.transport != Transport::pipes) {
            disagree(
                arguments, "no -k on the command line",
                "files, memory and sockets need the key of the simulator");
        }
        return make_pipe_stream(descriptors.in, descriptors.out);
    }
    // lpfg always uses files, whatever its environment file says; cpfg adds no -k for pipes.
    return format.transport == Transport::memory
               ? make_memory_stream(*arguments.key)
               : make_file_stream(*arguments.key, arguments.extension);
}

void run_environment(
    const Arguments& arguments,
    const Descriptors& descriptors,
    const std::function<void(const std::string&)>& tell) {
    Notices notices(tell);
    const CommFile format = read_comm_file(arguments, notices);
    PlantLight light(read_specification(arguments.specification, arguments.kind, notices), notices);
    const std::unique_ptr<ByteStream> stream = open_stream(arguments, format, descriptors);
    constexpr int kTalkative = 2;
    const bool tells_steps = arguments.debug || light.specification().verbose >= kTalkative;
    serve(
        *stream, format,
        [&](const Pass& pass, const std::function<void()>& check, Answers& answers) {
            light.answer(pass, check, answers);
            if (tells_steps) {
                tell_step(light, pass, tell);
            }
        });
}

}  // namespace quasimc
