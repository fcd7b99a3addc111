// SPDX-License-Identifier: Apache-2.0
// An accelerator in one file: a row of lanes that sweeps over each splat. The worked example of
// docs/adding-an-accelerator.md, built and run by row_sweep_test.cpp.
#pragma once

#include "modules/kit/engine/array_accelerator.hpp"
#include "tlm/has_process.hpp"

namespace degs::example {

/// One lane per column of the tile. Each splat takes one slot per row that it meets.
class RowSweepArray : public sc_core::sc_module {
public:
    sc_core::sc_vector<FifoPort<SplatChunk>> in;
    FifoPort<TileNumber> context_free;
    FifoPort<SliceReport> tile_done, tile_state;

    RowSweepArray(const sc_core::sc_module_name& name, const Timebase& time, RenderJob& job,
                  std::size_t streams, int contexts)
        : sc_core::sc_module(name), in("in", streams), job_(job), contexts_(contexts), self_(time) {
        DEGS_HAS_PROCESS(RowSweepArray);
        SC_THREAD(run);
    }
    SlotAccount slots;
    ActiveWindow window;
    std::uint64_t splats = 0;

private:
    void end_of_elaboration() override {
        for (auto& port : in) {
            port->connect_reader(self_);
        }
        context_free->connect_reader(self_);
        tile_done->connect_writer(self_);
        tile_state->connect_writer(self_);
    }
    void run() {
        for (TileNumber number = 0; number < job_.tiles.size(); ++number) {
            if (number >= static_cast<TileNumber>(contexts_)) {
                wait_and_account(Slot::Blocked, [&] { context_free->get(self_); });
            }
            SplatChunk chunk;
            while (!chunk.last) {
                wait_and_account(Slot::Starved,
                                 [&] { chunk = in[number % in.size()]->get(self_); });
                sweep(chunk);
            }
            tile_state->put(self_, {number, false});
            tile_done->put(self_, {number, false});
        }
        self_.finish();
    }
    /// Idle slots count once a slot follows: what lies outside the window is nobody's.
    template <class Wait>
    void wait_and_account(Slot cause, const Wait& wait) {
        const Cycle before = self_.local();
        wait();
        pending_[cause] += lanes() * (self_.local() - before);
    }
    void sweep(const SplatChunk& chunk) {
        const JobTile& tile = job_.tiles[chunk.tile];
        const std::uint32_t* list = job_.frame_of(tile).tile_splats.data() + chunk.first;
        PixelTest test;
        test.mask = tile.width == 32 ? ~0U : (1U << tile.width) - 1U;
        test.x = tile.x;
        test.context = static_cast<std::int16_t>(chunk.tile % static_cast<TileNumber>(contexts_));
        for (std::uint32_t i = 0; i < chunk.count; ++i, ++splats) {
            test.splat = job_.first_splat[tile.frame] + list[i];
            const PixelRange rows = job_.path->tested_rows(test.splat, tile.columns(), tile.rows());
            for (test.y = rows.first; test.y <= rows.last; ++test.y) {
                test.row = static_cast<std::int16_t>(test.y - tile.y);
                account(job_.path->test(test));
            }
        }
    }
    void account(const BlendOutcome& outcome) {
        if (!window.empty()) {
            slots += pending_;
        }
        pending_ = {};
        window.include(self_.local());
        const auto useful = static_cast<std::uint64_t>(__builtin_popcount(outcome.useful));
        const auto ended = static_cast<std::uint64_t>(__builtin_popcount(outcome.terminated));
        slots[Slot::Useful] += useful;
        slots[Slot::Terminated] += ended;
        slots[Slot::Boundary] += lanes() - useful - ended; // also lanes outside the image
        self_.advance();
    }
    std::uint64_t lanes() const { return static_cast<std::uint64_t>(job_.tile_size); }
    RenderJob& job_;
    int contexts_;
    Process self_;
    SlotAccount pending_; // idle slots since the last one that did something
};

class RowSweep : public ArrayAccelerator {
public:
    RowSweep(const char* name, const Parts& parts, const Timebase& time, RenderJob& job,
             const BuildOptions& options)
        : ArrayAccelerator(name, parts, time, job, options),
          array_("array", time, job, share_of(0).inputs, parts.contexts) {
        connect(array_);
    }

private:
    void collect_array(AcceleratorResult& result) const override {
        result.slots = array_.slots;
        result.window = array_.window;
        Counters counters;
        counters.count("splats", array_.splats, "splats", "Splats swept over.");
        add_stage(result, {"blending", "Rows of splats, one after the other.", true}, 1,
                  array_.window.cycles(), std::move(counters));
        add_activity(result, "blending", result.slots.executed());
        result.conservation.push_back({"records = splats", records_fetched(), array_.splats});
    }
    RowSweepArray array_;
};

/// What the blocks take: those of DeGS, of the paper's Table I.
struct RowSweepCostRows {
    cost::UnitRow projection{0.92, 0.60, 4}, sorting{0.02, 0.01, 4}, blending{0.88, 0.23, 64};
    cost::SramRow gaussian_buffer{0.31, 0.01, 72 * 1024, 192};
    cost::SramRow pixel_buffer{0.12, 0.01, 16 * 1024, 1024};
};

struct RowSweepConfig : AcceleratorConfig {
    int tile_size = 16; ///< px, also the number of lanes
    ArrayAccelerator::Parts parts;
    RowSweepCostRows cost_rows;

