// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/vector_unit.hpp"

#include "splat/frame/pixel_mask.hpp"
#include "tlm/ceil_div.hpp"

namespace degs::orange {

void VectorUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("lanes", lanes, 1, 65536, "elements per cycle and core (ORANGE: 512)");
    visitor.integer("coefficient_operations", coefficient_operations, 0, 1024,
                    "element operations that form the coefficients of a splat for a tile: 10 "
                    "products, 7 sums; 0 with gemm.origin image [assumed]");
    visitor.integer("blend_operations", blend_operations, 1, 1024,
                    "element operations per pixel of a product: exponential, limit, alpha test, "
                    "transmittance, its test, weight, three colours, mask [assumed]");
    visitor.integer(
        "latency_cycles", latency_cycles, 0, 4096,
        "cycles from the last operation of a tile to its pixels written back [assumed]");
    visitor.choice("termination", termination, {"batch", "none"},
                   "batch: a tile is left after the batch in which its last pixel ends; none: "
                   "lists are blended to their end");
}

Cycle VectorUnit::Config::coefficient_cycles(std::uint64_t splats) const {
    return ceil_div(splats * coefficient_operations, lanes);
}

Cycle VectorUnit::Config::blend_cycles(std::uint64_t pixels) const {
    return ceil_div(pixels * blend_operations, lanes);
}

VectorUnit::VectorUnit(const sc_core::sc_module_name& name, const Config& config,
                       const Timebase& time, RenderJob& job, int macs, int first_context,
                       int contexts)
    : sc_core::sc_module(name), in("in"), context_free("context_free"),
      coefficients("coefficients"), products("products"), tile_done("tile_done"),
      tile_state("tile_state"), config_(config), job_(job), first_context_(first_context),
      contexts_(contexts), self_(time), account_(job, macs), outcomes_(job.tile_size) {
    SC_HAS_PROCESS(VectorUnit);
    SC_THREAD(run);
    self_.show(*this, stats_.busy);
}

void VectorUnit::end_of_elaboration() {
    in->connect_reader(self_);
    context_free->connect_reader(self_);
    coefficients->connect_writer(self_);
    products->connect_reader(self_);
    tile_done->connect_writer(self_);
    tile_state->connect_writer(self_);
}

void VectorUnit::run() {
    for (bool more = true; more;) {
        if (blends_next()) {
            blend_product();
        } else {
            more = take_chunk();
        }
    }
    coefficients->put(self_, {kNoTile});
    tile_done->put(self_, {kNoTile, false});
    tile_state->put(self_, {kNoTile, false});
    self_.finish();
}

/// False if the next step is a chunk, or the end of them. A unit whose coefficients have no room
/// has a product to wait for; with room it takes what comes first.
bool VectorUnit::blends_next() {
    if (batches_ahead_ == 0) {
        return false;
    }
    if (input_over_ || !coefficients->has_room(self_)) {
        return true;
    }
    FifoBase* const inputs[] = {&products.ring(), &in.ring()};
    const Cycle ready = self_.local();
    self_.advance_to(self_.next_arrival(inputs, 2, ready, kNever));
    if (self_.arrived(products.ring())) {
        return true;
    }
    in.ring().count_late(ready);
    return false;
}

/// Takes a chunk of splats. False if no chunk follows and no product is on its way.
bool VectorUnit::take_chunk() {
    if (input_over_) {
        return false;
    }
    const SplatChunk& chunk = in->arrive(self_);
    if (chunk.tile == kNoTile) {
        input_over_ = true;
    } else if (chunk.tile == ended_) {
        stats_.splats_abandoned += chunk.count;
        self_.advance();
    } else {
        form_coefficients(chunk);
    }
    in->drop(self_);
    return true;
}

void VectorUnit::form_coefficients(const SplatChunk& chunk) {
    const Cycle cycles = config_.coefficient_cycles(chunk.count);
    stats_.coefficient_cycles += cycles;
    stats_.splats += chunk.count;
    self_.work(cycles, stats_.busy);
    GemmBatch batch;
    batch.tile = chunk.tile;
    batch.first = chunk.first;
    batch.splats = chunk.count;
    batch.last = chunk.last;
    coefficients->put(self_, batch);
    ++batches_ahead_;
}

void VectorUnit::blend_product() {
    const GemmBatch batch = products->arrive(self_);
    const std::uint64_t pixels = std::uint64_t{batch.splats} * job_.tile_size * job_.tile_size;
    if (batch.tile == ended_) {
        stats_.splats_wasted += batch.splats;
        account_.add(batch, {0, 0, pixels});
        self_.advance();
    } else {
        if (batch.tile != number_) {
            start_tile(batch.tile);
        }
        const Cycle cycles = config_.blend_cycles(pixels);
        stats_.blend_cycles += cycles;
        stats_.splats_blended += batch.splats;
        self_.work(cycles, stats_.busy);
        account_.add(batch, blend(batch));
        const bool ended = live_ == 0 && config_.termination == Termination::Batch;
        if (ended && !batch.last) {
            ended_ = batch.tile;
        }
        if (ended || batch.last) {
            report_tile(live_ == 0);
        }
    }
    products->drop(self_);
    --batches_ahead_;
}

void VectorUnit::start_tile(TileNumber number) {
    if (stats_.tiles >= static_cast<std::uint64_t>(contexts_)) {
        context_free->get(self_);
    }
    number_ = number;
    tile_ = &job_.tiles[number];
    context_ = first_context_ + context_in_turn(stats_.tiles, contexts_);
    live_ = tile_->image_columns().size() * tile_->image_rows().size();
    stats_.tiles++;
}

BatchOutcome VectorUnit::blend(const GemmBatch& batch) {
    const std::uint64_t whole = std::uint64_t{1} * job_.tile_size * job_.tile_size;
    const std::uint32_t* list = job_.frame_of(*tile_).tile_splats.data() + batch.first;
    const std::uint32_t first_splat = tile_->first_splat;
    PixelTest test;
    const PixelRange columns = tile_->image_columns(), rows = tile_->image_rows();
    test.mask = bits_between(columns.first, columns.last + 1);
    test.x = tile_->x;
    test.y = tile_->y + rows.first;
    test.row = rows.first;
    test.context = context_;
    BatchOutcome sum;
    for (std::uint32_t i = 0; i < batch.splats; ++i) {
        if (live_ == 0) {
            sum.terminated += (batch.splats - i) * whole;
            break;
        }
        test.splat = first_splat + list[i];
        job_.path->test_rows(test, rows.size(), outcomes_.data());
        std::uint64_t useful = 0, terminated = 0;
        for (int row = 0; row < rows.size(); ++row) {
            const BlendOutcome& outcome = outcomes_[row];
            useful += __builtin_popcount(outcome.useful);
            terminated += __builtin_popcount(outcome.terminated);
            const int ended = __builtin_popcount(outcome.ended);
            live_ -= ended;
            stats_.pixels_ended += ended;
        }
        sum.useful += useful;
        sum.terminated += terminated;
        sum.boundary += whole - useful - terminated; // also pixels outside the image
    }
    return sum;
}

void VectorUnit::report_tile(bool all_ended) {
    const Cycle written = self_.local() + config_.latency_cycles;
    tile_state->put_at(self_, {number_, all_ended}, written);
    tile_done->put_at(self_, {number_, all_ended}, written);
}

} // namespace degs::orange
