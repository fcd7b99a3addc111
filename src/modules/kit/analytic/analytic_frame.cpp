// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/analytic/analytic_frame.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/parallel.hpp"
#include "base/ratio.hpp"
#include "modules/kit/analytic/frame_schedule.hpp"

namespace degs {
namespace {

/// Entries of lists and rows of splats that are looked at, which bounds the time: some 20 ns each
/// for most clocks.
constexpr double kVisits = 900e3;
/// A view of few and long lists exceeds kVisits rather than rest on fewer tiles than these.
constexpr double kLeastTiles = 72;
/// Chains of tiles that are followed one after the other; blocks of work for the host's processors.
constexpr std::size_t kChains = 2;

struct Listed {
    int tile;
    std::size_t turn; ///< among the tiles that list a splat, in the order of rendering
    double entries;
};

/// Tiles that list a splat, in the order of the lengths of their lists.
std::vector<Listed> tiles_by_length(const FrameWorkload& frame, TileOrder order) {
    std::vector<Listed> tiles;
    for (const int tile : listed_tiles(frame, order)) {
        const std::uint64_t entries = frame.tile_begin[tile + 1] - frame.tile_begin[tile];
        tiles.push_back({tile, tiles.size(), static_cast<double>(entries)});
    }
    std::stable_sort(tiles.begin(), tiles.end(),
                     [](const Listed& a, const Listed& b) { return a.entries < b.entries; });
    return tiles;
}

/// One block of rows in so many: as few as it takes to afford all tiles, as long as a splat has a
/// sampled row or so on each of its tiles.
int rows_apart(const AnalyticModel& model, const EntrySizes& sizes, double entries) {
    const AnalyticModel::Blocks blocks = model.blocks();
    const double most = kVisits / model.visit_cost();
    int apart = 1;
    while (entries * (model.visits_per_entry() + sizes.visits / apart) > most &&
           2 * apart <= blocks.most_apart && 2 * apart <= sizes.rows) {
        apart *= 2;
    }
    return apart;
}

/// A systematic sample, in the order of the lengths of the lists, in which the chance of a tile
/// follows the root of its length: long lists take more time and differ more among themselves.
/// It has as many tiles as kVisits affords if a visit costs `cost`, and kLeastTiles / cost of them
/// or all in any case, so that they are spread over the lengths. Their places in `tiles`.
std::vector<std::size_t> choose(const std::vector<Listed>& tiles, double visits_per_entry,
                                double cost) {
    const double least = std::min(kLeastTiles / cost, static_cast<double>(tiles.size()));
    const auto is_too_many = [&](double apart) {
        double visits = 0, drawn = 0;
        for (const Listed& tile : tiles) {
            const double chance = std::min(1.0, std::sqrt(tile.entries) / apart);
            drawn += chance;
            visits += chance * tile.entries * visits_per_entry;
        }
        return visits > kVisits / cost && drawn > least;
    };
    double apart = 1e-9, most = 1e9; // between two chosen tiles, in roots of lengths
    for (int step = 0; step < 40 && is_too_many(apart) && most / apart > 1.01; ++step) {
        const double middle = std::sqrt(apart * most);
        (is_too_many(middle) ? apart : most) = middle;
    }
    std::vector<std::size_t> chosen;
    double place = 0.5;
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        place += std::min(1.0, std::sqrt(tiles[t].entries) / apart);
        if (place >= 1) {
            place -= 1;
            chosen.push_back(t);
        }
    }
    if (chosen.empty() && !tiles.empty()) {
        chosen.push_back(tiles.size() / 2);
    }
    return chosen;
}

TileCycles scaled(const TileCycles& tile, double factor) {
    TileCycles result = tile;
    for (double* value :
         {&result.time, &result.walked, &result.slots, &result.fragments, &result.bytes,
          &result.written, &result.pixels, &result.fetched, &result.sorting, &result.keys}) {
        *value *= factor;
    }
    for (double& count : result.counts) {
        count *= factor;
    }
    for (double& cycles : result.busy) {
        cycles *= factor;
    }
    return result;
}

void add(TileCycles& sum, const TileCycles& tile) {
    sum.slots += tile.slots;
    sum.fragments += tile.fragments;
    sum.bytes += tile.bytes;
    sum.written += tile.written;
    sum.walked += tile.walked;
    sum.pixels += tile.pixels;
    sum.fetched += tile.fetched;
    sum.sorting += tile.sorting;
    sum.keys += tile.keys;
    for (std::size_t c = 0; c < kMostAnalyticCounts; ++c) {
        sum.counts[c] += tile.counts[c];
    }
    for (std::size_t u = 0; u < kMostAnalyticUnits; ++u) {
        sum.busy[u] += tile.busy[u];
    }
}

/// For each of `tiles` the nearest drawn one, as a place in `chosen`.
std::vector<std::size_t> nearest_drawn(std::size_t tiles, const std::vector<std::size_t>& chosen) {
    std::vector<std::size_t> result(tiles);
    std::size_t nearest = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
        while (nearest + 1 < chosen.size() && chosen[nearest] + chosen[nearest + 1] <= 2 * t) {
            ++nearest;
        }
        result[t] = nearest;
    }
    return result;
}

