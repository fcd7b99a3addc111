// SPDX-License-Identifier: Apache-2.0
// What degs::Accelerator checks before the simulation starts, and its tie to a clock of the
// platform.
#include <cmath>
#include <stdexcept>

#include "degs/messages.hpp"
#include "platform/accelerator_core.hpp"
#include "platform/refuse.hpp"

namespace degs {
namespace {

// A larger change of the period by the resolution of time is a mistake of the platform.
constexpr double kRounding = 0.01;

void warn(const char* type, const std::string& who, const std::string& what) {
    SC_REPORT_WARNING(type, (who + ": " + what).c_str());
}

} // namespace

void refuse(const char* type, const std::string& who, const std::string& why) {
    const std::string text = who + ": " + why;
    SC_REPORT_ERROR(type, text.c_str());
    throw std::invalid_argument(std::string(type) + ": " + text);
}

std::unique_ptr<AcceleratorConfig> AcceleratorCore::checked(const AcceleratorConfig& config) const {
    std::unique_ptr<AcceleratorConfig> copy = config.clone();
    copy->read_floats();
    if (const std::string problem = copy->problem(); !problem.empty()) {
        refuse(reports::kConfig, shell_.name(), "configuration '" + config.name + "': " + problem);
    }
    return copy;
}

const AcceleratorOptions& AcceleratorCore::checked(const AcceleratorOptions& options) const {
    if (options.limits.gaussians == 0 || options.limits.pixels == 0) {
        refuse(reports::kOptions, shell_.name(),
               "limits of 0 Gaussians or pixels leave nothing to render");
    }
    if (options.limits.gaussians > AcceleratorOptions::kMostGaussians) {
        refuse(reports::kOptions, shell_.name(),
               "a limit of more than 2^30 Gaussians is more than a scene may have");
    }
    const AcceleratorOptions::Power& power = options.power;
    if (!(power.gated_leakage >= 0 && power.gated_leakage <= 1)) {
        refuse(reports::kOptions, shell_.name(),
               "power.gated_leakage is " + std::to_string(power.gated_leakage) +
                   ", but a share is from 0 to 1");
    }
    if (!(power.wake_ns >= 0 && power.wake_ns <= AcceleratorOptions::kMostWakeNs)) {
        refuse(reports::kOptions, shell_.name(),
               "power.wake_ns is " + std::to_string(power.wake_ns) +
                   ", but must be from 0 to a second");
    }
    if (const std::string wrong = MemoryGateway::problem(options.memory); !wrong.empty()) {
        refuse(reports::kOptions, shell_.name(), wrong);
    }
    return options;
}

// The period of the accelerator's clock. It must have two units of kernel time at least, because
// processes tell the two halves of a cycle apart.
sc_core::sc_time AcceleratorCore::checked_period() const {
    const sc_core::sc_time period = ClockDomain(config_->clock_ghz).period();
    if (period.value() < 2) {
        refuse(reports::kClock, shell_.name(),
               "the time resolution " + sc_core::sc_get_time_resolution().to_string() +
                   " is too coarse for a clock of " + std::to_string(config_->clock_ghz) + " GHz");
    }
    const double wanted = 1e-9 / config_->clock_ghz;
    if (std::abs(period.to_seconds() - wanted) > kRounding * wanted) {
        warn(reports::kClock, shell_.name(),
             "the time resolution turns the period of " + std::to_string(config_->clock_ghz) +
                 " GHz into " + period.to_string());
    }
    return period;
}

void AcceleratorCore::end_of_elaboration() {
    finished_.connect_reader(self_);
    if (shell_.clk.size() != 0) {
        follow_clock();
    }
    if (const std::optional<OperatingPoint> point = take_asked()) {
        check(*point);
        set_point(*point);
    }
}

void AcceleratorCore::follow_clock() {
    const auto* const clock = dynamic_cast<const sc_core::sc_clock*>(shell_.clk[0]);
    if (clock == nullptr) {
        refuse(reports::kClock, shell_.name(),
               "clk is bound to a channel that is not an sc_clock; leave it unbound for clock_ghz");
    }
    if (clock->period().value() < 2) {
        refuse(reports::kClock, shell_.name(),
               "the time resolution is too coarse for a clock of " + clock->period().to_string());
    }
    const sc_core::sc_time first = clock->posedge_first()
                                       ? sc_core::SC_ZERO_TIME
                                       : clock->period() * (1.0 - clock->duty_cycle());
    mapping_.follow(clock->period(), clock->start_time() + first);
    config_->clock_ghz = 1e-9 / clock->period().to_seconds();
    point_.period = clock->period();
}

void AcceleratorCore::start_of_simulation() {
    if (options_.memory.transport == Transport::Lt && options_.memory.pacing == Pacing::Quantum &&
        tlm::tlm_global_quantum::instance().get() == sc_core::SC_ZERO_TIME) {
        warn(reports::kOptions, shell_.name(),
             "memory.pacing is Quantum, but there is no global quantum: accesses are exact");
    }
}

// Traces booleans, which people can read, and register words, to compare with what a driver sees.
void AcceleratorCore::trace(sc_core::sc_trace_file* file) const {
    const std::string path = shell_.name();
    sc_core::sc_trace(file, lines_.busy, path + ".busy");
    sc_core::sc_trace(file, lines_.in_reset, path + ".in_reset");
    sc_core::sc_trace(file, lines_.irq, path + ".irq");
    const std::pair<Register, const char*> words[] = {
        {Register::Status, ".status"},        {Register::IrqEnable, ".irq_enable"},
        {Register::IrqStatus, ".irq_status"}, {Register::ErrorCode, ".error_code"},
        {Register::Frames, ".frames"},        {Register::Cycles, ".cycles"}};
    for (const auto& [which, suffix] : words) {
        sc_core::sc_trace(file, registers_.low_word(which), path + suffix);
    }
}

} // namespace degs
