// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/frame_schedule.hpp"

#include <algorithm>

namespace degs {

double schedule(const AnalyticModel& model, const std::vector<ScheduledTile>& tiles,
                UnitCycles used) {
    const std::size_t sorters = std::max(model.sorters(), 1);
    // A list may wait between both steps of a sorter.
    std::vector<double> first_step_free(sorters, 0), list_taken(sorters, 0);
    std::vector<double> sorter_free(sorters, 0), fetcher_free(sorters, 0);
    std::vector<double> engine_free(model.engines(), 0), engine_fetches(model.engines(), 0);
    double granted = 0; ///< the tile before
    double end = *std::max_element(used.begin(), used.end());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const ScheduledTile& tile = tiles[t];
        const TileCycles& cycles = tile.cycles;
        const std::size_t sorter = t % sorters;
        const auto sort = model.sort_cycles(tile.entries, cycles.walked);
        auto engine = std::min_element(engine_free.begin(), engine_free.end());
        // With one engine a fetcher follows each sorter, else each engine has its own.
        double& fetcher = engine_free.size() == 1 ? fetcher_free[sorter]
                                                  : engine_fetches[engine - engine_free.begin()];
        const double first_step = first_step_free[sorter] + sort.first_step;
        first_step_free[sorter] = std::max(first_step, list_taken[sorter]);
        list_taken[sorter] = std::max(first_step, sorter_free[sorter]);
        const double sorted = list_taken[sorter] + sort.all - sort.first_step;
        double fetched = std::max(list_taken[sorter] + sort.first - sort.first_step, fetcher);
        if (engine_free.size() > 1) { // engines are granted tiles in turn
            granted = fetched = std::max(fetched, granted);
        }
        sorter_free[sorter] = std::max(sorted, fetched); // the next list waits for its turn
        const double begin = std::max(*engine, fetched + model.memory_latency());
        double over = std::max(begin + cycles.time, sorted);
        for (std::size_t u = 0; u < used.size(); ++u) {
            used[u] += cycles.busy[u];
            over = std::max(over, used[u]);
        }
        *engine = over;
        const double ahead =
            cycles.walked > 0 ? std::min(1.0, model.places() / cycles.walked) : 1.0;
        fetcher = over - ahead * (over - begin);
        end = std::max(end, over);
    }
    return end;
}

} // namespace degs
