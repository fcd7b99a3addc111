// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/kit/config/frame_end_config.hpp"
#include "modules/kit/engine/collect.hpp"
#include "modules/kit/front_end/frame_gate.hpp"
#include "modules/kit/memory/memory_streams.hpp"
#include "modules/kit/memory/stream_kinds.hpp"
#include "modules/kit/pixels/background_writer.hpp"

namespace degs {

/// The end of a frame, which every accelerator has besides its Pixel Buffers: the Background Writer
/// and, where somebody waits for finished frames, the Frame Gate with its rings.
class FrameEnds {
public:
    /// True if anybody waits. The Pixel Buffers must then have their port `frame_done`.
    static bool awaited(const sc_core::sc_vector<FifoPort<std::uint32_t>>& listeners,
                        const BuildOptions& options) {
        return listeners.size() != 0 || options.finished != nullptr;
    }

    /// The messages between a front end and the end of a frame.
    struct FrontEnd {
        sc_core::sc_vector<FifoPort<std::uint32_t>>& frame_free; ///< wait for finished frames
        sc_core::sc_vector<FifoPort<std::uint32_t>>& listed;     ///< frames with all lists
    };

    /// `reports`: see FrameGate.
    void build(const FrameEndConfig& config, const Timebase& time, const TrafficConfig& traffic,
               RenderJob& job, const PixelBuffers& buffers, const FrontEnd& front_end,
               std::uint64_t reports, const BuildOptions& options);
    void connect_memory(MemoryStreams& streams) {
        streams.connect(background_->frame_buffer, stream_kinds::kFrameBuffer);
    }
    const BackgroundWriter& background() const { return *background_; }

private:
    std::unique_ptr<BackgroundWriter> background_;
    std::unique_ptr<FrameGate> gate_;
    std::vector<std::unique_ptr<DatedFifo<std::uint32_t>>> rings_;
};

} // namespace degs
