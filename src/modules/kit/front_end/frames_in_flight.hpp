// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "tlm/process.hpp"

namespace degs {

/// Holds back a frame until the one so many frames before it has ended. The views of a frame that
/// are read together are one frame here; the Frame Gate reports each of them.
class FramesInFlight {
public:
    /// `limit`: frames; 0: none is held back.
    explicit FramesInFlight(std::size_t limit) : limit_(limit) {}

    /// The process begins a frame of `views` views; `ended` has the port to the Frame Gate.
    void begin(std::uint32_t views, sc_core::sc_vector<FifoPort<std::uint32_t>>& ended,
               Process& process) {
        if (limit_ == 0) {
            return;
        }
        if (views_.size() == limit_) {
            for (std::uint32_t v = 0; v < views_.front(); ++v) {
                ended[0]->get(process);
            }
            views_.pop_front();
        }
        views_.push_back(views);
    }

private:
    std::size_t limit_;
    std::deque<std::uint32_t> views_; // of each frame whose end has not been waited for
};

} // namespace degs
