// SPDX-License-Identifier: Apache-2.0
// Builds the part of a back end from the crossbar to the Pixel Buffer.
#include <algorithm>

#include "modules/degs/back_end.hpp"
#include "modules/degs/span_engine/span_unit.hpp"
#include "modules/kit/engine/frame_ends.hpp"
#include "modules/kit/job/row_map.hpp"

namespace degs {

void DegsBackEnd::build_scheduler() {
    const int banks = config_.scheduler.banks;
    const IssueBank::Config bank = config_.issue_bank(first_context());
    const PackingUnit::Config packing = config_.packing_unit();
    next_span_port_.assign(spans_.size(), 0);
    for (int b = 0; b < banks; ++b) {
        packing_.add(
            std::make_unique<PackingUnit>(numbered("packing", packing_.size()).c_str(), packing));
        banks_.add(std::make_unique<IssueBank>(
            numbered("bank", banks_.size()).c_str(), bank, time_, job_, packing_.back(), b,
            reachable(b, banks, config_.span.modules()), config_.contexts_per_stream()));
        connect_crossbar(b);
    }
}

// A queue whose room others ask for shows it in the cycle after, so that the answer is certain.
void DegsBackEnd::connect_crossbar(int bank) {
    const int modules = config_.span.modules();
    const int release = config_.spans_are_pooled() ? 1 : 0;
    const std::size_t inputs = banks_[bank]->in.size() / config_.streams();
    std::size_t input = 0;
    for (int u = 0; u < modules; ++u) {
        if (!shares_row(u, modules, bank, config_.scheduler.banks)) {
            continue;
        }
        const std::size_t ports = spans_[u]->out.size() / config_.streams();
        for (int m = 0; m < config_.streams(); ++m) {
            auto& vectors = ring(crossbar_rings_, "crossbar", config_.crossbar_cells(),
                                 config_.span.latency_cycles, release);
            spans_[u]->out[m * ports + next_span_port_[u]].bind(vectors);
            banks_[bank]->in[m * inputs + input].bind(vectors);
        }
        if (inputs == 1) {
            banks_[bank]->read_from(*spans_[u]);
        }
        ++next_span_port_[u];
        ++input;
    }
}

void DegsBackEnd::build_array() {
    const ArraySlice::Config slice = config_.array_slice(first_context());
    next_region_port_.assign(slicing_.size(), 0);
    for (int b = 0; b < config_.scheduler.banks; ++b) {
        slices_.add(std::make_unique<ArraySlice>(numbered("slice", slices_.size()).c_str(), slice,
                                                 time_, job_, b, config_.scheduler.banks,
                                                 config_.scheduler.segment_length));
        connect_slice(b);
    }
}

void DegsBackEnd::connect_slice(int bank) {
    const std::size_t b = bank;
    const int writeback = config_.array.writeback_cycles;
    // The end of a tile takes no room of the Packing Buffer, but a cell of its ring. At most one of
    // every tile in flight waits there. As many packets as the latency has cycles are in the
    // pipeline.
    const int latency = config_.packing.latency_cycles;
    const int tile_ends = std::max(4, config_.contexts());
    auto& packets = ring(packing_rings_, "packing_buffer",
                         config_.packing_depth() + latency + tile_ends, latency);
    SlotPart* const part = job_.record_part(config_.array.pes_per_bank);
    packing_[b]->record(part);
    slices_[b]->record(part);
    packing_[b]->out.bind(packets);
    slices_[b]->in.bind(packets);
    if (functional_ != nullptr) {
        packing_[b]->tell(*slices_[b], time_.timeline != nullptr);
        slices_[b]->expect_replay();
    }
    auto& terminations = wire(termination_rings_, "terminations", writeback);
    slices_[b]->terminated.bind(terminations);
    banks_[b]->terminated.bind(terminations);
    if (config_.slicing.skip_dead_rows) {
        connect_region_feedback(bank);
    }
    const std::size_t parts = pixel_buffers_.size() / config_.streams(); // of a stream
    for (int m = 0; m < config_.streams(); ++m) {
        auto& done = wire(done_rings_, "tile_done", writeback);
        slices_[b]->tile_done[m].bind(done);
        PixelBuffer& pixels = *pixel_buffers_[m * parts + b % parts];
        pixels.in[b / parts].bind(done);
        auto& state = wire(state_rings_, "tile_state", writeback);
        slices_[b]->tile_state[m].bind(state);
        monitors_[m]->in[b].bind(state);
        auto& contexts = wire(context_rings_, "context_free", config_.pixel_buffer.free_cycles);
        pixels.context_free[b / parts].bind(contexts);
        banks_[b]->context_free[m].bind(contexts);
    }
}

// A share of the Pixel Buffer is read out at its share of the rate.
void DegsBackEnd::build_pixel_buffers() {
    const int banks = config_.scheduler.banks;
    const bool banked = config_.pixel_buffer.release == ContextRelease::Bank;
    const int parts = banked ? banks : 1;
    PixelBuffer::Config config = config_.pixel_buffer;
    config.readout_pixels = std::max(1, config.readout_pixels / config_.streams());
    for (int i = 0; i < config_.streams() * parts; ++i) {
        PixelBuffer::Share share;
        share.first_row = i % parts;
        share.row_stride = parts;
        share.first_context = first_context() + i / parts * config_.contexts_per_stream();
        share.granted = config_.granted();
        pixel_buffers_.add(std::make_unique<PixelBuffer>(
            numbered("pixel_buffer", pixel_buffers_.size()).c_str(), config, config_.traffic, time_,
            job_, banks / parts, config_.contexts_per_stream(), share,
            FrameEnds::awaited(front_end_.frame_free, options_), options_.array_only));
        if (functional_ != nullptr) {
            pixel_buffers_.back().read_from(*functional_);
        }
    }
}

void DegsBackEnd::connect_region_feedback(int slice) {
    const int listeners = config_.slicing.modules();
    std::size_t port = 0;
    for (std::size_t i = 0; i < slicing_.size(); ++i) {
        const int g = static_cast<int>(i) % listeners;
        if (shares_row(slice, config_.scheduler.banks, g, listeners)) {
            auto& rows = wire(region_rings_, "region_ended", config_.slicing.feedback_cycles);
            slices_[slice]->region_ended[port++].bind(rows);
            slicing_[i]->region_ended[next_region_port_[i]++].bind(rows);
        }
    }
}

} // namespace degs
