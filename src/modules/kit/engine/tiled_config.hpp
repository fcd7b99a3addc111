// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "modules/kit/config/pipeline_config.hpp"
#include "modules/kit/front_end/projection_unit.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_binner.hpp"
#include "modules/kit/front_end/tile_monitor.hpp"
#include "modules/kit/job/traffic.hpp"
#include "modules/kit/pixels/pixel_buffer.hpp"

namespace degs {

/// The configuration of an accelerator that sorts a list of splats for each tile and fetches their
/// records from memory. It has the sections of the blocks that all of these need; `Self`, which
/// derives from it, describes them in an order of its own, and adds its sorter and its array.
/// `Pipeline` and `Pixels` may be sections with more keys.
template <class Self, class Pipeline = PipelineConfig, class Pixels = PixelBuffer::Config>
struct TiledConfig : AcceleratorConfig {
    Pipeline pipeline;
    TrafficConfig traffic;
    ProjectionUnit::Config projection;
    TileBinner::Config binning;
    SplatFetcher::Config fetching;
    Pixels pixel_buffer;
    TileMonitor::Config monitor;
    MainMemoryConfig memory;

    std::unique_ptr<AcceleratorConfig> clone() const override {
        return std::make_unique<Self>(static_cast<const Self&>(*this));
    }
    TileMode tile_mode() const override { return pipeline.tiles; }
    DataPathOptions data_path() const override { return pipeline.data_path(); }
    TrafficConfig records() const override { return traffic; }
    ViewSharing view_sharing() const override { return projection.shared_by_views; }
    bool keeps_lists() const override { return binning.keep_lists; }
    RecordOrder record_order() const override { return memory.layout; }
    void read_floats() override {
        traffic.geometry_bytes = kFloatGeometryBytes;
        traffic.sh_value_bytes = kFloatBytes;
    }
    /// Bytes of the state of a pixel, which need not be whole ones.
    double pixel_bytes() const { return pixel_buffer.pixel_bytes(tile_pixels()); }

protected:
    /// Adds to a bill the logic of the Tile Binner that published rows do not have, and its SRAM;
    /// `row` and what may follow it are those of the other buffers
    /// (cost::BillOfMaterials::add_sram).
    template <class Row, class... Shape>
    void add_binning(cost::BillOfMaterials& bill, const Row& row, const Shape&... shape) const {
        constexpr int kReadAndWritten = 2;
        if (binning.more_pairs() != 0) {
            const cost::LogicLaws& laws = cost.logic;
            bill.add_units({"binning", "Tiles that the binner finds per cycle beyond 8.", true},
                           laws.pe, binning.more_pairs(), laws.share_of(laws.tile_walk.b));
        }
        if (binning.sram_bytes() != 0) {
            bill.add_sram(
                {"binning_buffer", "List entries that wait, and the ends of the lists.", true}, row,
                binning.sram_bytes(),
                kReadAndWritten * binning.pairs_per_cycle * traffic.list_entry_bytes, shape...);
        }
    }
    PixelBuffer::TilePixels tile_pixels() const { return {tile_size_px(), pipeline.pixel_bits()}; }
};

} // namespace degs
