// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <memory>

#include <systemc>
#include <tlm>
#include <tlm_utils/simple_target_socket.h>

#include "modules/kit/accelerator/render_engine.hpp"
#include "platform/accelerator_request.hpp"
#include "platform/memory_gateway.hpp"
#include "platform/scene_copy.hpp"

namespace degs {

/// Any accelerator of the project as a module of a platform, with registers, a memory socket and an
/// interrupt. docs/accelerator.md has the register map and the memory layout.
///
/// A frame: the access that starts it samples the registers, whatever delay it is annotated with.
/// Values come from a copy of the scene that is read first, by debug transport in no time, or by
/// transactions where the memory has no debug transport. The
/// model then reads the same bytes again when its blocks do, and writes real pixels. Bytes that
/// differ by then are an error, and so are refused accesses and bad registers. A frame always ends
/// with Done, Error or Aborted and, if enabled, the interrupt. Nothing throws.
///
/// A reset or an abort cuts the blocks off the bus and lets them hurry through the rest of the frame:
/// no block knows of it, and all are then where they are between frames.
///
/// Not modelled: power states, and the values of splat records and lists, which are written to the
/// workspace as bytes without meaning. The host memory of a frame (about 200 B per visible splat) is
/// kept until the end of the simulation.
class Accelerator : public sc_core::sc_module {
public:
    struct Options {
        AcceleratorRequest::Limits limits;
        Fidelity fidelity = Fidelity::Exact;
        bool antialiased = false; ///< what the files of its scenes say, see RenderingRules
        MemoryGateway::Options memory;
        Timeline* timeline = nullptr; ///< which the accelerator joins; must outlive it
        /// All of them except the timeline, as keys.
        void describe(ConfigVisitor& visitor);
    };

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
    /// An sc_clock, whose period and rising edges take the place of `clock_ghz`. Its period must not
    /// change, and it is not gated.
    OptionalPort<sc_core::sc_signal_in_if<bool>> clk;

    /// Copies `config` and makes the copy read scenes of floats. What is wrong with it, with the
    /// options or with the clock is reported as accelerator_reports.hpp says, and refused.
    Accelerator(const sc_core::sc_module_name& name, const AcceleratorConfig& config);
    Accelerator(const sc_core::sc_module_name& name, const AcceleratorConfig& config,
                const Options& options);

    /// With the frequency of the bound clock, if any, from the end of elaboration on.
    const AcceleratorConfig& config() const { return *config_; }
    /// For test benches: state that the registers do not expose.
    const RenderEngine& engine() const { return *engine_; }
    const MemoryGateway& gateway() const { return gateway_; }
    /// When nothing is left to happen, before the timeline is read.
    void complete_timeline();
    /// The state that registers show: busy, in_reset, irq, status, irq_enable, irq_status, error_code,
    /// frames and the low word of cycles, below name().
    void trace(sc_core::sc_trace_file* file) const override;

private:
    using Payload = tlm::tlm_generic_payload;

    std::unique_ptr<AcceleratorConfig> checked(const AcceleratorConfig& config) const;
    const Options& checked(const Options& options) const;
    sc_core::sc_time checked_period() const;
    void end_of_elaboration() override;
    void start_of_simulation() override;
    void follow_clock();
    void transport(Payload& payload, sc_core::sc_time& delay);
    unsigned int debug(Payload& payload);
    static tlm::tlm_response_status check_access(const Payload& payload);
    tlm::tlm_response_status write(std::uint32_t offset, std::uint32_t value,
                                   const sc_core::sc_time& delay);
    void command(std::uint32_t bits, const sc_core::sc_time& delay);

    /// Why the present frame, if there is one, is given up.
    enum class Stop { None, Abort, Reset };
    void request_stop(Stop why);
    void begin_stop();
    void end_stop();
    void await_rest();
    bool held_in_reset() const { return reset_n.size() != 0 && !reset_n->read(); }

    void run();
    AcceleratorFault serve();
    void drive_irq();
    AcceleratorFault prepare();
    AcceleratorFault make_workload();
    AcceleratorFault render();
    void count_frame(Cycle started, const MemoryTraffic& before);
    void end_frame(const AcceleratorFault& fault);
    void set_status(std::uint32_t set, std::uint32_t clear);

    std::unique_ptr<AcceleratorConfig> config_;
    Options options_;
    ClockMapping mapping_;
    Timebase time_;
    AcceleratorRegisters registers_;
    struct { // for trace()
        bool busy = false, in_reset = false, irq = false;
    } lines_;
    AcceleratorRequest request_;     // of the present frame
    AcceleratorFault request_fault_; // likewise: why it cannot be served, if so
    SceneCopy scene_;
    bool scene_changed_ = false;
    std::deque<FrameWorkload> workloads_;
    RenderJob job_;
    Process self_;
    DatedFifo<std::uint32_t> finished_;
    MemoryGateway gateway_;
    std::unique_ptr<RenderEngine> engine_;
    bool started_ = false; // a start waits for its date, or is being served
    Stop stop_ = Stop::None;
    sc_core::sc_event work_; // of run(), at the date of a start or a stop
    sc_core::sc_event stop_requested_, irq_changed_;
};

} // namespace degs