/// All tiles in the order of rendering; one that was not drawn takes what the nearest drawn one
/// takes, per entry of its list.
std::vector<ScheduledTile> all_tiles(const std::vector<Listed>& tiles,
                                     const std::vector<std::size_t>& chosen,
                                     const std::vector<std::size_t>& nearest,
                                     const std::vector<TileCycles>& cycles) {
    std::vector<ScheduledTile> result(tiles.size());
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        const double like = tiles[chosen[nearest[t]]].entries;
        result[tiles[t].turn] = {tiles[t].entries,
                                 scaled(cycles[nearest[t]], tiles[t].entries / like)};
    }
    return result;
}

/// The standard error of the sum of the tiles' times over the sum, because tiles take what others
/// take per entry. How much tiles differ that stand beside each other in the order of their lists
/// is known from drawn neighbours (successive differences; Wolter, Introduction to Variance
/// Estimation, 2007, chapter 8).
double drawing_error(const std::vector<Listed>& tiles, const std::vector<std::size_t>& chosen,
                     const std::vector<std::size_t>& nearest,
                     const std::vector<TileCycles>& cycles) {
    const std::size_t drawn = chosen.size();
    if (drawn == tiles.size() || drawn < 2) {
        return 0;
    }
    std::vector<double> others(drawn, 0), squares(drawn, 0); // entries of tiles that are like one
    for (std::size_t t = 0; t < tiles.size(); ++t) {
        if (chosen[nearest[t]] != t) {
            others[nearest[t]] += tiles[t].entries;
            squares[nearest[t]] += tiles[t].entries * tiles[t].entries;
        }
    }
    const auto rate = [&](std::size_t c) { return cycles[c].time / tiles[chosen[c]].entries; };
    double sum = 0, variance = 0;
    for (std::size_t c = 0; c < drawn; ++c) {
        double differences = 0;
        for (const std::size_t other : {c == 0 ? 1 : c - 1, c + 1 == drawn ? c - 1 : c + 1}) {
            differences += (rate(c) - rate(other)) * (rate(c) - rate(other)) / 4;
        }
        variance += differences * (others[c] * others[c] + squares[c]);
        sum += cycles[c].time + rate(c) * others[c];
    }
    return sum == 0 ? 0 : std::sqrt(variance) / sum;
}

/// (Sum of the times)^2 / sum of their squares: the number of tiles if all times are equal, and 1
/// if one tile takes all the time.
double carrying(const std::vector<ScheduledTile>& tiles) {
    double sum = 0, squares = 0;
    for (const ScheduledTile& tile : tiles) {
        sum += tile.cycles.time;
        squares += tile.cycles.time * tile.cycles.time;
    }
    return squares == 0 ? 0 : sum * sum / squares;
}

/// The errors of a model and of drawing tiles, independent of each other, and what is added to
/// them: where few tiles carry the work, how they come one after the other decides; where no kind
/// of unit is busy all the time, units overlap better than a tile alone shows. Measured for all
/// accelerators together (docs/analytic.md).
CycleInterval interval_of(const AnalyticFrame& frame, const EstimateErrors& errors) {
    constexpr double kFewBelow = 0.05, kFewAbove = 0.15, kIdleBelow = 0.15;
    const double few = frame.carrying_tiles > 0 ? 1 / std::sqrt(frame.carrying_tiles) : 1;
    constexpr double kNineInTen = 1.645; // standard errors on either side
    const double drawing = kNineInTen * frame.drawing_error;
    const double below =
        std::hypot(errors.below, drawing) + kFewBelow * few + kIdleBelow * (1 - frame.busiest);
    const double above = std::hypot(errors.above, drawing) + kFewAbove * few;
    return {frame.cycles * std::exp(-below), frame.cycles * std::exp(above)};
}

