// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/frame_schedule.hpp"

#include <algorithm>

namespace degs {

namespace {

using SortCycles = AnalyticModel::SortCycles;

/// A sorter with two steps. A list may wait between them.
struct Sorter {
    double first_step_free = 0;
    double free = 0;      ///< the second step
    double collected = 0; ///< the list before: all of it is with its collector
    double taken = 0;     ///< the list before: it is with the dispatcher

    /// The date at which the second step begins with a list.
    double begin(const SortCycles& list) {
        const double first_step = first_step_free + list.first_step;
        const double begun = std::max(first_step, free);
        first_step_free = begun;
        return begun;
    }
    /// The date at which all of a list is with its collector, which takes it when the dispatcher
    /// has taken the one before. Until then a run of the list waits in the FIFO to the collector,
    /// and the next one in the sorter.
    double complete(const SortCycles& list, double begun) {
        const double second_step = list.all - list.first_step;
        const double sorted = begun + second_step;
        const double all = std::max(sorted, taken + std::max(0.0, second_step - 2 * list.run));
        free = second_step > list.run ? all : std::max(sorted, collected);
        collected = all;
        return all;
    }
};

} // namespace

double schedule(const AnalyticModel& model, const std::vector<ScheduledTile>& tiles,
                UnitCycles used) {
    const bool grants = model.grants_lists();
    std::vector<Sorter> sorters(std::max(model.sorters(), 1));
    std::vector<double> fetcher_free(sorters.size(), 0);
    std::vector<double> engine_free(model.engines(), 0), engine_fetches(model.engines(), 0);
    double granted = 0; ///< the tile before
    double end = *std::max_element(used.begin(), used.end());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const ScheduledTile& tile = tiles[t];
        const TileCycles& cycles = tile.cycles;
        Sorter& sorter = sorters[t % sorters.size()];
        const auto sort = model.sort_cycles(tile.entries, cycles.walked);
        auto engine = std::min_element(engine_free.begin(), engine_free.end());
        // A fetcher follows each sorter, or each engine has its own.
        double& fetcher = grants ? engine_fetches[engine - engine_free.begin()]
                                 : fetcher_free[t % sorters.size()];
        const double begun = sorter.begin(sort);
        double sorted = begun + sort.all - sort.first_step;
        double fetched = 0;
        if (grants) { // in turn
            sorted = sorter.complete(sort, begun);
            sorter.taken = std::max(sorted, granted);
            granted = fetched = std::max(sorter.taken, fetcher);
        } else {
            fetched = std::max(begun + sort.first - sort.first_step, fetcher);
            sorter.free = std::max(sorted, fetched); // the next list waits for its turn
        }
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
