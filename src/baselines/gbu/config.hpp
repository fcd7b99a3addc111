// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "baselines/gbu/cost.hpp"
#include "baselines/gbu/tile_engine.hpp"
#include "modules/kit/engine/tiled_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"

namespace degs::gbu {

/// The standalone GBU (Ye et al., HPCA 2025) with GSCore's projection and sorting, as the DeGS
/// paper compares against it; defaults are its 64-PE design. Values that neither paper gives are
/// [assumed].
struct Config : TiledConfig<Config> {
    struct ListBuffer {
        int bytes = 15 * 1024; ///< lists being sorted
        int chunks = 4;        ///< splat chunks in front of an engine
        void describe(ConfigVisitor& visitor);
    };
    struct Engines : TileEngine::Config {
        int count = 2;
        int entry_bytes = 8; ///< per queued row entry
        void describe(ConfigVisitor& visitor);
    };
    struct Cache {
        int bytes = 32 * 1024; ///< of all engines together; 0: none
        void describe(ConfigVisitor& visitor);
    };

    int tile_size = 32;
    HierarchicalSorter::Config sorting;
    ListBuffer list_buffer;
    Cache reuse_cache;
    Engines engines;
    CostRows cost_rows;

    Config();
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int tile_size_px() const override { return tile_size; }
    int tile_contexts() const override { return engines.count * contexts(); }
    TileCoupling tile_coupling(bool array_only) const override;
    /// Queues of rows whose pixels have ended run dry later.
    std::vector<LossKey> loss_keys() const override;
    cost::BillOfMaterials bill() const override;
    /// The activity of the blocks of the engines for that work, without the Pixel Buffer.
    std::vector<cost::Activity> activity(const Work& work) const;
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    // Derived sizes.
    int pes() const override { return engines.count * engines.row_pes; }
    /// Tile contexts of one engine.
    int contexts() const { return pixel_buffer.contexts(tile_pixels()) / engines.count; }
    /// Keys that a sorter's share of the list buffer holds.
    int sort_capacity() const {
        return list_buffer.bytes / sorting.count / traffic.list_entry_bytes;
    }
    /// Records in the reuse cache of one engine.
    int cache_records() const { return reuse_cache.bytes / engines.count / traffic.splat_bytes; }
    /// Rows per cycle that Row Generation of all engines is paid for.
    double rows_per_cycle() const {
        return engines.rows_per_cycle == 0 ? cost_rows.scheduler.units
                                           : engines.count * engines.rows_per_cycle;
    }
    std::int64_t queue_bytes() const {
        return std::int64_t{pes()} * engines.queue_depth * engines.entry_bytes;
    }
    std::int64_t splat_buffer_bytes() const {
        return std::int64_t{engines.count} * list_buffer.chunks * fetching.chunk *
               traffic.splat_bytes;
    }

private:
    void describe_rows(ConfigVisitor& visitor) override;
    void require_sizes(ConfigVisitor& visitor) const;
};

} // namespace degs::gbu
