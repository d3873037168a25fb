// Commands for the page in the browser: as a file, and served.

#include <cstdio>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "files/output_files.h"
#include "interrupt.h"
#include "quasimc/quasimc.h"
#include "show_values.h"
#include "window/page.h"
#include "window/window_data.h"
#include "window/window_server.h"
#include "window/window_sweep.h"

namespace {

struct WindowArguments {
    std::string file, output, minus;
    std::size_t point = 0, port = 0;
};

/// A run and its data for the page.
struct WindowRun {
    std::vector<quasimc::InputFile> inputs;
    quasimc::WindowData data;
};

ShownRun read_result(const std::string& path, std::size_t point) {
    ShownRun shown = read_shown_run(path, point);
    if (shown.result_text.empty()) {
        throw quasimc::InputError(
            {{path, "is not a result", "",
              "write one with quasimc run --json; quasimc show draws a scene without light"}});
    }
    return shown;
}

Flag minus_flag(std::string& target) {
    return {
        .name = "--minus",
        .target = &target,
        .summary = "JSON result whose values are subtracted; the page then shows differences",
        .type_name = "FILE"};
}

WindowRun read_window_run(const WindowArguments& arguments) {
    ShownRun shown = read_result(arguments.file, arguments.point);
    const quasimc::ReadResult result{shown.run, shown.result_text, arguments.file};
    if (arguments.minus.empty()) {
        quasimc::WindowData data = quasimc::make_window_data(result);
        return {std::move(shown.inputs), std::move(data)};
    }
    const ShownRun other = read_result(arguments.minus, arguments.point);
    const quasimc::ReadResult minus{other.run, other.result_text, arguments.minus};
    quasimc::WindowData data = quasimc::make_window_data(result, &minus);
    shown.inputs.insert(shown.inputs.end(), other.inputs.begin(), other.inputs.end());
    return {std::move(shown.inputs), std::move(data)};
}

Exit report(const WindowArguments& arguments) {
    quasimc::require_page("report");
    const WindowRun run = read_window_run(arguments);
    constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;
    if (run.data.bytes() > kMaxBytes) {
        throw quasimc::InputError(
            {{arguments.file,
              fmt::format("makes a report of {} MB", run.data.bytes() * 4 / 3 >> 20U),
              "browsers open no more than some 350",
              "write fewer quantities, bands or times (--quantities, --bands), or use quasimc "
              "view"}});
    }
    quasimc::OutputFiles output({{arguments.output, "-o"}}, run.inputs);
    write_report(run.data, output.sink(0));
    output.commit();
    output.throw_if_given_up();
    return Exit::done;
}

/// The data of a point of a sweep, from 0.
quasimc::WindowData read_point(const std::string& file, std::size_t point) {
    const ShownRun shown = read_result(file, point + 1);
    return quasimc::make_window_data({shown.run, shown.result_text, file});
}

/// The files of a result; of all points of a sweep, unless one is chosen or another result
/// subtracted.
quasimc::WindowFiles files_to_view(const WindowArguments& arguments) {
    if (arguments.point == 0 && arguments.minus.empty()) {
        const ShownRun shown = read_result(arguments.file, 0);
        if (shown.run.sweep) {
            (void)quasimc::make_window_data({shown.run, shown.result_text, arguments.file});
            return quasimc::files_of_sweep(
                shown.run.sweep->size(), 0,
                [file = arguments.file](std::size_t point) { return read_point(file, point); });
        }
    }
    return quasimc::files_of(read_window_run(arguments).data);
}

Exit view(const WindowArguments& arguments) {
    quasimc::require_page("view");
    const InterruptWatch interrupt([] {});
    const quasimc::HttpServer server(
        quasimc::ViewerRoutes(files_to_view(arguments), quasimc::random_token()),
        static_cast<int>(arguments.port));
    fmt::print("{}\n", server.address());
    std::fflush(stdout);
    fmt::print(stderr, "Open this address in a browser of this computer; Ctrl-C ends.\n");
    interrupt.wait_for_first();
    return Exit::done;
}

}  // namespace

Command report_command() {
    const auto arguments = std::make_shared<WindowArguments>();
    return {
        "report",
        "write a result as one HTML page for any browser",
        {{"FILE", &arguments->file, "JSON result", true},
         {.name = "-o,--output",
          .target = &arguments->output,
          .summary = "HTML file to write, - for standard output",
          .required = true,
          .type_name = "FILE"},
         minus_flag(arguments->minus),
         point_flag(arguments->point)},
        [arguments] { return report(*arguments); }};
}

Command view_command() {
    const auto arguments = std::make_shared<WindowArguments>();
    return {
        "view",
        "show a result in a browser of this computer",
        {{"FILE", &arguments->file, "JSON result", true},
         {.name = "--port",
          .target = &arguments->port,
          .summary = "port of 127.0.0.1 (0: any that is free)",
          .range = std::pair(0.0, 65535.0),
          .default_text = "0"},
         minus_flag(arguments->minus),
         point_flag(arguments->point)},
        [arguments] { return view(*arguments); }};
}
