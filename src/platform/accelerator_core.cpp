// SPDX-License-Identifier: Apache-2.0
#include "platform/accelerator_core.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "degs/error.hpp"
#include "scene/cameras/eyes.hpp"
#include "splat/frame/projection.hpp"
#include "splat/frame/shared_colours.hpp"

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
      gateway_("gateway", options.memory, time_.clock), meter_(*config_, options.power) {
    point_.period = mapping_.period();
    gateway_.out.bind(shell_.mem);
    gateway_.observe_scene(
        [this](std::uint64_t address, const unsigned char* data, std::uint64_t bytes) {
            scene_changed_ = scene_changed_ || !scene_.matches(address, data, bytes);
        });
    gateway_.stalled().observe([this] { show_fault(); });
    job_ = make_render_job(*config_);
    job_.keeps_results = false;
    job_.is_open = true;
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
// A change of the operating point goes before a start, since it was asked for before it.
void AcceleratorCore::await_command() {
    for (;;) {
        const bool stops = stop_ != Stop::None;
        if (changes_ && !stops) {
            change_point();
            continue;
        }
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
    meter_.gate(gates_idle(), sc_core::sc_time_stamp());
    changes_ = asked_.has_value();
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
    meter_.forget_frame();
    show_energy();
    shown_.clear();
    show_view();
    if (request_.fault) {
        return request_.fault;
    }
    try {
        const sc_core::sc_time start = sc_core::sc_time_stamp();
        const AcceleratorFault fault = load();
        registers_.set_pair(Register::LoadCycles,
                            time_.clock.cycles_of(sc_core::sc_time_stamp() - start));
        return fault || stop_ != Stop::None ? fault : make_workload();
    } catch (const InputError&) { // a mistake that the checks of the registers let pass
        return {AcceleratorError::BadCamera, 0};
    } catch (const std::bad_alloc&) {
        return {AcceleratorError::OutOfMemory, 0};
    }
}

// Reads the table of views, if there is one, and the scene.
AcceleratorFault AcceleratorCore::load() {
    tlm::tlm_response_status answer = tlm::TLM_OK_RESPONSE;
    if (request_.table.entries != 0) {
        std::vector<unsigned char> table;
        answer = read_memory(gateway_, request_.table.address, request_.table.bytes(), table);
        if (answer == tlm::TLM_OK_RESPONSE && stop_ == Stop::None) {
            request_.read_table(table, options_.limits);
        }
    }
    if (request_.fault || stop_ != Stop::None) {
        return request_.fault;
    }
    if (answer == tlm::TLM_OK_RESPONSE) {
        answer = scene_.load(gateway_, request_.scene);
    }
    return answer == tlm::TLM_OK_RESPONSE || stop_ != Stop::None
               ? AcceleratorFault{}
               : AcceleratorFault{AcceleratorError::LoadError, detail_of(answer)};
}

// A lens that the design's projection cannot draw.
AcceleratorFault AcceleratorCore::lens_fault(const ProjectionOptions& options) const {
    for (const DrawnView& view : drawn_) {
        try {
            check_projection(view.level.camera, options);
        } catch (const InputError&) {
            return {AcceleratorError::BadCamera, detail_of_view(view.entry, ViewField::Lens)};
        }
    }
    return {};
}

// The frame joins the job only if all of it fits.
AcceleratorFault AcceleratorCore::make_workload() {
    // All frames of the job have ended. Some units are still busy with the last one when its pixels
    // are written, and lists may be kept from it.
    if (const std::size_t frames = job_.frames.size(); frames != 0) {
        job_.retire_before(job_.first_view_of(static_cast<std::uint32_t>(frames - 1)));
    }
    drawn_ = request_.drawn_views();
    shown_ = drawn_;
    show_view();
    std::uint32_t dropped = 0;
    const GaussianCloud cloud = scene_.cloud(dropped);
    const ProjectionOptions options = projection_of(config_->data_path(), options_.antialiased);
    registers_.set(Register::Dropped, dropped);
    if (const AcceleratorFault fault = lens_fault(options)) {
        return fault;
    }
    const std::uint64_t needed = make_views(cloud, options);
    registers_.set_pair(Register::WorkspaceNeeded, needed);
    if (request_.workspace_bytes < needed) {
        return {AcceleratorError::SmallWorkspace,
                AcceleratorRegisters::offset_of(Register::WorkspaceBytes)};
    }
    return {};
}

// The views that are drawn, and where their streams live. Returns the bytes of workspace that they
// take: each has a part, one behind the other.
std::uint64_t AcceleratorCore::make_views(const GaussianCloud& cloud,
                                          const ProjectionOptions& options) {
    std::vector<FrameWorkload> views;
    std::vector<Camera> cameras;
    for (const DrawnView& view : drawn_) {
        cameras.push_back(view.level.camera);
        views.push_back(make_frame_workload(cloud, cameras.back(), job_.tile_size,
                                            config_->tile_mode(), options));
    }
    std::uint64_t needed = 0;
    workload_.clear();
    bases_.assign(drawn_.size(), request_.bases);
    for (std::size_t v = 0; v < drawn_.size(); ++v) {
        if (drawn_.size() > 1 && config_->view_sharing() == ViewSharing::Colour) {
            shade_from(cloud, middle_of(cameras), views[v]);
        }
        bases_[v].ahead = needed;
        bases_[v].frame_buffer = drawn_[v].address;
        needed += MemoryMap::workspace_bytes(config_->records(), views[v]);
        workload_.push_back(std::make_shared<FrameWorkload>(std::move(views[v])));
    }
    return needed;
}

AcceleratorFault AcceleratorCore::render() {
    const MemoryTraffic before = gateway_.total();
    gateway_.clear_errors();
    scene_changed_ = false;
    self_.advance_to(time_.clock.ceil(sc_core::sc_time_stamp()));
    const Cycle started = self_.local();
    meter_.begin_frame(*engine_, time_.clock.at(started));
    join_frame();
    std::vector<Cycle> finished; // of each view
    while (finished.size() < drawn_.size()) {
        finished_.get(self_);
        finished.push_back(self_.local() - started);
    }
    self_.sync();
    if (stop_ == Stop::None) {
        count_frame(finished, before);
    }
    drop_images();
    if (stop_ != Stop::None) {
        return {};
    }
    if (gateway_.errors() != 0) {
        return {AcceleratorError::BusError, detail_of(gateway_.first_error())};
    }
    return scene_changed_ ? AcceleratorFault{AcceleratorError::SceneChanged, 0}
                          : AcceleratorFault{};
}

// Views that share nothing are frames of their own.
void AcceleratorCore::join_frame() {
    if (config_->view_sharing() != ViewSharing::Nothing) {
        job_.add_together(std::move(workload_), bases_);
    } else {
        for (std::size_t v = 0; v < drawn_.size(); ++v) {
            job_.add(std::move(workload_[v]), bases_[v]);
        }
    }
    workload_.clear();
    job_.joined->notify(sc_core::SC_ZERO_TIME);
}

// The pixels are in memory, or given up.
void AcceleratorCore::drop_images() {
    const std::size_t frames = job_.images.size();
    for (std::size_t f = frames - drawn_.size(); f < frames; ++f) {
        job_.images[f] = Image(0, 0);
    }
}

void AcceleratorCore::count_frame(const std::vector<Cycle>& finished, const MemoryTraffic& before) {
    const MemoryTraffic after = gateway_.total();
    const std::size_t first = job_.images.size() - drawn_.size();
    std::uint64_t fragments = 0;
    for (std::size_t v = 0; v < drawn_.size(); ++v) {
        for (const std::uint32_t updates : job_.images[first + v].fragments) {
            drawn_[v].fragments += updates;
        }
        drawn_[v].cycles = finished[v];
        fragments += drawn_[v].fragments;
    }
    shown_ = drawn_;
    show_view();
    meter_.end_frame(finished.back(), time_.clock.at(self_.local()));
    show_energy();
    registers_.set_pair(Register::Cycles, finished.back());
    registers_.set_pair(Register::BytesRead, after.bytes_read - before.bytes_read);
    registers_.set_pair(Register::BytesWritten, after.bytes_written - before.bytes_written);
    registers_.set_pair(Register::Fragments, fragments);
    registers_.set(Register::Frames, registers_.get(Register::Frames) + 1);
}

void AcceleratorCore::show_energy() {
    const auto whole = [](double nj) { return static_cast<std::uint64_t>(std::llround(nj)); };
    registers_.set_pair(Register::FrameEnergy, whole(meter_.frame_nj(*engine_)));
    registers_.set_pair(Register::IdleEnergy, whole(meter_.idle_nj()));
}

// What the registers from VIEWS_DRAWN on say of the view that VIEW selects.
void AcceleratorCore::show_view() {
    const std::uint32_t which = registers_.get(Register::View);
    const bool there = which < shown_.size();
    const DrawnView view = there ? shown_[which] : DrawnView();
    const Camera& camera = view.level.camera;
    const PixelBox& box = view.level.shown;
    const auto set = [this](Register to, int value) {
        registers_.set(to, static_cast<std::uint32_t>(value));
    };
    registers_.set(Register::ViewsDrawn, static_cast<std::uint32_t>(shown_.size()));
    registers_.set(Register::ViewEntry, view.entry);
    set(Register::ViewScale, there ? view.level.scale : 0);
    set(Register::ViewWidth, camera.width);
    set(Register::ViewHeight, camera.height);
    set(Register::ViewX, view.level.first.x);
    set(Register::ViewY, view.level.first.y);
    const std::uint32_t shown = AcceleratorRegisters::offset_of(Register::ViewShown);
    const int sides[] = {there ? box.x0 : 0, there ? box.y0 : 0, box.width(), box.height()};
    for (std::uint32_t i = 0; i < 4; ++i) {
        registers_.set_word(shown + 4 * i, static_cast<std::uint32_t>(sides[i]));
    }
    registers_.set_pair(Register::ViewAddress, view.address);
    registers_.set_pair(Register::ViewCycles, view.cycles);
    registers_.set_pair(Register::ViewFragments, view.fragments);
}

} // namespace degs
