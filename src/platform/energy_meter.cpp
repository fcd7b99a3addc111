// SPDX-License-Identifier: Apache-2.0
#include "platform/energy_meter.hpp"

namespace degs {
namespace {

std::vector<cost::Activity> activity_of(const RenderEngine& engine) {
    AcceleratorResult result;
    engine.collect(result);
    return std::move(result.activity);
}

} // namespace

EnergyMeter::EnergyMeter(const AcceleratorConfig& config, const AcceleratorOptions::Power& power)
    : config_(config), leakage_w_(config.bill().leakage_w()), gated_leakage_(power.gated_leakage) {}

void EnergyMeter::settle(const sc_core::sc_time& date) {
    constexpr double kNjPerJ = 1e9;
    if (date > since_) {
        const double share = gated_ ? gated_leakage_ : 1;
        idle_nj_ +=
            kNjPerJ * leakage_w_ * point_.leakage_factor * share * (date - since_).to_seconds();
        since_ = date;
    }
}

void EnergyMeter::gate(bool gated, const sc_core::sc_time& date) {
    settle(date);
    gated_ = gated;
}

void EnergyMeter::set(const OperatingPoint& point, const sc_core::sc_time& date) {
    settle(date);
    point_ = point;
}

void EnergyMeter::restart(const sc_core::sc_time& date) {
    gate(false, date);
    idle_nj_ = 0;
    known_ = false;
}

void EnergyMeter::begin_frame(const RenderEngine& engine, const sc_core::sc_time& date) {
    settle(date);
    last_ = {activity_of(engine), 0, config_.clock_ghz, point_, idle_nj_};
}

void EnergyMeter::end_frame(std::uint64_t cycles, const sc_core::sc_time& date) {
    settle(date);
    idle_nj_ = 0;
    last_.cycles = cycles;
    known_ = true;
}

double EnergyMeter::frame_nj(const RenderEngine& engine) const {
    if (!known_) {
        return 0;
    }
    AcceleratorResult frame; // without traffic: the main memory is the platform's
    frame.activity = activity_of(engine);
    for (std::size_t b = 0; b < frame.activity.size(); ++b) {
        frame.activity[b].operations -= last_.before[b].operations;
    }
    frame.cycles = last_.cycles;
    frame.clock_ghz = last_.clock_ghz;
    const cost::RunEnergy energy = energy_of(config_, frame, 0);
    return last_.point.energy_factor * energy.dynamic_nj() +
           last_.point.leakage_factor * energy.leakage_nj();
}

} // namespace degs
