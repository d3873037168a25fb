#include "coupling/environment.h"

#include <algorithm>
#include <csignal>
#include <exception>
#include <optional>

#include <unistd.h>

#include <fmt/format.h>

#include "base/notices.h"
#include "base/number_text.h"
#include "coupling/plant_light.h"
#include "coupling/protocol/guarded_stream.h"
#include "coupling/protocol/session.h"
#include "coupling/protocol/stop_signals.h"
#include "coupling/step_error_log.h"
#include "files/file_identity.h"
#include "solvers/catalogue.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

[[noreturn]] void disagree(const Arguments& arguments, std::string problem, std::string why) {
    throw InputError(
        {{arguments.comm_file.value_or("command line"), std::move(problem), std::move(why),
          "the plant simulator and this program must read the same environment file (-e)"}});
}

CommFile read_comm_file(const Arguments& arguments, Notices& notices) {
    if (!arguments.comm_file) {
        throw InputError(
            {{"command line", "the environment file is missing",
              "it describes what the simulator sends", "add '-e FILE.e' to the line executable:"}});
    }
    CommFile format =
        read_comm_text(read_file(*arguments.comm_file), *arguments.comm_file, notices);
    Faults faults;
    for (const auto& [field, name] :
         {std::pair{TurtleField::heading, "turtle heading"}, {TurtleField::up, "turtle up"}}) {
        if (!format.line(field).is_sent && !format.interprets_modules) {
            faults.add(
                {*arguments.comm_file, fmt::format("'{}' is missing", name),
                 "organs are placed in the frame of the turtle",
                 fmt::format(
                     "add '{}: %f %f %f', or 'interpreted modules: all' if all organs are polygons",
                     name)});
        }
    }
    if (!format.following_module && !format.interprets_modules) {
        notices.once(
            *arguments.comm_file +
            ": without 'following module' only organs drawn as polygons are read");
    }
    faults.throw_if_any();
    return format;
}

/// Reports the number of queries, rays and seconds of a step.
void report_step(
    const PlantLight& light,
    const Pass& pass,
    const std::function<void(const std::string&)>& send) {
    std::string text =
        fmt::format("step {}: {}", pass.step, counted(pass.queries.size(), "query", "queries"));
    for (const Result& result : light.last().results) {
        if (result.values.empty()) {
            continue;  // a band without light
        }
        text += fmt::format(
            ", {} rays in {:.3f} s by {} ({})", result.rays,
            result.preparation_seconds + result.solve_seconds,
            find_solver(result.chosen.method)->name, result.chosen.reason);
    }
    send(text);
}

/// Opens the connection that the switches name, for an environment file that can't be read: only
/// cpfg's shared memory has a key and neither a host nor an extension. Null for pipes, whose end
/// suffices.
std::unique_ptr<ByteStream> open_by_switches(const Arguments& switches) {
    if (!switches.key) {
        return nullptr;
    }
    CommFile guess;
    guess.transport = switches.extension.empty() ? Transport::memory : Transport::files;
    return open_stream(switches, guess, {-1, -1});
}

/// Ends a session in which no light can be computed.
void refuse(ByteStream& stream) {
    if (stream.refuse() == RejectAction::keeps_asking) {
        serve_nothing(stream);
    }
}

/// Ends the process at a signal, after an answer.
void end_at(int signal, ByteStream& stream, const std::function<void(const std::string&)>& send) {
    stream.close();
    send(fmt::format(
        "ended by {}", signal == SIGTERM  ? "SIGTERM"
                       : signal == SIGINT ? "SIGINT"
                                          : "SIGHUP"));
    constexpr int kBySignal = 128;  // exit status of shells
    ::_exit(kBySignal + signal);
}

/// Reports output files that are the pipe of the answers. @param out  descriptor of the pipe
void check_apart_from_pipe(const Specification& spec, const std::string& file, int out) {
    const FileIdentity pipe = identity_of_descriptor(out);
    Faults faults;
    const auto check = [&](std::string_view directive, const std::string& name) {
        if (!name.empty() && !pipe.is_discard && identity_of(name, out) == pipe) {
            faults.add(
                {file, fmt::format("{}: '{}' is the file of the answers", directive, name),
                 "the simulator would read it as an answer", "name another file"});
        }
    };
    if (spec.variance_file) {
        check("output file", spec.variance_file->name);
    }
    if (spec.picture_file) {
        check("picture file", *spec.picture_file);
    }
    faults.throw_if_any();
}

