// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

#include "dram/banks.hpp"
#include "dram/controller.hpp"

namespace degs::dram {

/// When refreshes of a channel are due, and what they need. Once one is due, its banks take nothing
/// else: they finish an activation, close, and are refreshed.
class Refresher {
public:
    struct Step {
        Command command;
        unsigned bank;
    };

    /// `phase`: CK by which the first refresh comes early.
    Refresher(const Timing& timing, const ControllerConfig& config, Ck phase)
        : kind_(config.refresh), steps_(timing.refresh_steps()),
          period_(config.refresh == Refresh::PerBank ? timing.refi / steps_ : timing.refi),
          due_(config.refresh == Refresh::None ? kNoDate : period_ - std::min(phase, period_)) {}

    Ck due() const { return due_; }
    bool active() const { return active_; }
    void start() { active_ = true; }
    /// Banks that take no other command, as a mask.
    std::uint32_t held_banks() const {
        return !active_                    ? 0
               : kind_ == Refresh::AllBank ? ~0U
                                           : 1U << bank_ | 1U << (bank_ + steps_);
    }
    /// The next command of an active refresh.
    Step next(const Banks& banks) const;
    /// The refresh command has been sent.
    void finish() {
        due_ += period_;
        active_ = false;
        bank_ = (bank_ + 1) % steps_;
    }

private:
    Refresh kind_;
    unsigned steps_; // of per-bank refresh: pairs of banks
    Ck period_, due_;
    bool active_ = false;
    unsigned bank_ = 0; // first of the pair that is next
};

} // namespace degs::dram
