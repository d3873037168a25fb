#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "readers.h"
#include "scene/scene.h"
#include "window/live_window.h"
#include "window/window_site.h"

namespace quasimc::fuzz {
namespace {

constexpr std::string_view kToken = "0123456789abcdef0123456789abcdef";

ViewerRoutes make_site(WindowFiles files, WindowKind kind) {
    ViewerRoutes made(std::move(files), std::string(kToken), kind);
    made.set_port(8080);
    return made;
}

/// A run of one organ, without light yet.
WindowFiles files_of_live_run() {
    SceneBuilder builder({{"PAR"}});
    builder.add_material({"leaf", {{.1, .1}}, {{.1, .1}}});
    OrganSpec leaf;
    leaf.parts.push_back({"leaf", {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}}});
    builder.add_organ(std::move(leaf));
    LiveScene scene;
    scene.scene = std::make_shared<const Scene>(std::move(builder).build());
    scene.bands = scene.scene->bands();
    LiveFrame frame;
    frame.scene = std::make_shared<const LiveScene>(std::move(scene));
    frame.results = std::make_shared<const std::vector<Result>>();
    const auto window = std::make_shared<LiveWindow>();
    window->add(std::move(frame));
    return [window](std::string_view name) { return window->file(name); };
}

}  // namespace

/// No request is answered that does not name the host and the token.
void fuzz_window_request(const std::string& bytes) {
    static const ViewerRoutes done =
        make_site(files_of({"{}", "shape", {"values"}}), WindowKind::of_result);
    static const ViewerRoutes live = make_site(files_of_live_run(), WindowKind::live);
    const std::string_view text(bytes);
    const bool has_both =
        text.find(kToken) != std::string_view::npos && text.find(":8080") != std::string_view::npos;
    for (const ViewerRoutes* site : {&done, &live}) {
        const HttpAnswer answer = site->answer(parse_request(text));
        const bool is_told = answer.status == 200 || answer.status == 404;
        if ((is_told && !has_both) || !answer.head().ends_with("\r\n\r\n")) {
            std::abort();
        }
    }
}

}  // namespace quasimc::fuzz
