// Commands for the page in the browser: as a file, and served.

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

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

/// A result for the page: all points of a sweep, or one.
struct WindowRun {
    std::vector<quasimc::InputFile> inputs;
    std::vector<quasimc::WindowData> points;
};

void check_result(const std::string& text, const std::string& path) {
    if (text.empty()) {
        throw quasimc::InputError(
            {{path, "is not a result", "",
              "write one with quasimc run --json; quasimc show draws a scene without light"}});
    }
}

ShownRun read_result(const std::string& path, std::size_t point) {
    ShownRun shown = read_shown_run(path, point);
    check_result(shown.result_text, path);
    return shown;
}

Flag minus_flag(std::string& target) {
    return {
        .name = "--minus",
        .target = &target,
        .summary = "JSON result whose values are subtracted; the page then shows differences",
        .type_name = "FILE"};
}

/// The largest report. Browsers open no more, in base64, than some 350 MB.
constexpr std::size_t kMaxBytes = std::size_t{256} << 20U;

WindowRun read_single(const WindowArguments& arguments) {
    ShownRun shown = read_result(arguments.file, arguments.point);
    const quasimc::ReadResult result{shown.run, shown.result_text, arguments.file};
    if (arguments.minus.empty()) {
        return {std::move(shown.inputs), {quasimc::make_window_data(result)}};
    }
    const ShownRun other = read_result(arguments.minus, arguments.point);
    const quasimc::ReadResult minus{other.run, other.result_text, arguments.minus};
    shown.inputs.insert(shown.inputs.end(), other.inputs.begin(), other.inputs.end());
    return {std::move(shown.inputs), {quasimc::make_window_data(result, &minus)}};
}

void check_size(const WindowRun& run, const std::string& file) {
    std::size_t bytes = 0;
    for (const quasimc::WindowData& point : run.points) {
        bytes += point.bytes();
    }
    if (bytes > kMaxBytes) {
        throw quasimc::InputError(
            {{file, fmt::format("makes a report of more than {} MB", kMaxBytes * 4 / 3 >> 20U),
              "browsers open no more",
              "write fewer quantities, bands or times (--quantities, --bands), choose a point of a "
              "sweep (--sweep-point), or use quasimc view"}});
    }
}

/// Everything that a page shows.
WindowRun read_window_run(const WindowArguments& arguments) {
    if (arguments.point > 0 || !arguments.minus.empty()) {
        return read_single(arguments);
    }
    ShownSweep sweep = read_shown_sweep(arguments.file);
    check_result(sweep.result_text, arguments.file);
    std::vector<quasimc::RunFile> runs;
    WindowRun shown;
    for (std::size_t point = 0; point < sweep.runs.size(); ++point) {
        runs.push_back(sweep.runs.take(point));
        const auto inputs = shown_inputs(runs.back(), arguments.file);
        shown.inputs.insert(shown.inputs.end(), inputs.begin(), inputs.end());
    }
    shown.points = quasimc::make_window_data(runs, sweep.result_text, arguments.file);
    return shown;
}

Exit report(const WindowArguments& arguments) {
    quasimc::require_page("report");
    const WindowRun run = read_window_run(arguments);
    check_size(run, arguments.file);
    quasimc::OutputFiles output({{arguments.output, "-o"}}, run.inputs);
    write_report(run.points, output.sink(0));
    output.commit();
    output.throw_if_given_up();
    return Exit::done;
}

Exit view(const WindowArguments& arguments) {
    quasimc::require_page("view");
    const InterruptWatch interrupt([] {});
    const quasimc::HttpServer server(
        quasimc::ViewerRoutes(
            quasimc::files_of_sweep(read_window_run(arguments).points), quasimc::random_token()),
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
