// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/frame_ends.hpp"
#include "tlm/rings.hpp"

namespace degs {

void FrameEnds::build(const FrameEndConfig& config, const Timebase& time,
                      const TrafficConfig& traffic, RenderJob& job, const PixelBuffers& buffers,
                      const FrontEnd& front_end, std::uint64_t reports,
                      const BuildOptions& options) {
    auto& listeners = front_end.frame_free;
    const bool gated = awaited(listeners, options);
    job.ends.of_tile = reports;
    background_ = std::make_unique<BackgroundWriter>("background", traffic, time, job,
                                                     config.background_cycles_per_write, gated,
                                                     options.array_only);
    for (std::size_t i = 0; i < background_->listed.size(); ++i) {
        auto& listed = add_wire(rings_, "listed", time, 1);
        front_end.listed[i].bind(listed);
        background_->listed[i].bind(listed);
    }
    if (!gated) {
        return;
    }
    const std::size_t waiting = listeners.size() + (options.finished != nullptr ? 1 : 0);
    gate_ =
        std::make_unique<FrameGate>("frame_gate", time, job, buffers.size() + 1, waiting, reports);
    for (std::size_t i = 0; i <= buffers.size(); ++i) {
        auto& done = add_wire(rings_, "frame_done", time, 1);
        auto& reporter =
            i < buffers.size() ? buffers[i]->frame_done[0] : background_->frame_done[0];
        reporter.bind(done);
        gate_->in[i].bind(done);
    }
    for (std::size_t i = 0; i < listeners.size(); ++i) {
        auto& free = add_wire(rings_, "frame_free", time, config.gate_latency_cycles);
        gate_->out[i].bind(free);
        listeners[i].bind(free);
    }
    if (options.finished != nullptr) {
        gate_->out[listeners.size()].bind(*options.finished);
    }
}

} // namespace degs
