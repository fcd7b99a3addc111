// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <systemc>

#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/render_job.hpp"
#include "tlm/has_process.hpp"

namespace degs {

/// Reports that all pixels of a frame are in memory: to the front end, which may then start another
/// frame, so that a limited number of frames have lists in memory, and to listeners that wait for
/// the image.
class FrameGate : public sc_core::sc_module {
public:
    /// Frame of each tile, one per Pixel Buffer, and of each background.
    sc_core::sc_vector<FifoPort<std::uint32_t>> in;
    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< finished frames; one per listener

    /// `reports`: messages per tile, i.e. Pixel Buffers that write a share of each; one more comes
    /// per frame, for its background.
    FrameGate(const sc_core::sc_module_name& name, const Timebase& time, RenderJob& job,
              std::size_t inputs, std::size_t listeners, std::uint64_t reports)
        : sc_core::sc_module(name), in("in", inputs), out("out", listeners), job_(job), self_(time),
          reports_(reports) {
        job_.ends.of_frame++;
        DEGS_HAS_PROCESS(FrameGate);
        SC_THREAD(run);
        self_.show(*this);
    }

private:
    void end_of_elaboration() override {
        for (auto& port : in) {
            port->connect_reader(self_);
        }
        for (auto& port : out) {
            port->connect_writer(self_);
        }
    }
    void run() {
        std::vector<FifoBase*> rings;
        for (auto& port : in) {
            rings.push_back(&port.ring());
        }
        for (std::uint32_t f = 0; job_.has_frame(self_, f); ++f) {
            const std::uint64_t expected = job_.tiles_of_frame[f] * reports_ + 1;
            while (seen(f) != expected) {
                self_.advance_to(
                    self_.next_arrival(rings.data(), rings.size(), self_.local(), kNever));
                take_reports();
            }
            for (auto& port : out) {
                port->put(self_, f);
            }
            seen_.drop_before(f + 1);
            job_.note_end(f);
        }
        self_.finish();
    }
    void take_reports() {
        for (auto& port : in) {
            while (self_.arrived(port.ring())) {
                seen(port->take(self_))++;
            }
        }
    }
    std::uint64_t& seen(std::uint32_t frame) {
        while (frame >= seen_.size()) {
            seen_.push_back(0);
        }
        return seen_[frame];
    }

    RenderJob& job_;
    Process self_;
    std::uint64_t reports_;
    KeptList<std::uint64_t> seen_; // reports, per frame
};

} // namespace degs
