// SPDX-License-Identifier: Apache-2.0
// How a platform changes the clock of degs::Accelerator, and what energy takes with it.
//
// Blocks still work for cancelled tiles when a frame has ended. So a new period comes as a reset
// does: they hurry through what is left, and the clock goes on when they rest.
#include <cmath>
#include <string>
#include <utility>

#include "degs/messages.hpp"
#include "platform/accelerator_core.hpp"
#include "platform/refuse.hpp"

namespace degs {
namespace {

bool is_factor(double factor) {
    return std::isfinite(factor) && factor >= 0;
}

} // namespace

void AcceleratorCore::check(const OperatingPoint& point) const {
    const std::string period = point.period.to_string();
    if (point.period.value() < 2) {
        refuse(reports::kPower, shell_.name(),
               "a cycle of " + period + " has no two halves at the time resolution " +
                   sc_core::sc_get_time_resolution().to_string());
    }
    if (!is_factor(point.energy_factor) || !is_factor(point.leakage_factor)) {
        refuse(reports::kPower, shell_.name(),
               "the factors of energy and leakage must be finite and not negative, but are " +
                   std::to_string(point.energy_factor) + " and " +
                   std::to_string(point.leakage_factor));
    }
    if (shell_.clk.size() != 0 && point.period != point_.period) {
        refuse(reports::kPower, shell_.name(),
               "clk is bound to an sc_clock of " + point_.period.to_string() +
                   ", whose period cannot become " + period + "; leave it unbound for that");
    }
}

// Whether the point waits for a frame is decided by the order of the calls, as software sees it,
// and not by the order in which the kernel runs processes.
void AcceleratorCore::set_operating_point(const OperatingPoint& point) {
    check(point);
    asked_ = point;
    changes_ = (registers_.get(Register::Status) & kStatusBusy) == 0;
    if (sc_core::sc_get_status() != sc_core::SC_ELABORATION) {
        work_.notify(sc_core::SC_ZERO_TIME);
    }
}

std::optional<OperatingPoint> AcceleratorCore::take_asked() {
    changes_ = false;
    return std::exchange(asked_, std::nullopt);
}

// Edges lie at multiples of the period, as if it had been the first one. Only while blocks rest, if
// it is another period.
void AcceleratorCore::set_point(const OperatingPoint& point) {
    if (point.period != point_.period) {
        mapping_.follow(point.period, sc_core::SC_ZERO_TIME);
        config_->clock_ghz = 1e-9 / point.period.to_seconds();
    }
    point_ = point;
    meter_.set(point_, sc_core::sc_time_stamp());
}

// An access of the last frame that has faulted is given up, too.
void AcceleratorCore::change_point() {
    const std::optional<OperatingPoint> point = take_asked();
    if (point->period == point_.period) {
        set_point(*point);
        return;
    }
    set_status(0, kStatusFaulted);
    resume_requested_.cancel();
    cut_off();
    await_rest();
    go_on(point);
}

} // namespace degs
