#include "step_window.h"

#include <fmt/format.h>

void StepWindow::open(int port) {
    window_.emplace(port);
    send_("view: " + window_->address());
}

void StepWindow::on_begin(std::int64_t step) {
    window_->send(fmt::format("the light of step {} is being computed", step));
}

void StepWindow::on_step(const quasimc::StepSnapshot& step) {
    window_->add(step);
}
