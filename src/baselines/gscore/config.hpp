// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "baselines/gscore/cost.hpp"
#include "baselines/gscore/lockstep_array.hpp"
#include "modules/kit/engine/tiled_config.hpp"
#include "modules/kit/front_end/hierarchical_sorter.hpp"
#include "modules/kit/job/buffer_share.hpp"

namespace degs::gscore {

/// A complete GSCore (Lee et al., ASPLOS 2024) with the memory of this project's comparisons;
/// defaults are its 64 lanes. Descriptions mark the values that its publication leaves open.
struct Config : TiledConfig<Config> {
    /// On-chip memory as one figure, as in the paper's Table I; the Pixel Buffer is part of it.
    struct Buffer {
        int bytes = 272 * 1024;
        double sort_share = 0.5; ///< of what the Pixel Buffer leaves, for lists being sorted
        void describe(ConfigVisitor& visitor);
    };

    /// Arrays, each with its buffers and on a tile of its own, behind one front end. `array`,
    /// `buffer` and `pixel_buffer` describe one of them.
    int clusters = 1;
    HierarchicalSorter::Config sorting;
    Buffer buffer;
    LockstepArray::Config array;
    CostRows cost_rows;

    Config();
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int pes() const override { return clusters * array.lanes; }
    int tile_size_px() const override { return array.tile_size(); }
    int tile_contexts() const override { return clusters * contexts(); }
    TileCoupling tile_coupling(bool /*array_only*/) const override {
        return TileCoupling::of_clusters(clusters);
    }
    std::vector<LossKey> loss_keys() const override;
    cost::BillOfMaterials bill() const override;
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    /// Tile contexts of one cluster.
    int contexts() const { return pixel_buffer.contexts(tile_pixels()); }
    /// Splat chunks that a fetcher's share of the buffer holds.
    int splat_chunks() const { return splat_share().bytes_of(shared_bytes()) / chunk_bytes(); }
    /// Keys that a sorter's share of the buffers of all clusters holds.
    std::int64_t sort_capacity() const {
        return std::int64_t{clusters} * sort_share().bytes_of(shared_bytes()) /
               traffic.list_entry_bytes;
    }

private:
    void describe_rows(ConfigVisitor& visitor) override;
    BufferShare splat_share() const { return {1.0 - buffer.sort_share, fetchers()}; }
    /// Fetchers of one cluster: one that works on all tiles has a fetcher for each sorter.
    int fetchers() const { return clusters > 1 ? 1 : sorting.count; }
    BufferShare sort_share() const { return {buffer.sort_share, sorting.count}; }
    /// Bytes that the buffer of one cluster has beside its Pixel Buffer.
    int shared_bytes() const { return buffer.bytes - pixel_buffer.bytes; }
    int chunk_bytes() const { return traffic.splat_bytes * fetching.chunk; }
    void require_sizes(ConfigVisitor& visitor) const;
};

} // namespace degs::gscore
