// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <systemc>

#include "degs/accelerator.hpp"
#include "modules/kit/accelerator/accelerator_energy.hpp"

namespace degs {

/// The energy of an accelerator on a platform, without the main memory: of its last frame, and of
/// the time before that frame, in which it only leaks. Dates never fall; one that lies behind an
/// earlier one counts as that.
class EnergyMeter {
public:
    EnergyMeter(const AcceleratorConfig& config, const AcceleratorOptions::Power& power);

    /// From `date` on leakage is that of a gated supply, or not.
    void gate(bool gated, const sc_core::sc_time& date);
    /// From `date` on the accelerator has this operating point; not within a frame.
    void set(const OperatingPoint& point, const sc_core::sc_time& date);
    /// Power-on, or a reset: there was no frame, and nothing has leaked.
    void restart(const sc_core::sc_time& date);

    /// A frame begins, which takes part of the counters of `engine` from now on.
    void begin_frame(const RenderEngine& engine, const sc_core::sc_time& date);
    /// The frame has taken so many cycles. If it is given up, this is not called, and its time is
    /// part of that before the next frame.
    void end_frame(std::uint64_t cycles, const sc_core::sc_time& date);
    /// There is no last frame any more.
    void forget_frame() { known_ = false; }

    /// nJ of the last frame, 0 if none is known: what `engine` has done since it began. A frame
    /// grows a little after its last pixel, until blocks rest: they work for tiles that were
    /// cancelled.
    double frame_nj(const RenderEngine& engine) const;
    /// nJ before the last frame, since the end of the one before.
    double idle_nj() const { return known_ ? last_.idle_nj : 0; }

private:
    void settle(const sc_core::sc_time& date);

    const AcceleratorConfig& config_;
    double leakage_w_, gated_leakage_;
    OperatingPoint point_;
    bool gated_ = false;
    double idle_nj_ = 0;     // up to since_, without frames that have ended
    sc_core::sc_time since_; // date of the last change
    struct {
        std::vector<cost::Activity> before; // what blocks had done when it began
        std::uint64_t cycles = 0;
        double clock_ghz = 1;
        OperatingPoint point;
        double idle_nj = 0;
    } last_;
    bool known_ = false;
};

} // namespace degs
