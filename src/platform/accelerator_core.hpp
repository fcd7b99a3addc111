// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>

#include "degs/accelerator.hpp"
#include "modules/kit/accelerator/render_engine.hpp"
#include "platform/accelerator_request.hpp"
#include "platform/energy_meter.hpp"
#include "platform/memory_gateway.hpp"
#include "platform/scene_copy.hpp"

namespace degs {

/// What is behind the sockets of degs::Accelerator, whose header names nothing of this project's
/// inside.
class AcceleratorCore {
public:
    /// `shell` must outlive it, and is under construction: blocks become its children.
    AcceleratorCore(Accelerator& shell, const AcceleratorConfig& config,
                    const AcceleratorOptions& options);

    /// The configuration. From the end of elaboration on it has the frequency of the bound clock,
    /// if there is one, and that of the operating point.
    const AcceleratorConfig& config() const { return *config_; }
    /// The frames that are kept, the last one included.
    const RenderJob& job() const { return job_; }
    /// Completes the timeline before it is read, once nothing is left to happen.
    void complete_timeline();

    /// Accelerator says what these functions do.
    void set_operating_point(const OperatingPoint& point);
    const OperatingPoint& operating_point() const { return point_; }

    // The shell forwards its callbacks and processes to these functions.
    void end_of_elaboration();
    void start_of_simulation();
    void trace(sc_core::sc_trace_file* file) const;
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay);
    unsigned int debug(tlm::tlm_generic_payload& payload);
    void run();
    void drive_irq();
    void begin_stop();
    void resume_access() { gateway_.stalled().resume(); }
    const sc_core::sc_event& irq_changed() const { return irq_changed_; }
    const sc_core::sc_event& stop_requested() const { return stop_requested_; }
    const sc_core::sc_event& resume_requested() const { return resume_requested_; }

private:
    std::unique_ptr<AcceleratorConfig> checked(const AcceleratorConfig& config) const;
    const AcceleratorOptions& checked(const AcceleratorOptions& options) const;
    sc_core::sc_time checked_period() const;
    void follow_clock();
    void check(const OperatingPoint& point) const;
    std::optional<OperatingPoint> take_asked();
    void set_point(const OperatingPoint& point);
    void change_point();
    static tlm::tlm_response_status check_access(const tlm::tlm_generic_payload& payload);
    tlm::tlm_response_status write(std::uint32_t offset, std::uint32_t value,
                                   const sc_core::sc_time& delay);
    std::uint32_t read(std::uint32_t offset);
    void written(std::uint32_t offset, const sc_core::sc_time& delay);
    void command(std::uint32_t bits, const sc_core::sc_time& delay);
    void start(const sc_core::sc_time& delay);
    bool gates_idle() const { return (registers_.get(Register::Power) & kPowerGateIdle) != 0; }
    void await_command();

    /// Why the present frame, if there is one, is given up.
    enum class Stop { None, Abort, Reset };
    void request_stop(Stop why, const sc_core::sc_time& delay);
    void end_stop();
    void cut_off();
    void await_rest();
    void go_on(const std::optional<OperatingPoint>& point);
    bool held_in_reset() const { return shell_.reset_n.size() != 0 && !shell_.reset_n->read(); }

    AcceleratorFault serve();
    AcceleratorFault prepare();
    AcceleratorFault load();
    AcceleratorFault make_workload();
    std::uint64_t make_views(const GaussianCloud& cloud, const ProjectionOptions& options);
    AcceleratorFault lens_fault(const ProjectionOptions& options) const;
    AcceleratorFault render();
    void join_frame();
    void drop_images();
    void count_frame(const std::vector<Cycle>& finished, const MemoryTraffic& before);
    void show_energy();
    void show_view();
    void end_frame(const AcceleratorFault& fault);
    void set_status(std::uint32_t set, std::uint32_t clear);
    void show_fault();
    void clear_fault();

    Accelerator& shell_;
    std::unique_ptr<AcceleratorConfig> config_;
    AcceleratorOptions options_;
    ClockMapping mapping_;
    Timebase time_;
    AcceleratorRegisters registers_;
    struct { // for trace()
        bool busy = false, in_reset = false, irq = false;
    } lines_;
    AcceleratorRequest request_; // of the present frame
    SceneCopy scene_;
    bool scene_changed_ = false;
    std::vector<DrawnView> drawn_;       // of the present frame
    std::vector<FramePointer> workload_; // of each of them
    std::vector<MemoryBases> bases_;     // likewise
    std::vector<DrawnView> shown_;       // what registers tell of, of the last frame
    RenderJob job_;
    Process self_;
    DatedFifo<std::uint32_t> finished_;
    MemoryGateway gateway_;
    std::unique_ptr<RenderEngine> engine_;
    EnergyMeter meter_;
    OperatingPoint point_;                // in effect
    std::optional<OperatingPoint> asked_; // by the platform, and not in effect yet
    bool changes_ = false;                // asked_ does not wait for a frame
    bool started_ = false;                // a start waits for its date, or is being served
    Stop stop_ = Stop::None;
    sc_core::sc_time start_date_, stop_date_; // which may lie ahead of the kernel's time
    sc_core::sc_event work_;                  // wakes run(), which looks for what is due
    sc_core::sc_event stop_requested_, resume_requested_, irq_changed_;
};

} // namespace degs
