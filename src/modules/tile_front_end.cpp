// SPDX-License-Identifier: Apache-2.0
#include "modules/tile_front_end.hpp"

#include "modules/collect.hpp"

namespace degs {
namespace {

// Frame tokens are wires, not buffers: deep enough never to push back.
constexpr int kTokenDepth = 64;

} // namespace

TileFrontEnd::TileFrontEnd(const sc_core::sc_module_name& name, const Config& config,
                           const Timebase& time, const RenderJob& job)
    : sc_core::sc_module(name), sorted("sorted", static_cast<std::size_t>(config.sorting.count)),
      frame_free("frame_free",
                 gated(config, job) ? static_cast<std::size_t>(config.projection.count) : 0) {
    if (config.instant) {
        build_sources(config, time, job);
    } else {
        build_units(config, time, job);
    }
}

void TileFrontEnd::build_sources(const Config& config, const Timebase& time, const RenderJob& job) {
    const auto count = static_cast<std::size_t>(config.sorting.count);
    for (std::size_t i = 0; i < count; ++i) {
        sources_.push_back(
            std::make_unique<ListSource>(numbered("lists", i).c_str(), time, job, i, count));
        sources_.back()->sorted.bind(sorted[i]);
    }
}

void TileFrontEnd::build_units(const Config& config, const Timebase& time, const RenderJob& job) {
    const auto sorters = static_cast<std::size_t>(config.sorting.count);
    const int waits_for = frame_free.size() == 0 ? 0 : config.frames_in_flight;
    binner_ = std::make_unique<TileBinner>(
        "binner", config.binning, config.traffic, time, job, config.projection.chunk,
        static_cast<std::size_t>(config.projection.count), sorters);
    for (int i = 0; i < config.projection.count; ++i) {
        const auto unit = static_cast<std::size_t>(i);
        projection_.push_back(std::make_unique<ProjectionUnit>(numbered("projection", unit).c_str(),
                                                               config.projection, config.traffic,
                                                               time, job, i, waits_for));
        auto& chunks = add_ring(projected_, "projected", time, 4, 1);
        projection_.back()->out.bind(chunks);
        binner_->in[unit].bind(chunks);
        if (waits_for != 0) {
            projection_.back()->frame_free[0].bind(frame_free[unit]);
        }
    }
    for (std::size_t i = 0; i < sorters; ++i) {
        sorting_.push_back(std::make_unique<SortingUnit>(
            numbered("sorting", i).c_str(), config.sorting, config.traffic, time, job,
            static_cast<int>(i), config.sort_capacity));
        auto& frames = add_ring(frames_, "frames", time, kTokenDepth, 1);
        binner_->out[i].bind(frames);
        sorting_.back()->start.bind(frames);
        sorting_.back()->sorted.bind(sorted[i]);
    }
}

void TileFrontEnd::connect_memory(MemoryStreams& streams,
                                  const std::vector<std::unique_ptr<SplatFetcher>>& fetchers) {
    for (auto& unit : projection_) {
        streams.connect(unit->geometry, "geometry");
        streams.connect(unit->sh, "sh");
    }
    if (binner_) {
        streams.connect(binner_->splats, "splats_written");
        streams.connect(binner_->lists, "tile_lists_written");
    }
    for (std::size_t i = 0; i < std::max(sorting_.size(), fetchers.size()); ++i) {
        if (i < sorting_.size()) {
            streams.connect(sorting_[i]->lists, "tile_lists_sorted");
        }
        if (i < fetchers.size()) {
            streams.connect(fetchers[i]->records, "splats_read");
        }
    }
}

void TileFrontEnd::collect(AcceleratorResult& result) const {
    if (!binner_) {
        return;
    }
    for (std::size_t f = 0; f < result.frames.size(); ++f) {
        result.frames[f].preprocessed = binner_->frames_binned()[f];
    }
    using P = ProjectionUnit::Stats;
    // Projecting and shading overlap: the unit is as busy as the busier of the two.
    add_stage(result, "projection", projection_.size(),
              std::max(sum_of(projection_, &P::project_busy), sum_of(projection_, &P::shade_busy)),
              {{"gaussians", sum_of(projection_, &P::gaussians)},
               {"visible", sum_of(projection_, &P::visible)}});
    using S = SortingUnit::Stats;
    add_stage(result, "sorting", sorting_.size(), sum_of(sorting_, &S::sort_busy),
              {{"keys", sum_of(sorting_, &S::keys)},
               {"memory_passes", sum_of(sorting_, &S::memory_passes)}});
}

} // namespace degs