/// Pixels of the tiles that list no splat.
double background_pixels(const FrameWorkload& frame) {
    const TileGrid grid = frame.grid();
    double pixels = 0;
    for (int tile = 0; tile < frame.tiles(); ++tile) {
        if (frame.tile_begin[tile] == frame.tile_begin[tile + 1]) {
            const PixelBox inside = grid.image_pixels_of(tile);
            pixels += 1.0 * inside.width() * inside.height();
        }
    }
    return pixels;
}

} // namespace

AnalyticFrame estimate_frame(const AnalyticModel& model, const FrameWorkload& frame,
                             TileOrder order) {
    const std::vector<Listed> tiles = tiles_by_length(frame, order);
    const AnalyticModel::Blocks blocks = model.blocks();
    const EntrySizes sizes = entry_sizes(frame, blocks.step);
    const int apart = rows_apart(model, sizes, real_of(frame.tile_pairs()));
    const std::vector<std::size_t> chosen =
        choose(tiles, model.visits_per_entry() + sizes.visits / apart, model.visit_cost());

    std::vector<TileCycles> cycles(chosen.size());
    const std::size_t chains = std::min(kChains, chosen.size());
    parallel_blocks(chains, [&](std::size_t chain, std::size_t) {
        CoarseTile tile(frame, model.coarse_options());
        const std::unique_ptr<TileClock> clock = model.clock(frame);
        for (std::size_t c = chain; c < chosen.size(); c += chains) {
            // The first sampled block changes from tile to tile, so that no rows are preferred.
            const int first = static_cast<int>(c) * 5 % apart;
            tile.begin(tiles[chosen[c]].tile, {blocks.height, apart, first, blocks.step});
            clock->begin(tile);
            while (tile.next()) {
                clock->splat(tile);
                tile.blend();
            }
            cycles[c] = clock->end(tile);
            cycles[c].pixels = tile.pixels();
        }
    });

    const std::vector<std::size_t> nearest = nearest_drawn(tiles.size(), chosen);
    const std::vector<ScheduledTile> scheduled = all_tiles(tiles, chosen, nearest, cycles);
    const TileCycles background = model.background(background_pixels(frame));
    TileCycles sum = background;
    for (const ScheduledTile& tile : scheduled) {
        add(sum, tile.cycles);
    }
    const PreparationCycles before = model.preparation(frame);
    AnalyticFrame result;
    result.tiles = tiles.size();
    result.drawn = chosen.size();
    result.rows_apart = apart;
    result.carrying_tiles = carrying(scheduled);
    result.preparation = before.time;
    const double rendering = schedule(model, scheduled, background.busy);
    result.cycles = before.time + model.latency() + rendering;
    result.drawing_error =
        drawing_error(tiles, chosen, nearest, cycles) * rendering / result.cycles;
    result.bytes = before.bytes + sum.bytes;
    result.written = before.written + sum.written;
    result.activity = model.activity(frame, before, sum);
    result.utilization = rendering == 0 ? 0 : sum.fragments / (rendering * model.pes());
    const std::vector<std::string> names = model.units();
    double longest = 0, longest_before = 0;
    for (std::size_t u = 0; u < names.size(); ++u) {
        result.units.push_back({names[u], before.busy[u], sum.busy[u]});
        result.upper += before.busy[u] + sum.busy[u];
        longest_before = std::max(longest_before, before.busy[u]);
        if (sum.busy[u] > longest) {
            longest = sum.busy[u];
            result.limited_by = names[u];
        }
    }
    result.lower = longest_before + longest;
    result.busiest = rendering == 0 ? 1 : std::min(1.0, longest / rendering);
    if (const std::optional<EstimateErrors> errors = model.errors()) {
        result.interval = interval_of(result, *errors);
    }
    return result;
}

} // namespace degs
