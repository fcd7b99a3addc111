// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/frame_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "modules/kit/analytic/ring_dates.hpp"

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

/// A Splat Fetcher, which is as far ahead of what is in work as it has places for chunks.
class Fetcher {
public:
    explicit Fetcher(const AnalyticModel::Places& places)
        : splats_(places.splats), chunks_(places.chunks), free_(places.chunks) {}
    /// When the first chunk of the next list may be asked for.
    double ready() const { return free_.oldest(); }
    /// A list of `entries` is in work from `begin` to `over`, which takes the first `walked`. The
    /// fetcher learns then that nobody takes the others, for which it has filled its places.
    void take(double entries, double walked, double begin, double over) {
        const double all = std::ceil(entries / splats_);
        const double taken = std::ceil(std::min(walked, entries) / splats_);
        for (double chunk = 1; chunk <= taken; ++chunk) {
            free_.replace_oldest(begin + (over - begin) * chunk / taken);
        }
        const double left = std::min(all - taken, static_cast<double>(chunks_));
        for (double chunk = 0; chunk < left; ++chunk) {
            free_.replace_oldest(over);
        }
    }

private:
    double splats_;
    std::size_t chunks_;
    RingDates free_;
};

} // namespace

double schedule(const AnalyticModel& model, const std::vector<ScheduledTile>& tiles,
                UnitCycles used) {
    const bool grants = model.grants_lists();
    std::vector<Sorter> sorters(std::max(model.sorters(), 1));
    // A fetcher follows each sorter, or each engine has its own.
    std::vector<Fetcher> fetchers(grants ? model.engines() : sorters.size(),
                                  Fetcher(model.places()));
    std::vector<double> engine_free(model.engines(), 0);
    double granted = 0; ///< the tile before
    double end = *std::max_element(used.begin(), used.end());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const ScheduledTile& tile = tiles[t];
        const TileCycles& cycles = tile.cycles;
        Sorter& sorter = sorters[t % sorters.size()];
        const auto sort = model.sort_cycles(tile.entries, cycles.walked);
        auto engine = std::min_element(engine_free.begin(), engine_free.end());
        Fetcher& fetcher = fetchers[grants ? engine - engine_free.begin() : t % sorters.size()];
        const double begun = sorter.begin(sort);
        double sorted = begun + sort.all - sort.first_step;
        double fetched = 0;
        if (grants) { // in turn
            sorted = sorter.complete(sort, begun);
            sorter.taken = std::max(sorted, granted);
            granted = fetched = std::max(sorter.taken, fetcher.ready());
        } else {
            fetched = std::max(begun + sort.first - sort.first_step, fetcher.ready());
            sorter.free = std::max(sorted, fetched); // the next list waits for its turn
        }
        const double begin = std::max(*engine, fetched + model.memory_latency());
        double over = std::max(begin + cycles.time, sorted);
        for (std::size_t u = 0; u < used.size(); ++u) {
            used[u] += cycles.busy[u];
            over = std::max(over, used[u]);
        }
        *engine = over;
        fetcher.take(tile.entries, cycles.walked, begin, over);
        end = std::max(end, over);
    }
    return end;
}

} // namespace degs
