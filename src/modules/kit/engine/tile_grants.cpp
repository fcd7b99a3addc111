// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/engine/tile_grants.hpp"

#include "tlm/rings.hpp"

namespace degs {

TileGrants::TileGrants(TileFrontEnd& front_end,
                       const std::vector<std::unique_ptr<SplatFetcher>>& fetchers, int cycles,
                       const Timebase& time, const RenderJob& job) {
    const std::size_t sorters = front_end.sorted.size();
    dispatcher_ =
        std::make_unique<TileDispatcher>("dispatcher", time, job, sorters, fetchers.size());
    for (std::size_t i = 0; i < sorters; ++i) {
        auto& lists = add_ring(sorted_rings_, "sorted", time, 1, 1);
        front_end.sorted[i].bind(lists);
        collectors_.push_back(
            std::make_unique<ListCollector>(numbered("collector", i).c_str(), time, job));
        collectors_[i]->in.bind(lists);
        auto& complete = add_ring(list_rings_, "list", time, 1, 1);
        collectors_[i]->out.bind(complete);
        dispatcher_->in[i].bind(complete);
    }
    for (std::size_t e = 0; e < fetchers.size(); ++e) {
        auto& requests = add_ring(request_rings_, "request", time, 2, cycles);
        fetchers[e]->request[0].bind(requests);
        dispatcher_->request[e].bind(requests);
        auto& grants = add_ring(grant_rings_, "grant", time, 2, cycles);
        dispatcher_->out[e].bind(grants);
        fetchers[e]->sorted.bind(grants);
    }
}

} // namespace degs
