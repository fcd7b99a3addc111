// SPDX-License-Identifier: Apache-2.0
// Reset and abort of degs::Accelerator.
//
// The blocks are threads with state of their own. None of them knows how to give up a frame, so
// they finish it, at no cost to the platform: the gateway stops touching the bus, and the clock
// hurries.
#include <algorithm>

#include "platform/accelerator_core.hpp"

namespace degs {
namespace {

// Time between two looks at whether the blocks have come to rest, in units of kernel time.
constexpr std::uint64_t kRestInterval = 128;

} // namespace

// Shows a stop in the registers at once. Everything else follows at its date, see begin_stop().
void AcceleratorCore::request_stop(Stop why, const sc_core::sc_time& delay) {
    if (why == Stop::Reset) {
        registers_ = AcceleratorRegisters();
        meter_.restart(sc_core::sc_time_stamp() + delay);
        shown_.clear();
        set_status(kStatusInReset, 0);
    }
    set_status(0, kStatusFaulted);
    resume_requested_.cancel();
    const sc_core::sc_time date = sc_core::sc_time_stamp() + delay;
    stop_date_ = stop_ == Stop::None ? date : std::min(stop_date_, date);
    stop_ = stop_ == Stop::Reset ? stop_ : why;
}

void AcceleratorCore::begin_stop() {
    if (held_in_reset()) {
        request_stop(Stop::Reset, sc_core::SC_ZERO_TIME);
        irq_changed_.notify(sc_core::SC_ZERO_TIME);
    }
    if (stop_ == Stop::None || gateway_.detached()) { // it has been done, or is under way
        return;
    }
    if (stop_date_ > sc_core::sc_time_stamp()) { // the first activation, or a change of reset_n
        return;
    }
    cut_off();
    work_.notify(sc_core::SC_ZERO_TIME);
}

// From now on the platform sees nothing more of what blocks still do.
void AcceleratorCore::cut_off() {
    gateway_.detach();
    mapping_.hurry();
}

// Waits until all blocks rest and the last transaction is answered, so that the platform hears no
// more of the frame afterwards.
void AcceleratorCore::await_rest() {
    while (!gateway_.idle()) {
        sc_core::wait(gateway_.became_idle());
    }
    for (int rests = 0; rests < 2; rests = mapping_.settled() ? rests + 1 : 0) {
        sc_core::wait(sc_core::sc_time::from_value(kRestInterval));
    }
    if (const sc_core::sc_time now = sc_core::sc_time_stamp(); gateway_.last_answer() > now) {
        sc_core::wait(gateway_.last_answer() - now);
    }
    while (held_in_reset()) {
        sc_core::wait(shell_.reset_n->value_changed_event());
    }
}

// The blocks rest: the clock goes on, at `point` if there is one.
void AcceleratorCore::go_on(const std::optional<OperatingPoint>& point) {
    gateway_.attach();
    if (point) {
        set_point(*point);
    }
    if (const sc_core::sc_time edge = mapping_.resume(); edge > sc_core::sc_time_stamp()) {
        sc_core::wait(edge - sc_core::sc_time_stamp());
    }
}

void AcceleratorCore::end_stop() {
    do {
        await_command(); // the frame may have ended before the date of the stop
        begin_stop();
        await_rest();
        go_on(take_asked());
    } while (gateway_.detached()); // once more
    job_.first_since_reset = static_cast<std::uint32_t>(job_.frames.size());
    meter_.gate(gates_idle(), sc_core::sc_time_stamp());
    if (stop_ == Stop::Reset) {
        set_status(0, kStatusInReset);
    } else {
        set_status(kStatusAborted, kStatusBusy);
        registers_.set(Register::IrqStatus, registers_.get(Register::IrqStatus) | kIrqAborted);
        irq_changed_.notify(sc_core::SC_ZERO_TIME);
    }
    stop_ = Stop::None;
}

} // namespace degs
