// SPDX-License-Identifier: Apache-2.0
// Frames of several views: a host that writes tables of views, and the same job without a platform
// on the same memory.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "degs/degs_driver.h"
#include "scene/cameras/eyes.hpp"
#include "splat/frame/shared_colours.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {

constexpr std::uint64_t kTable = 0x30000;

inline degs_camera driver_camera(const Camera& camera) {
    degs_camera view{};
    view.width = static_cast<std::uint32_t>(camera.width);
    view.height = static_cast<std::uint32_t>(camera.height);
    view.focal_x = camera.fx;
    view.focal_y = camera.fy;
    for (int i = 0; i < 9; ++i) {
        view.axes[i] = camera.camera_to_world[i / 3][i % 3];
        view.position[i % 3] = camera.position[i % 3];
    }
    return view;
}

/// The view as the driver in C takes it.
inline degs_view driver_view(const RequestedView& asked) {
    degs_view view{};
    const Camera& camera = asked.camera;
    view.frame_buffer = asked.frame_buffer;
    view.camera = driver_camera(camera);
    view.window = {camera.shift.x, camera.shift.y, static_cast<std::uint32_t>(camera.origin.x),
                   static_cast<std::uint32_t>(camera.origin.y)};
    const LensCoefficients& lens = camera.lens.coefficients();
    view.lens.kind = static_cast<std::uint32_t>(lens.kind);
    std::copy(lens.radial.begin(), lens.radial.end(), view.lens.radial);
    std::copy(lens.denominator.begin(), lens.denominator.end(), view.lens.denominator);
    std::copy(lens.tangential.begin(), lens.tangential.end(), view.lens.tangential);
    if (asked.foveation) {
        view.gaze = {asked.foveation->centre.x, asked.foveation->centre.y, asked.foveation->fovea,
                     asked.foveation->periphery};
    }
    return view;
}

/// The bytes of a table of views.
inline std::vector<unsigned char> table_of(const std::vector<RequestedView>& views) {
    std::vector<unsigned char> bytes(views.size() * kViewBytes);
    for (std::size_t v = 0; v < views.size(); ++v) {
        const degs_view view = driver_view(views[v]);
        degs_encode_view(&view, bytes.data() + v * kViewBytes);
    }
    return bytes;
}

/// Writes the registers of a frame whose views are in the table at kTable.
inline void program_views(Host& host, const GaussianCloud& cloud, std::size_t views) {
    program(host, cloud, Camera());
    host.write_pair(Register::Views, kTable);
    host.write(Register::ViewCount, static_cast<std::uint32_t>(views));
}

/// What registers say of a drawn view.
struct SeenView {
    std::uint32_t entry = 0, scale = 0;
    std::uint64_t address = 0;
    std::vector<std::uint32_t> sides; ///< width, height, x, y, and what it shows
    std::uint64_t cycles = 0, fragments = 0;

    bool operator==(const SeenView& other) const {
        return entry == other.entry && scale == other.scale && address == other.address &&
               sides == other.sides && cycles == other.cycles && fragments == other.fragments;
    }
};

inline std::vector<SeenView> seen_views(Host& host) {
    std::vector<SeenView> all(host.read(Register::ViewsDrawn));
    for (std::uint32_t v = 0; v < all.size(); ++v) {
        host.write(Register::View, v);
        SeenView& view = all[v];
        view.entry = host.read(Register::ViewEntry);
        view.scale = host.read(Register::ViewScale);
        view.address = host.read_pair(Register::ViewAddress);
        for (const Register side :
             {Register::ViewWidth, Register::ViewHeight, Register::ViewX, Register::ViewY}) {
            view.sides.push_back(host.read(side));
        }
        for (std::uint32_t i = 0; i < 4; ++i) {
            view.sides.push_back(host.read(Register::ViewShown, i));
        }
        view.cycles = host.read_pair(Register::ViewCycles);
        view.fragments = host.read_pair(Register::ViewFragments);
    }
    return all;
}

