// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/tile_front_end.hpp"

#include "modules/kit/engine/collect.hpp"
#include "modules/kit/memory/stream_kinds.hpp"
#include "tlm/rings.hpp"

namespace degs {

TileFrontEnd::TileFrontEnd(const sc_core::sc_module_name& name, const Config& config,
                           const Timebase& time, const RenderJob& job)
    : sc_core::sc_module(name), sorted("sorted", config.sorters()),
      cancel("cancel", config.on_demand && !config.instant ? config.hierarchical.count : 0),
      frame_free("frame_free", gated(config, job) ? config.projection.count : 0),
      listed("listed", config.instant ? 0 : 1) {
    if (config.instant) {
        build_sources(time, job);
    } else {
        build_units(config, time, job);
    }
}

void TileFrontEnd::build_sources(const Timebase& time, const RenderJob& job) {
    for (TileNumber i = 0; i < sorted.size(); ++i) {
        sources_.push_back(std::make_unique<ListSource>(numbered("lists", i).c_str(), time, job, i,
                                                        sorted.size()));
        sources_.back()->sorted.bind(sorted[i]);
    }
}

void TileFrontEnd::build_units(const Config& config, const Timebase& time, const RenderJob& job) {
    const std::size_t sorters = sorted.size();
    const int waits_for = frame_free.size() == 0 ? 0 : config.frames_in_flight;
    changes_ = std::make_unique<ListChanges>(job, config.binning.keep_lists);
    binner_ = std::make_unique<TileBinner>("binner", config.binning, config.traffic, time, job,
                                           *changes_, config.projection.chunk,
                                           config.projection.count, sorters + listed.size());
    for (std::size_t i = 0; i < listed.size(); ++i) {
        binner_->out[sorters + i].bind(listed[i]);
    }
    for (int i = 0; i < config.projection.count; ++i) {
        projection_.push_back(std::make_unique<ProjectionUnit>(numbered("projection", i).c_str(),
                                                               config.projection, config.traffic,
                                                               time, job, i, waits_for));
        auto& chunks = add_ring(projected_, "projected", time, config.projection.chunks_ahead, 1);
        chunks.set_billed(); // with the Projection Unit
        projection_.back()->out.bind(chunks);
        binner_->in[i].bind(chunks);
        if (waits_for != 0) {
            projection_.back()->frame_free[0].bind(frame_free[i]);
        }
    }
    for (TileNumber i = 0; i < sorters; ++i) {
        auto& frames = add_wire(frames_, "frames", time, 1);
        binner_->out[i].bind(frames);
        build_sorter(i, config, time, job, frames);
    }
}

void TileFrontEnd::build_sorter(TileNumber index, const Config& config, const Timebase& time,
                                const RenderJob& job, DatedFifo<std::uint32_t>& frames) {
    const std::string name = numbered("sorting", index);
    if (config.on_demand) {
        hierarchical_.push_back(std::make_unique<HierarchicalSorter>(
            name.c_str(), config.hierarchical, config.traffic, time, job, *changes_, index,
            config.sort_capacity));
        hierarchical_.back()->start.bind(frames);
        hierarchical_.back()->cancel.bind(cancel[index]);
        hierarchical_.back()->sorted.bind(sorted[index]);
    } else {
        sorting_.push_back(std::make_unique<SortingUnit>(name.c_str(), config.sorting,
                                                         config.traffic, time, job, *changes_,
                                                         index, config.sort_capacity));
        sorting_.back()->start.bind(frames);
        sorting_.back()->sorted.bind(sorted[index]);
    }
}

void TileFrontEnd::connect_memory(MemoryStreams& streams,
                                  const std::vector<std::unique_ptr<SplatFetcher>>& fetchers) {
    for (auto& unit : projection_) {
        streams.connect(unit->geometry, stream_kinds::kGeometry);
        streams.connect(unit->sh, stream_kinds::kSh);
    }
    if (binner_) {
        streams.connect(binner_->splats, stream_kinds::kSplatsWritten);
        streams.connect(binner_->lists, stream_kinds::kTileListsWritten);
    }
    for (std::size_t i = 0; i < std::max(sorted.size(), fetchers.size()); ++i) {
        if (i < sorting_.size()) {
            streams.connect_urgent(sorting_[i]->loader.lists, stream_kinds::kTileListsSorted);
            streams.connect_urgent(sorting_[i]->lists, stream_kinds::kTileListsSorted);
        }
        if (i < hierarchical_.size()) {
            streams.connect_urgent(hierarchical_[i]->loader.lists, stream_kinds::kTileListsSorted);
            streams.connect_urgent(hierarchical_[i]->lists, stream_kinds::kTileListsSorted);
            streams.connect_urgent(hierarchical_[i]->chunks, stream_kinds::kTileListsSorted);
        }
        if (i < fetchers.size()) {
            streams.connect_urgent(fetchers[i]->records, stream_kinds::kSplatsRead);
        }
    }
    if (binner_ && binner_->heads) {
        streams.connect(*binner_->heads, stream_kinds::kListHeads);
    }
}

void TileFrontEnd::collect(AcceleratorResult& result) const {
    if (!binner_) {
        return;
    }
    const KeptList<Cycle>& binned = binner_->frames_binned();
    for (std::size_t f = binned.first(); f < result.frames.size(); ++f) {
        result.frames[f].preprocessed = binned[f];
    }
    result.binning_cycles = ratio_of(binner_->stats().pairs, binner_->config().pairs_per_cycle);
    using P = ProjectionUnit::Stats;
    const Cycle projecting =
        std::max(sum_of(projection_, &P::project_busy), sum_of(projection_, &P::shade_busy));
    add_stage(result,
              {"projection", "Projection Units; projecting and shading overlap, the busier counts.",
               false, 1},
              projection_.size(), projecting, Counters().add(projection_));
    add_stage(result, {"sorting", "Sorting Units; waiting for memory is not busy."},
              sorting_.size(), sum_of(sorting_, &SortingUnit::Stats::sort_busy),
              Counters().add(sorting_));
    using H = HierarchicalSorter::Stats;
    const Cycle hierarchical =
        std::max(sum_of(hierarchical_, &H::coarse_busy), sum_of(hierarchical_, &H::fine_busy));
    if (!hierarchical_.empty() &&
        sum_of(hierarchical_, &H::coarse_busy) < sum_of(hierarchical_, &H::fine_busy)) {
        result.idle_keys.emplace_back("sorting.keys_per_cycle"); // the rate of the coarse step
    }
    add_stage(result,
              {"sorting", "Hierarchical Sorters; the two steps overlap, the busier counts."},
              hierarchical_.size(), hierarchical, Counters().add(hierarchical_));
    if (binner_->config().more_pairs() != 0) {
        add_activity(result, "binning",
                     real_of(binner_->stats().busy) * binner_->config().more_pairs());
    }
    if (binner_->config().sram_bytes() != 0) {
        BufferUse& buffer =
            add_buffer(result, {"binning_buffer", "List entries that wait, and ends of lists."},
                       binner_->config().sram_bytes());
        binner_->stats().describe(buffer.counters);
        add_activity(result, "binning_buffer", binner_->sram_bytes_moved());
    }
    add_activity(result, "projection", projecting);
    add_activity(result, "sorting",
                 sum_of(sorting_, &SortingUnit::Stats::sort_busy) + hierarchical);
}

std::uint64_t TileFrontEnd::keys_moved() const {
    using H = HierarchicalSorter::Stats;
    return 2 * (sum_of(sorting_, &SortingUnit::Stats::keys) + sum_of(hierarchical_, &H::keys) +
                sum_of(hierarchical_, &H::keys_sorted));
}

} // namespace degs
