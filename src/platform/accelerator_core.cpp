// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_core.hpp"

#include <algorithm>
#include <new>

#include "degs/error.hpp"

namespace degs {
namespace {

constexpr std::size_t kFinishedDepth = 64;

// The answer of a bus as a positive number: 1 address, 2 command, 3 burst, 4 byte enable error,
// 5 generic error, 6 no answer.
std::uint32_t detail_of(tlm::tlm_response_status status) {
    switch (status) {
    case tlm::TLM_ADDRESS_ERROR_RESPONSE:
        return 1;
    case tlm::TLM_COMMAND_ERROR_RESPONSE:
        return 2;
    case tlm::TLM_BURST_ERROR_RESPONSE:
        return 3;
    case tlm::TLM_BYTE_ENABLE_ERROR_RESPONSE:
        return 4;
    case tlm::TLM_INCOMPLETE_RESPONSE:
        return 6;
    default:
        return 5;
    }
}

} // namespace

AcceleratorCore::AcceleratorCore(Accelerator& shell, const AcceleratorConfig& config,
                                 const AcceleratorOptions& options)
    : shell_(shell), config_(checked(config)), options_(checked(options)),
      mapping_(checked_period()), time_{ClockDomain(mapping_), options.fidelity, options.timeline},
      self_(time_),
      finished_("finished", time_, kFinishedDepth, config_->frame_end.gate_latency_cycles),
      gateway_("gateway", options.memory, time_.clock) {
    gateway_.out.bind(shell_.mem);
    gateway_.observe_scene(
        [this](std::uint64_t address, const unsigned char* data, std::uint64_t bytes) {
            scene_changed_ = scene_changed_ || !scene_.matches(address, data, bytes);
        });
    gateway_.stalled().observe([this] { show_fault(); });
    job_ = make_render_job(*config_);
    job_.keeps_results = false;
    job_.joined = std::make_unique<sc_core::sc_event>();
    if (options.timeline != nullptr) {
        job_.recorder = std::make_unique<SlotRecorder>(options.timeline);
    }
    BuildOptions build;
    build.finished = &finished_;
    build.memory = &gateway_;
    engine_ = config_->build("engine", time_, job_, build);
}

void AcceleratorCore::complete_timeline() {
    if (job_.recorder != nullptr) {
        job_.recorder->close();
    }
}

void AcceleratorCore::drive_irq() {
    lines_.irq = (registers_.get(Register::IrqEnable) & registers_.get(Register::IrqStatus)) != 0;
    if (shell_.irq.size() != 0) {
        shell_.irq->write(lines_.irq);
    }
}

void AcceleratorCore::set_status(std::uint32_t set, std::uint32_t clear) {
    const std::uint32_t status = (registers_.get(Register::Status) & ~clear) | set;
    registers_.set(Register::Status, status);
    lines_.busy = (status & kStatusBusy) != 0;
    lines_.in_reset = (status & kStatusInReset) != 0;
}

// Shows the access that waits longest, unless the frame is being given up anyway.
void AcceleratorCore::show_fault() {
    if (stop_ != Stop::None) {
        return;
    }
    const AccessFault& fault = *gateway_.stalled().oldest();
    registers_.set_pair(Register::FaultAddress, fault.address);
    registers_.set(Register::FaultStream, static_cast<std::uint32_t>(fault.stream));
    registers_.set(Register::FaultAnswer, detail_of(fault.answer));
    set_status(kStatusFaulted, 0);
    registers_.set(Register::IrqStatus, registers_.get(Register::IrqStatus) | kIrqFault);
    irq_changed_.notify(sc_core::SC_ZERO_TIME);
}

// Forgets the fault of a frame before.
void AcceleratorCore::clear_fault() {
    registers_.set_pair(Register::FaultAddress, 0);
    registers_.set(Register::FaultStream, 0);
    registers_.set(Register::FaultAnswer, 0);
}

// A start or a stop may have come before this process first ran, and its date may still be ahead.
void AcceleratorCore::await_command() {
    for (;;) {
        const bool stops = stop_ != Stop::None;
        const sc_core::sc_time due = stops ? stop_date_ : start_date_;
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        if (!started_ && !stops) {
            sc_core::wait(work_);
        } else if (due > now) {
            sc_core::wait(due - now, work_);
        } else {
            return;
        }
    }
}

void AcceleratorCore::run() {
    for (;;) {
        await_command();
        const AcceleratorFault fault = stop_ == Stop::None ? serve() : AcceleratorFault{};
        started_ = false;
        if (stop_ == Stop::None) {
            end_frame(fault);
        } else {
            end_stop();
        }
    }
}

// A stop while the scene is loaded leaves a copy that is of no use.
AcceleratorFault AcceleratorCore::serve() {
    const AcceleratorFault fault = prepare();
    return fault || stop_ != Stop::None ? fault : render();
}

void AcceleratorCore::end_frame(const AcceleratorFault& fault) {
    registers_.set(Register::ErrorCode, static_cast<std::uint32_t>(fault.error));
    registers_.set(Register::ErrorDetail, fault.detail);
    set_status(fault ? kStatusError : kStatusDone, kStatusBusy);
    registers_.set(Register::IrqStatus,
                   registers_.get(Register::IrqStatus) | (fault ? kIrqError : kIrqDone));
    irq_changed_.notify(sc_core::SC_ZERO_TIME);
}

AcceleratorFault AcceleratorCore::prepare() {
    for (const Register counter :
         {Register::Cycles, Register::LoadCycles, Register::BytesRead, Register::BytesWritten,
          Register::Fragments, Register::WorkspaceNeeded}) {
        registers_.set_pair(counter, 0);
    }
    registers_.set(Register::Dropped, 0);
    if (request_.fault) {
        return request_.fault;
    }
    try {
        const sc_core::sc_time start = sc_core::sc_time_stamp();
        const auto answer = scene_.load(gateway_, request_.scene);
        registers_.set_pair(Register::LoadCycles,
                            time_.clock.cycles_of(sc_core::sc_time_stamp() - start));
        if (stop_ != Stop::None) {
            return {};
        }
        if (answer != tlm::TLM_OK_RESPONSE) {
            return {AcceleratorError::LoadError, detail_of(answer)};
        }
        return make_workload();
    } catch (const InputError&) { // a mistake that the checks of the registers let pass
        return {AcceleratorError::BadCamera, 0};
    } catch (const std::bad_alloc&) {
        return {AcceleratorError::OutOfMemory, 0};
    }
}

// The frame joins the job only if all of it fits.
AcceleratorFault AcceleratorCore::make_workload() {
    // All frames of the job have ended. Some units are still busy with the last one when its pixels
    // are written, and lists may be kept from it.
    if (const std::size_t frames = job_.frames.size(); frames != 0) {
        job_.retire_before(static_cast<std::uint32_t>(frames - 1));
    }
    std::uint32_t dropped = 0;
    const GaussianCloud cloud = scene_.cloud(dropped);
    const ProjectionOptions options = projection_of(config_->data_path(), options_.antialiased);
    FrameWorkload work =
        make_frame_workload(cloud, request_.camera, job_.tile_size, config_->tile_mode(), options);
    registers_.set(Register::Dropped, dropped);
    const std::uint64_t needed = MemoryMap::workspace_bytes(config_->records(), work);
    registers_.set_pair(Register::WorkspaceNeeded, needed);
    if (request_.workspace_bytes < needed) {
        return {AcceleratorError::SmallWorkspace,
                AcceleratorRegisters::offset_of(Register::WorkspaceBytes)};
    }
    workload_ = std::make_shared<FrameWorkload>(std::move(work));
    return {};
}

AcceleratorFault AcceleratorCore::render() {
    const MemoryTraffic before = gateway_.total();
    gateway_.clear_errors();
    scene_changed_ = false;
    self_.advance_to(time_.clock.ceil(sc_core::sc_time_stamp()));
    const Cycle started = self_.local();
    job_.add(std::move(workload_), request_.bases);
    job_.joined->notify(sc_core::SC_ZERO_TIME);
    finished_.get(self_);
    self_.sync();
    if (stop_ != Stop::None) {
        job_.images.back() = Image(0, 0);
        return {};
    }
    count_frame(started, before);
    if (gateway_.errors() != 0) {
        return {AcceleratorError::BusError, detail_of(gateway_.first_error())};
    }
    return scene_changed_ ? AcceleratorFault{AcceleratorError::SceneChanged, 0}
                          : AcceleratorFault{};
}

void AcceleratorCore::count_frame(Cycle started, const MemoryTraffic& before) {
    const MemoryTraffic after = gateway_.total();
    std::uint64_t fragments = 0;
    for (const std::uint32_t updates : job_.images.back().fragments) {
        fragments += updates;
    }
    job_.images.back() = Image(0, 0); // the pixels are in memory
    registers_.set_pair(Register::Cycles, self_.local() - started);
    registers_.set_pair(Register::BytesRead, after.bytes_read - before.bytes_read);
    registers_.set_pair(Register::BytesWritten, after.bytes_written - before.bytes_written);
    registers_.set_pair(Register::Fragments, fragments);
    registers_.set(Register::Frames, registers_.get(Register::Frames) + 1);
}

} // namespace degs
