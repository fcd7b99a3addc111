// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <systemc>

#include "modules/render_job.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// Lets the front end start a frame when an earlier one has left the Pixel Buffers, so that only so
/// many frames have lists in memory. Exists only for runs of more frames than that.
class FrameGate : public sc_core::sc_module {
public:
    sc_core::sc_vector<FifoPort<std::uint32_t>> in;  ///< frames finished, one per Pixel Buffer
    sc_core::sc_vector<FifoPort<std::uint32_t>> out; ///< the same, once all have; one per listener

    FrameGate(const sc_core::sc_module_name& name, const Timebase& time, const RenderJob& job,
              std::size_t inputs, std::size_t listeners)
        : sc_core::sc_module(name), in("in", inputs), out("out", listeners), job_(job),
          self_(time) {
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
        for (std::uint32_t f = 0; f < job_.frames.size(); ++f) {
            for (auto& port : in) {
                port->get(self_);
            }
            for (auto& port : out) {
                port->put(self_, f);
            }
        }
        self_.finish();
    }

    const RenderJob& job_;
    Process self_;
};

} // namespace degs
