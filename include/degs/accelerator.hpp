// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_target_socket.h>

#include "degs/design.hpp"
#include "degs/options.hpp"

namespace degs {

class AcceleratorCore;

/// What a platform that scales clock and voltage gives an accelerator. The model knows no voltages:
/// the factors are against the energy of the design as its configuration states it. Dynamic energy
/// follows about the square of the voltage.
struct OperatingPoint {
    sc_core::sc_time period;   ///< of the clock
    double energy_factor = 1;  ///< of dynamic energy, not negative
    double leakage_factor = 1; ///< of the power that leaks, not negative
};

/// Any accelerator of the project as a module of a platform, with registers, a memory socket and an
/// interrupt. docs/accelerator.md has the register map and the memory layout.
///
/// A frame: the access that starts it samples the registers, whatever delay it is annotated with.
/// Values come from a copy of the scene that is read first, by debug transport in no time, or by
/// transactions where the memory has no debug transport. The
/// model then reads the same bytes again when its blocks do, and writes real pixels. Bytes that
/// differ by then are an error, and so are refused accesses and bad registers. A frame always ends
/// with Done, Error or Aborted and, if enabled, the interrupt. Nothing throws. With
/// Options::memory.faults = Stall a refused access waits for software in place of the error.
///
/// A reset or an abort cuts the blocks off the bus and lets them hurry through the rest of the
/// frame: no block knows of it, and all are then where they are between frames.
///
/// Not modelled: the values of splat records and lists, which are written to the workspace as bytes
/// without meaning. The host keeps the present frame and the one before it, about 200 B per visible
/// splat each.
class Accelerator : public sc_core::sc_module {
public:
    using Options = AcceleratorOptions;

    /// Words of 4 B, little-endian, LT and debug. An access takes a cycle.
    tlm_utils::simple_target_socket<Accelerator> registers;
    /// Any LT target, or, with Options::memory.transport = At, any AT target.
    tlm::tlm_initiator_socket<> mem;
    /// Ports that may stay unbound.
    template <class Interface>
    using OptionalPort = sc_core::sc_port<Interface, 1, sc_core::SC_ZERO_OR_MORE_BOUND>;
    /// High while an enabled interrupt is pending.
    OptionalPort<sc_core::sc_signal_inout_if<bool>> irq;
    /// Low: reset. Takes effect at once, whatever the clock does.
    OptionalPort<sc_core::sc_signal_in_if<bool>> reset_n;
    /// An sc_clock, whose period and rising edges take the place of `clock_ghz`. That period is
    /// fixed for its life, and it is not gated.
    OptionalPort<sc_core::sc_signal_in_if<bool>> clk;

    /// Copies `design` and makes the copy read scenes of floats. What is wrong with it, with the
    /// options or with the clock is reported as messages.hpp says, and refused.
    Accelerator(const sc_core::sc_module_name& name, const Design& design,
                const Options& options = {});
    /// Takes a configuration in place of a design, for programs that are built from the sources.
    Accelerator(const sc_core::sc_module_name& name, const AcceleratorConfig& config,
                const Options& options = {});
    ~Accelerator() override;

    /// GHz; that of the bound clock, if any, from the end of elaboration on, and that of the
    /// operating point.
    double clock_ghz() const;
    /// Changes clock and energy between frames. May be called at any time. While a frame is being
    /// rendered (STATUS bit 0) it takes effect at its end, else at once; a start meanwhile waits
    /// for it, as after a reset. The last of several calls counts. With `clk` bound, the period
    /// must be that of the clock. What cannot be is refused as reports::kPower.
    void set_operating_point(const OperatingPoint& point);
    /// The one in effect.
    const OperatingPoint& operating_point() const;
    /// The state that registers show: busy, in_reset, irq, status, irq_enable, irq_status,
    /// error_code, frames and the low word of cycles, below name().
    void trace(sc_core::sc_trace_file* file) const override;
    /// What is behind the sockets, for programs that are built from the sources.
    AcceleratorCore& core() { return *core_; }

private:
    void end_of_elaboration() override;
    void start_of_simulation() override;
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(tlm::tlm_generic_payload& payload);
    void run();
    void drive_irq();
    void begin_stop();
    void resume_access();

    std::unique_ptr<AcceleratorCore> core_;
};

} // namespace degs
