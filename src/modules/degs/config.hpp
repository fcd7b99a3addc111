// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>

#include "modules/degs/array/blending_array.hpp"
#include "modules/degs/cost.hpp"
#include "modules/degs/scheduler/issue_bank.hpp"
#include "modules/degs/span_engine/gaussian_slicing_unit.hpp"
#include "modules/degs/span_engine/span_buffer.hpp"
#include "modules/degs/span_engine/span_stage.hpp"
#include "modules/degs/supply/gaussian_buffer.hpp"
#include "modules/degs/supply/splat_supply.hpp"
#include "modules/kit/engine/tiled_config.hpp"
#include "modules/kit/front_end/sorting_unit.hpp"
#include "modules/kit/job/buffer_share.hpp"

namespace degs {

/// The arithmetic of Span Units beside that of every data path.
struct SpanPipelineConfig : PipelineConfig {
    SpanEnds span_ends = SpanEnds::Outward;
    int span_delta = 0;
    DataPathOptions data_path() const { return options(span_ends, span_delta); }
    void describe(ConfigVisitor& visitor);
};

/// A Pixel Buffer whose ports the tasks of a packet share.
struct PortedPixelBufferConfig : PixelBuffer::Config {
    BankedSramPorts ports{{0}, 32}; ///< in each Issue Bank's part of a context
    void describe(ConfigVisitor& visitor);
};

/// A complete DeGS accelerator; defaults are the structure of the paper's 64-PE design (Tables I
/// and II), computing in fp32. configs/degs-64.yaml is that design with the paper's formats, too.
/// Capacities are in bytes; the depths of rings follow from record sizes.
struct DegsConfig : TiledConfig<DegsConfig, SpanPipelineConfig, PortedPixelBufferConfig> {
    int tile_size = 32;
    /// Back ends, each with all that the sections from `fetching` to `monitor` describe.
    int clusters = 1;
    SortingUnit::Config sorting;
    SplatSupply::Config front; ///< of all clusters but for the FIFOs
    GaussianBufferConfig gaussian_buffer;
    GaussianSlicingUnit::Config slicing;
    SpanBufferConfig span_buffer;
    SpanStage::Config span;
    IssueBank::Config scheduler;
    PackingUnit::Config packing;
    FeatureBuffer::Config feature_buffer;
    ArraySlice::Config array;
    DegsCostRows cost_rows;

    DegsConfig() { name = "degs-64"; }
    void describe(ConfigVisitor& visitor) override;
    void scale_to(int pes) override;
    int tile_size_px() const override { return tile_size; }
    int tile_contexts() const override { return clusters * contexts(); }
    TileCoupling tile_coupling(bool array_only) const override;
    std::vector<LossKey> loss_keys() const override;
    /// Keys that did not limit a run, out of those of the window of waiting segments: a bank had up
    /// to `high_water` segments, and `feature_waits` of the entries of the Feature Buffer, 0 to 1,
    /// had to wait for a free one.
    std::vector<std::string> idle_window_keys(std::uint64_t high_water, double feature_waits) const;
    cost::BillOfMaterials bill() const override;
    /// What the blocks of the array do for that work, all but the Pixel Buffer.
    std::vector<cost::Activity> activity(const DegsWork& work) const;
    std::vector<cost::ClockLimit> clock_limits() const override;
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override;
    std::unique_ptr<AnalyticModel> analytic() const override;