/// Views side by side with pixels one behind the other from `from` on.
inline void place(std::vector<RequestedView>& views, int pixel_bytes = 4,
                  std::uint64_t from = kFrame) {
    for (RequestedView& view : views) {
        view.frame_buffer = from;
        for (const FoveatedLevel& level : view.levels()) {
            from += (level.camera.pixels() * pixel_bytes + 63) / 64 * 64;
        }
    }
}

/// The job of these views as a run has it, with the addresses that the accelerator takes, on a
/// memory of its own of the same latency.
class ClosedViews : public sc_core::sc_module {
public:
    ClosedViews(const sc_core::sc_module_name& name, const AcceleratorConfig& config,
                const GaussianCloud& cloud, const std::vector<RequestedView>& views,
                int pixel_bytes = 4, bool antialiased = false)
        : sc_core::sc_module(name),
          memory("memory", kMemoryBytes, Timing::Annotated), time_{ClockDomain(config.clock_ghz)},
          gateway_("gateway", MemoryGateway::Options(), time_.clock), reader_(time_),
          finished_("finished", time_, 64, config.frame_end.gate_latency_cycles),
          job_(make_render_job(config)) {
        AcceleratorRequest request;
        request.bases.pixel_bytes = pixel_bytes;
        request.views = views;
        drawn = request.drawn_views();
        make_frames(config, cloud, antialiased, pixel_bytes);
        gateway_.out.bind(memory.in);
        BuildOptions build;
        build.memory = &gateway_;
        build.finished = &finished_;
        engine_ = config.build("engine", time_, job_, build);
        memory.put_scene(cloud);
        DEGS_HAS_PROCESS(ClosedViews);
        SC_THREAD(run);
    }

    std::vector<DrawnView> drawn;
    std::vector<Cycle> finished; ///< of each drawn view
    PlainMemory memory;
    const Image& image(std::size_t view) const { return job_.images[view]; }
    /// What a run reports of them, when nothing is left to happen.
    AcceleratorResult result() const {
        AcceleratorResult result;
        engine_->collect(result);
        return result;
    }
    std::uint64_t fragments(std::size_t view) const {
        std::uint64_t sum = 0;
        for (const std::uint32_t updates : image(view).fragments) {
            sum += updates;
        }
        return sum;
    }

private:
    void end_of_elaboration() override { finished_.connect_reader(reader_); }
    void run() {
        while (finished.size() < drawn.size()) {
            finished_.get(reader_);
            finished.push_back(reader_.local());
        }
        reader_.finish();
    }
    void make_frames(const AcceleratorConfig& config, const GaussianCloud& cloud, bool antialiased,
                     int pixel_bytes) {
        std::vector<MemoryBases> bases;
        std::vector<Camera> cameras;
        std::uint64_t ahead = 0;
        for (const DrawnView& view : drawn) {
            cameras.push_back(view.level.camera);
            frames_.push_back(make_frame_workload(cloud, cameras.back(), config.tile_size_px(),
                                                  config.tile_mode(),
                                                  projection_of(config.data_path(), antialiased)));
            bases.push_back({true, 0, kSh, kWorkspace, ahead, view.address, pixel_bytes});
            ahead += MemoryMap::workspace_bytes(config.records(), frames_.back());
        }
        std::vector<FramePointer> group;
        for (FrameWorkload& frame : frames_) {
            if (frames_.size() > 1 && config.view_sharing() == ViewSharing::Colour) {
                shade_from(cloud, middle_of(cameras), frame);
            }
            group.push_back(borrowed(frame));
        }
        if (config.view_sharing() != ViewSharing::Nothing) {
            job_.add_together(group, bases);
            return;
        }
        for (std::size_t v = 0; v < group.size(); ++v) {
            job_.add(group[v], bases[v]);
        }
    }

    Timebase time_;
    MemoryGateway gateway_;
    Process reader_;
    DatedFifo<std::uint32_t> finished_;
    std::vector<FrameWorkload> frames_;
    RenderJob job_;
    std::unique_ptr<RenderEngine> engine_;
};

} // namespace degs::test
