// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "baselines/gbu/tile_engine.hpp"
#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"
#include "modules/kit/front_end/projection_unit.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_binner.hpp"
#include "modules/kit/front_end/tile_monitor.hpp"
#include "modules/kit/job/traffic.hpp"
#include "modules/kit/pixels/pixel_buffer.hpp"

namespace degs {

/// The standalone GBU (Ye et al., HPCA 2025) with GSCore's projection and sorting, as the DeGS paper
/// compares against it; defaults are its 64-PE design. Values that neither paper gives are [assumed].
struct GbuConfig : AcceleratorConfig {
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
    PipelineConfig pipeline;
    TrafficConfig traffic;
    ProjectionUnit::Config projection;
    TileBinner::Config binning;
    HierarchicalSorter::Config sorting;
    ListBuffer list_buffer;
    SplatFetcher::Config fetching;
    Cache reuse_cache;
    Engines engines;
    PixelBuffer::Config pixel_buffer;
    TileMonitor::Config monitor;
    MainMemoryConfig memory;

    GbuConfig();
    std::unique_ptr<AcceleratorConfig> clone() const override {
        return std::make_unique<GbuConfig>(*this);
    }
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int tile_size_px() const override { return tile_size; }
    TileMode tile_mode() const override { return pipeline.tiles; }
    DataPathOptions data_path() const override { return pipeline.data_path(); }
    int tile_contexts() const override { return engines.count * contexts(); }
    TileCoupling tile_coupling(bool array_only) const override;
    std::vector<LossKey> loss_keys() const override;
    TrafficConfig records() const override { return traffic; }
    cost::BillOfMaterials bill() const override;
    RecordOrder record_order() const override { return memory.layout; }
    void read_floats() override {
        traffic.geometry_bytes = kFloatGeometryBytes;
        traffic.sh_value_bytes = kFloatBytes;
    }
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
    std::int64_t queue_bytes() const {
        return std::int64_t{pes()} * engines.queue_depth * engines.entry_bytes;
    }
    std::int64_t splat_buffer_bytes() const {
        return std::int64_t{engines.count} * list_buffer.chunks * fetching.chunk *
               traffic.splat_bytes;
    }
    /// Bytes of the state of a pixel, which need not be whole ones.
    double pixel_bytes() const { return pixel_buffer.pixel_bytes(tile_pixels()); }

private:
    PixelBuffer::TilePixels tile_pixels() const { return {tile_size, pipeline.pixel_bits()}; }
    void require_sizes(ConfigVisitor& visitor) const;
};

} // namespace degs
