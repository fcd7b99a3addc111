// SPDX-License-Identifier: Apache-2.0
#include "modules/frame_gate.hpp"

#include "modules/collect.hpp"

namespace degs {

void FrameGating::build(const Timebase& time, const RenderJob& job,
                        const std::vector<std::unique_ptr<PixelBuffer>>& buffers,
                        sc_core::sc_vector<FifoPort<std::uint32_t>>& listeners,
                        std::uint64_t reports) {
    if (listeners.size() == 0) {
        return;
    }
    constexpr int kDepth = 64; // one message per tile: more than can wait for the gate
    gate_ = std::make_unique<FrameGate>("frame_gate", time, job, buffers.size(), listeners.size(),
                                        reports);
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        auto& done = add_ring(rings_, "frame_done", time, kDepth, 1);
        buffers[i]->frame_done[0].bind(done);
        gate_->in[i].bind(done);
    }
    for (std::size_t i = 0; i < listeners.size(); ++i) {
        auto& free = add_ring(rings_, "frame_free", time, kDepth, 1);
        gate_->out[i].bind(free);
        listeners[i].bind(free);
    }
}

} // namespace degs