    // Derived sizes, of a cluster unless they say otherwise.
    int pes() const override { return clusters * cluster_pes(); }
    int cluster_pes() const { return scheduler.banks * array.pes_per_bank; }
    int contexts() const { return pixel_buffer.contexts(tile_pixels()); }
    /// Tile streams, and the tiles of each that the Pixel Buffer holds.
    int streams() const { return slicing.interleave; }
    int contexts_per_stream() const { return contexts() / streams(); }
    int all_streams() const { return clusters * streams(); } ///< of all clusters
    /// Tiles are granted one by one; a single stream takes all.
    bool granted() const { return all_streams() > 1; }
    int fetchers() const { return granted() ? streams() : sorting.count; }
    /// Lanes of the Span Buffer for each stream: one for every unit that takes rows of its own, or
    /// for every Slicing Unit that fills it.
    int span_lanes() const {
        return span.rows == RowAssignment::Pool ? slicing.modules() : span.count;
    }
    int span_lane_depth() const {
        return span_buffer.bytes / span_buffer.row_bytes / (span_lanes() * streams());
    }
    /// True if Span Units have more to choose from than the next row of a lane of their own.
    bool spans_are_pooled() const {
        return span.rows == RowAssignment::Pool || streams() > 1 || span.rows_per_cycle > 1;
    }
    /// Span Vectors between Span Units and a bank, for each stream: those that wait, and one for
    /// every stage of the pipelines that lead to the bank. Stages fill up while the bank takes
    /// nothing [assumed].
    int crossbar_cells() const {
        const int units = span.units_per_module();
        const int stages = (span.latency_cycles + span.cycles_per_row - 1) / span.cycles_per_row;
        const int waiting = (units + scheduler.banks - 1) / scheduler.banks * span.crossbar_depth;
        return waiting + units * span.rows_per_cycle * stages;
    }
    BankShape bank_shape() const;
    /// Bytes of a bank's share of the Packing Buffer, and of a packet in it.
    int packing_share() const { return packing.bytes / scheduler.banks; }
    int packet_bytes() const { return packing.task_bytes * array.pes_per_bank; }
    /// Segments that wait in a bank: what the key says, or as many as fit beside the lead.
    int queue_depth() const {
        if (scheduler.queue_segments_per_pe != 0) {
            return scheduler.queue_segments_per_pe * array.pes_per_bank;
        }
        const std::int64_t lead = std::int64_t{packing.lead_packets} * packet_bytes();
        const std::int64_t segments = (packing_share() - lead) / scheduler.segment_bytes;
        return static_cast<int>(std::clamp<std::int64_t>(
            segments, 1, std::int64_t{IssueBank::Config::kMostSegmentsPerPe} * array.pes_per_bank));
    }
    /// Packets per bank. The Packing Buffer also holds the waiting segments of the banks.
    int packing_depth() const {
        return (packing_share() - queue_depth() * scheduler.segment_bytes) / packet_bytes();
    }
    /// Packets of a bank that may wait for its array slice.
    int packing_lead() const { return std::min(packing_depth(), packing.lead_packets); }
    int feature_entries() const {
        return feature_buffer.bytes / feature_buffer.entry_bytes / scheduler.banks;
    }
    /// The shares in the Gaussian Buffer of a cluster: of a fetcher for sorted splats, of a Sorting
    /// Unit for lists.
    BufferShare splat_share() const { return {1.0 - gaussian_buffer.sort_share, fetchers()}; }
    BufferShare sort_share() const { return {gaussian_buffer.sort_share, sorting.count}; }
    /// Splat chunks that a fetcher's share of the Gaussian Buffer holds.
    int gaussian_chunks() const {
        return splat_share().bytes_of(gaussian_buffer.bytes) / chunk_bytes();
    }
    // Sections with what follows for their blocks from the other sections.
    /// What writes chunks of splats to the Gaussian Buffer, as if it read them itself.
    SplatFetcher::Config chunk_writers() const;
    /// The section of an Issue Bank in the cluster whose tile contexts begin at `first_context` of
    /// the Pixel Buffer.
    IssueBank::Config issue_bank(int first_context) const;
    PackingUnit::Config packing_unit() const;
    ArraySlice::Config array_slice(int first_context) const;
    /// Some SRAM has a limited number of ports.
    bool ports_limited() const {
        return gaussian_buffer.ports.limited() || span_buffer.ports.limited() ||
               packing.segment_ports.limited() || feature_buffer.fill.ports.limited() ||
               pixel_buffer.ports.limited();
    }
    /// Temporary Gaussian Parameters live until the spans are made.
    bool parameters_wait() const { return gaussian_buffer.temporary == ParameterLife::Spans; }
    /// Keys that a Sorting Unit's share of the Gaussian Buffer holds.
    int sort_capacity() const {
        return clusters * sort_share().bytes_of(gaussian_buffer.bytes) / traffic.list_entry_bytes;
    }

    /// A row may go to any Span Unit, and its span to any bank.
    bool spans_cross() const { return span.rows == RowAssignment::Pool; }

private:
    void describe_rows(ConfigVisitor& visitor) override;
    // Area by the laws of cost.logic.
    double bank_ratio() const; ///< over the bank of the paper's 64-PE design
    cost::SramShape segment_shape() const;
    double span_crossbar_area() const;
    double cluster_dispatch_area() const;
    /// The key that limits how many segments wait in a bank.
    const char* queue_key() const;
    /// Packets in which a segment may lie at most.
    int packets_per_segment() const;
    int chunk_bytes() const { return traffic.splat_bytes * fetching.chunk; }
    void require_counts(ConfigVisitor& visitor) const;
    void advise_supply(ConfigVisitor& visitor) const;
    void advise_depths(ConfigVisitor& visitor) const;
    void require_sizes(ConfigVisitor& visitor) const;
    void require_packing(ConfigVisitor& visitor) const;
};

} // namespace degs
