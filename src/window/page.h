#pragma once

#include <span>
#include <string>
#include <string_view>

#include "quasimc/error.h"
#include "window/window_data.h"

namespace quasimc {

/// The page that shows a scene and its light in a browser, as it was bundled when the program was
/// built (web/).
struct Page {
    std::string_view html, style, script;
};

/// Empty texts if the program was built without Node.
[[nodiscard]] Page embedded_page();

/// @throws InputError  if the program was built without the page. @param command  for the message
void require_page(std::string_view command);

/// Colour maps, as a JSON object for the page.
[[nodiscard]] std::string color_maps_json();

/// Writes the page with its data as one file that needs no network: its content security policy
/// allows its own script only. Points of the same shape share it.
/// @param points  the points of a sweep, the first of which is shown; one for other results
void write_report(std::span<const WindowData> points, const TextSink& sink);

}  // namespace quasimc