    RowSweepConfig() { name = "row-sweep-16"; }
    std::unique_ptr<AcceleratorConfig> clone() const override {
        return std::make_unique<RowSweepConfig>(*this);
    }
    void describe(ConfigVisitor& visitor) override {
        describe_common(visitor);
        visitor.integer("tile_size", tile_size, 4, 32, "px, and lanes");
        visitor.section("pixel_buffer", parts.pixel_buffer, "tiles in flight");
        visitor.section("memory", parts.memory, "off-chip memory");
        describe_cost(visitor);
        parts.pixel_buffer.require_tiles(visitor, "pixel_buffer", tile_pixels(), 1, {"tile_size"});
    }
    int pes() const override { return tile_size; }
    int tile_size_px() const override { return tile_size; }
    TileMode tile_mode() const override { return TileMode::Exact; }
    DataPathOptions data_path() const override { return PipelineConfig{}.data_path(); }
    int tile_contexts() const override { return parts.pixel_buffer.contexts(tile_pixels()); }
    TileCoupling tile_coupling(bool /*array_only*/) const override { return {}; }
    PixelBuffer::TilePixels tile_pixels() const {
        return {tile_size, PipelineConfig{}.pixel_bits()};
    }
    TrafficConfig records() const override { return parts.front.traffic; }
    void read_floats() override {
        parts.front.traffic.geometry_bytes = kFloatGeometryBytes;
        parts.front.traffic.sh_value_bytes = kFloatBytes;
    }
    cost::BillOfMaterials bill() const override {
        cost::BillOfMaterials bill(cost, clock_ghz);
        bill.add_units({"projection", "Projection Units.", true}, cost_rows.projection,
                       parts.front.projection.count);
        bill.add_units({"sorting", "Sorting Units.", true}, cost_rows.sorting,
                       parts.front.sorting.count);
        bill.add_units({"blending", "Lanes."}, cost_rows.blending, pes());
        bill.add_sram({"gaussian_buffer", "Splats and lists."}, cost_rows.gaussian_buffer,
                      cost_rows.gaussian_buffer.bytes, 2 * records().splat_bytes);
        bill.add_sram({"pixel_buffer", "Tiles in flight."}, cost_rows.pixel_buffer,
                      parts.pixel_buffer.bytes, 2 * pes() * parts.pixel_bytes);
        return bill;
    }
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override {
        ArrayAccelerator::Parts sized = parts;
        sized.front.sort_capacity = 1024;
        sized.front.frames_in_flight = frames_in_flight;
        sized.frame_end = frame_end;
        sized.contexts = tile_contexts();
        sized.splat_chunks = 8;
        sized.buffer_bytes = cost_rows.gaussian_buffer.bytes;
        return std::make_unique<RowSweep>(module, sized, time, job, options);
    }

private:
    void describe_rows(ConfigVisitor& visitor) override {
        cost::RowSection section("row_sweep", "rows of the row sweep", cost, visitor);
        section.row("projection", cost_rows.projection, "Projection Units");
        section.row("sorting", cost_rows.sorting, "Sorting Units");
        section.row("blending", cost_rows.blending, "lanes");
        section.row("gaussian_buffer", cost_rows.gaussian_buffer, "splats and lists");
        section.row("pixel_buffer", cost_rows.pixel_buffer, "tiles in flight");
        section.end();
    }
};

} // namespace degs::example
