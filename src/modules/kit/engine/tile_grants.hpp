// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "modules/kit/engine/tile_front_end.hpp"
#include "modules/kit/front_end/list_collector.hpp"
#include "modules/kit/front_end/splat_fetcher.hpp"
#include "modules/kit/front_end/tile_dispatcher.hpp"
#include "modules/kit/job/message_rings.hpp"

namespace degs {

/// What lies between sorted lists and Splat Fetchers that each work on a tile of their own: a List
/// Collector per sorter, the Tile Dispatcher, and the rings between them.
class TileGrants {
public:
    /// Binds `sorted` of the front end, and `sorted` and `request` of the fetchers.
    TileGrants(TileFrontEnd& front_end, const std::vector<std::unique_ptr<SplatFetcher>>& fetchers,
               int cycles, const Timebase& time, const RenderJob& job);

    const TileDispatcher& dispatcher() const { return *dispatcher_; }

private:
    template <class T>
    using Rings = std::vector<std::unique_ptr<DatedFifo<T>>>;

    std::unique_ptr<TileDispatcher> dispatcher_;
    std::vector<std::unique_ptr<ListCollector>> collectors_;
    Rings<SortedRun> sorted_rings_, list_rings_, grant_rings_;
    Rings<TileRequest> request_rings_;
};

} // namespace degs
