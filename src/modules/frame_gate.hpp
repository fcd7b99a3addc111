// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "modules/pixel_buffer.hpp"
#include "modules/render_job.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// Lets the front end start a frame when an earlier one has left the Pixel Buffers, so that only so
/// many frames have lists in memory. Exists only for runs of more frames than that.
class FrameGate : public sc_core::sc_module {
public:
    sc_core::sc_vector<FifoPort<std::uint32_t>> in;  ///< frame of each tile, one per Pixel Buffer
    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< finished frames; one per listener

    /// `reports`: messages per tile, i.e. Pixel Buffers that write a share of each.
    FrameGate(const sc_core::sc_module_name& name, const Timebase& time, const RenderJob& job,
              std::size_t inputs, std::size_t listeners, std::uint64_t reports)
        : sc_core::sc_module(name), in("in", inputs), out("out", listeners), self_(time),
          missing_(job.frames.size(), 0) {
        for (const JobTile& tile : job.tiles) {
            missing_[tile.frame] += reports;
        }
        SC_HAS_PROCESS(FrameGate);
        SC_THREAD(run);
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
            rings.push_back(port.operator->());
        }
        for (std::uint32_t f = 0; f < missing_.size(); ++f) {
            while (missing_[f] != 0) {
                self_.advance_to(
                    self_.next_arrival(rings.data(), rings.size(), self_.local(), kNever));
                take_reports();
            }
            for (auto& port : out) {
                port->put(self_, f);
            }
        }
        self_.finish();
    }
    void take_reports() {
        for (auto& port : in) {
            while (self_.arrived(*port.operator->())) {
                missing_[port->take(self_)]--;
            }
        }
    }

    Process self_;
    std::vector<std::uint64_t> missing_; // reports, per frame
};

/// The gate of an accelerator with its rings: from every Pixel Buffer to every block of the front
/// end that waits for frames. Nothing where nobody waits: in runs of no more frames than may be in
/// flight.
class FrameGating {
public:
    /// `reports`: see FrameGate.
    void build(const Timebase& time, const RenderJob& job,
               const std::vector<std::unique_ptr<PixelBuffer>>& buffers,
               sc_core::sc_vector<FifoPort<std::uint32_t>>& listeners, std::uint64_t reports);

private:
    std::unique_ptr<FrameGate> gate_;
    std::vector<std::unique_ptr<DatedFifo<std::uint32_t>>> rings_;
};

} // namespace degs
