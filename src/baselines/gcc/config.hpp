// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "baselines/gcc/colour_stage.hpp"
#include "baselines/gcc/cost.hpp"
#include "baselines/gcc/grouping.hpp"
#include "baselines/gcc/projection_stage.hpp"
#include "baselines/gcc/window_array.hpp"
#include "modules/kit/accelerator/render_engine.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_monitor.hpp"
#include "modules/kit/pixels/pixel_buffer.hpp"

namespace degs::gcc {

/// A complete GCC accelerator; defaults are the 64-PE design that DeGS compares with (its Table I).
/// Every unpublished value is a key.
struct Config : AcceleratorConfig {
    /// Stages II to IV, each with its buffers and on a view of its own, behind one Stage I. All
    /// sections but `grouping` and `memory`, and `group_buffer_bytes`, describe one of them.
    int clusters = 1;
    int view_size = 128;                ///< px, side of a view
    int group_buffer_bytes = 62 * 1024; ///< groups between the stages
    int splat_bytes = 32;               ///< per Gaussian of a group in flight
    PipelineConfig pipeline;
    Traffic traffic;
    Grouping::Config grouping;          ///< Stage I
    ProjectionStage::Config projection; ///< Stage II
    ColourStage::Config colour;         ///< Stage III
    WindowArray::Config array;          ///< Stage IV
    PixelBuffer::Config image_buffer;
    TileMonitor::Config monitor;
    MainMemoryConfig memory;
    CostRows cost_rows;

    Config();
    std::unique_ptr<AcceleratorConfig> clone() const override {
        return std::make_unique<Config>(*this);
    }
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int pes() const override { return clusters * array.pes(); }
    int tile_size_px() const override { return view_size; }
    TileMode tile_mode() const override { return pipeline.tiles; }
    DataPathOptions data_path() const override { return pipeline.data_path(); }
    int tile_contexts() const override { return clusters * contexts(); }
    TileCoupling tile_coupling(bool /*array_only*/) const override {
        return TileCoupling::of_clusters(clusters);
    }
    std::vector<LossKey> loss_keys() const override;
    TrafficConfig records() const override { return traffic.common(); }
    ViewSharing view_sharing() const override { return grouping.shared_by_views; }
    cost::BillOfMaterials bill() const override;
    /// What the blocks do for that work, all but the Pixel Buffer; an array alone has no stages
    /// before it.
    std::vector<cost::Activity> activity(const Work& work, bool array_only) const;
    void read_floats() override {
        traffic.mean_bytes = 3 * kFloatBytes;
        traffic.bound_bytes = kFloatBytes;
        traffic.shape_bytes = 8 * kFloatBytes;
        traffic.gaussian_bytes = kFloatGeometryBytes;
        traffic.sh_value_bytes = kFloatBytes;
    }
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    /// Views of one cluster whose pixels are on chip.
    int contexts() const { return image_buffer.contexts(view_pixels()); }
    /// Bytes of the state of a pixel, which need not be whole ones.
    double pixel_bytes() const { return image_buffer.pixel_bytes(view_pixels()); }
    /// Gaussians that wait before Stage II: list entries only.
    int listed_gaussians() const { return projection.groups_ahead * projection.group; }
    /// Hand-overs that wait before Stage IV: as many groups as elsewhere.
    int chunks_ahead() const { return (listed_gaussians() + colour.chunk - 1) / colour.chunk; }
    /// Bytes of the four rings behind shapes, projection, SH and colour.
    int group_bytes() const {
        return listed_gaussians() * (traffic.list_entry_bytes + 4 * splat_bytes);
    }

private:
    void describe_rows(ConfigVisitor& visitor) override;
    PixelBuffer::TilePixels view_pixels() const { return {view_size, pipeline.pixel_bits()}; }
    void require_parts(ConfigVisitor& visitor) const;
    void require_sizes(ConfigVisitor& visitor) const;
};

} // namespace degs::gcc
