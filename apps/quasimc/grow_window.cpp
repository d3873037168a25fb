#include "grow_window.h"

void GrowWindow::add(GrownPlant& plant, bool has_light) {
    step_ = plant.step();
    drawn_ = plant.scene();
    if (!has_light) {
        window_.add(step_, drawn_);
    }
}

void GrowWindow::set_light(const GrowEnvironment& environment) {
    if (environment.has_stand() || !drawn_ || step_ != environment.pass_step()) {
        window_.add(environment.light());
        return;
    }
    window_.add(environment.light(), drawn_, environment.light_of(*drawn_));
}