/// One session with a plant simulator.
class Environment {
  public:
    Environment(
        const Arguments& arguments,
        const std::function<void(const std::string&)>& send,
        StepViewer* viewer,
        GuardedStream& stream)
        : arguments_(arguments),
          send_(send),
          viewer_(viewer),
          stream_(stream),
          notices_(send),
          faults_(send) {}

    SessionOutcome run(const Descriptors& descriptors) {
        if (!read_files(descriptors)) {
            refuse(stream_);
            return faults_.worst();
        }
        stream_.announce();
        serve_steps();
        return faults_.worst();
    }

  private:
    /// Reads the files and opens the connection. Returns false if a file has faults, which are
    /// reported.
    /// @throws InputError  if there is no connection
    bool read_files(const Descriptors& descriptors) {
        try {
            format_ = read_comm_file(arguments_, notices_);
        } catch (const std::exception&) {
            const std::exception_ptr fault = std::current_exception();
            if (!open_by_switches_alone()) {
                std::rethrow_exception(fault);
            }
            faults_.report_rejection(fault);
            return false;
        }
        stream_.open(open_stream(arguments_, format_, descriptors));
        try {
            Specification spec =
                read_specification(arguments_.specification, arguments_.kind, notices_);
            if (!arguments_.key) {
                check_apart_from_pipe(spec, arguments_.specification, descriptors.out);
            }
            open_view(spec);
            light_.emplace(std::move(spec), notices_);
        } catch (const std::exception&) {
            faults_.report_rejection(std::current_exception());
            return false;
        }
        return true;
    }

    void open_view(const Specification& spec) {
        is_viewed_ = viewer_ != nullptr && (arguments_.view || spec.view_port);
        if (is_viewed_) {
            viewer_->open(spec.view_port.value_or(0));
        }
    }

    void answer(const Pass& pass, const std::function<void()>& check, Answers& answers) {
        if (is_viewed_) {
            viewer_->on_begin(pass.step);
        }
        light_->answer(pass, check, answers);
        if (is_viewed_) {
            viewer_->on_step(
                {pass.step, light_->specification(), light_->lighting(), light_->shared_last()});
        }
    }

    /// Returns false if the switches name no connection.
    bool open_by_switches_alone() {
        try {
            stream_.open(open_by_switches(arguments_));
        } catch (const InputError&) {
            return false;
        }
        return stream_.is_open();
    }

    void serve_steps() {
        constexpr int kTalkative = 2;
        const bool tells_steps = arguments_.debug || light_->specification().verbose >= kTalkative;
        serve(
            stream_, format_,
            [&](const Pass& pass, const std::function<void()>& check, Answers& answers) {
                answer(pass, check, answers);
                if (tells_steps) {
                    report_step(*light_, pass, send_);
                }
                light_->report_if_unlit();
            },
            [&](std::uint64_t step, const std::exception_ptr& fault) {
                light_->set_step(step + 1);
                faults_.report_step(step, fault);
            });
    }

    const Arguments& arguments_;
    const std::function<void(const std::string&)>& send_;
    StepViewer* viewer_;
    bool is_viewed_ = false;
    GuardedStream& stream_;
    Notices notices_;
    StepErrorLog faults_;
    CommFile format_;
    std::optional<PlantLight> light_;
};

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

SessionOutcome run_environment(
    const Arguments& arguments,
    const Descriptors& descriptors,
    const std::function<void(const std::string&)>& send,
    StepViewer* viewer) {
    GuardedStream stream;
    const StopSignals signals([&](int signal) { end_at(signal, stream, send); });
    Environment environment(arguments, send, viewer, stream);
    try {
        return environment.run(descriptors);
    } catch (const PeerDisconnected&) {
        throw;
    } catch (...) {
        stream.close();
        throw;
    }
}

void refuse_simulator(std::span<const char* const> list) {
    Arguments switches;
    for (std::size_t i = 0; i + 1 < list.size(); ++i) {
        const std::string_view word = list[i], value = list[i + 1];
        if (word == "-k") {
            switches.key = parse_integer(value);
        } else if (word == "-ext") {
            switches.extension = value;
        } else if (word.starts_with("-h")) {
            switches.host = value;
        }
    }
    GuardedStream stream;
    const StopSignals signals(
        [&](int signal) { end_at(signal, stream, [](const std::string&) {}); });
    try {
        if (auto connection = open_by_switches(switches)) {
            stream.open(std::move(connection));
            refuse(stream);
        }
    } catch (const std::exception&) {
        return;  // no connection
    }
}

}  // namespace quasimc
