// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "baselines/orange/cost.hpp"
#include "baselines/orange/systolic_array.hpp"
#include "baselines/orange/vector_unit.hpp"
#include "modules/kit/engine/tiled_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"

namespace degs::orange {

/// ORANGE (Li et al., HPCA 2026), an NPU that blends by products of matrices, with GSCore's
/// projection and sorting; defaults are O-4, its four cores. Most of its values are not public:
/// those are [assumed].
struct Config : TiledConfig<Config> {
    struct Cores {
        int count = 4;
        SystolicArray::Config array;
        VectorUnit::Config vector;
        void describe(ConfigVisitor& visitor);
    };
    /// The memory of a core, in batches, each of which is a chunk of the Splat Fetcher.
    struct Scratchpad {
        int bytes = 256 * 1024; ///< of a core
        int splat_batches = 2, coefficient_batches = 2, product_batches = 2;
        int value_bytes = 4; ///< of a coefficient, a colour and an exponent
        void describe(ConfigVisitor& visitor);
    };
    struct Gemm : ExponentGemm {
        Gemm(); ///< FP16 operands, single-precision sums
        void describe(ConfigVisitor& visitor);
    };

    int tile_size = 8;
    Gemm gemm;
    HierarchicalSorter::Config sorting;
    Cores cores;
    Scratchpad scratchpad;
    CostRows cost_rows;

    Config();
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    /// Multipliers of all systolic arrays.
    int pes() const override { return cores.count * cores.array.macs(); }
    int tile_size_px() const override { return tile_size; }
    DataPathOptions data_path() const override;
    int tile_contexts() const override { return cores.count * contexts(); }
    TileCoupling tile_coupling(bool array_only) const override;
    /// Products of a tile whose pixels have ended are finished.
    std::vector<LossKey> loss_keys() const override;
    cost::BillOfMaterials bill() const override;
    /// The activity of the blocks of the cores for that work, without the Pixel Buffer.
    std::vector<cost::Activity> activity(const Work& work) const;
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    // Derived sizes.
    int tile_area() const { return tile_size * tile_size; }
    /// Tile contexts of one core.
    int contexts() const { return pixel_buffer.contexts(tile_pixels()) / cores.count; }
    /// Bytes of a batch in each of its three places.
    std::int64_t splat_batch_bytes() const;
    std::int64_t coefficient_batch_bytes() const;
    std::int64_t product_batch_bytes() const;
    /// Bytes that batches of the three kinds take in a core's scratchpad.
    std::int64_t batches_bytes() const;
    /// Keys of lists being sorted that a sorting unit's share of what is left holds.
    int sort_capacity() const;

private:
    void describe_rows(ConfigVisitor& visitor) override;
    void require_sizes(ConfigVisitor& visitor) const;
};

} // namespace degs::orange
