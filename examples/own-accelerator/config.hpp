// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "array.hpp"
#include "modules/kit/engine/tiled_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"

namespace degs::row_sweep {

/// Area and power of the blocks, per block or per byte those of GSCore [assumed].
struct CostRows {
    cost::UnitRow projection{0.87, 0.57, 4}, sorting{0.02, 0.01, 4}, blending{1.81, 0.25, 64};
    cost::SramRow sram{1.25, 0.04, 272 * 1024, 2240};
};

/// A row sweep with its memory. It is the worked example of docs/adding-an-accelerator.md, proposed
/// by nobody; all its values are [assumed].
struct Config : TiledConfig<Config> {
    /// In front of each array.
    struct Buffer {
        int bytes = 16 * 1024; ///< what the chunks leave holds lists being sorted
        int chunks = 4;        ///< of splats
        void describe(ConfigVisitor& visitor);
    };

    int tile_size = 16;
    HierarchicalSorter::Config sorting;
    Buffer buffer;
    Array::Config arrays;
    CostRows cost_rows;

    Config();
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int pes() const override { return arrays.count * tile_size; }
    int tile_size_px() const override { return tile_size; }
    int tile_contexts() const override { return arrays.count * contexts(); }
    TileCoupling tile_coupling(bool /*array_only*/) const override { return {}; }
    std::vector<LossKey> loss_keys() const override;
    cost::BillOfMaterials bill() const override;
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    /// Tile contexts of one array.
    int contexts() const { return pixel_buffer.contexts(tile_pixels()); }
    int chunks_bytes() const { return buffer.chunks * fetching.chunk * traffic.splat_bytes; }
    /// Keys of lists being sorted that a sorting unit's share of all buffers holds.
    std::int64_t sort_capacity() const {
        return std::int64_t{arrays.count} * (buffer.bytes - chunks_bytes()) / sorting.count /
               traffic.list_entry_bytes;
    }

private:
    void describe_rows(ConfigVisitor& visitor) override;
};

} // namespace degs::row_sweep
