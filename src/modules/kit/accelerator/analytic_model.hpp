// SPDX-License-Identifier: Apache-2.0
// What an accelerator says about the time of a frame without being simulated. docs/analytic.md
// explains the method.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cost/run_energy.hpp"
#include "modules/kit/config/main_memory_config.hpp"
#include "splat/frame/coarse_tile.hpp"

namespace degs {

/// Cycles by kind of unit, in the order of AnalyticModel::units(): how long all units of the kind
/// together are busy at the least.
constexpr std::size_t kMostAnalyticUnits = 8;
using UnitCycles = std::array<double, kMostAnalyticUnits>;

/// What the blocks of a design do, counted in an order of its own; energy follows these counts.
constexpr std::size_t kMostAnalyticCounts = 8;
using WorkCounts = std::array<double, kMostAnalyticCounts>;

/// The cycles, bytes and counts that a tile takes.
struct TileCycles {
    double time = 0;   ///< in which its engine works on it, if splats are there
    double walked = 0; ///< splats of the list that are needed
    UnitCycles busy{};
    double slots = 0;     ///< PE-cycles in which a task is executed
    double fragments = 0; ///< of them those that are blended
    double bytes = 0;     ///< moved to and from memory
    double written = 0;   ///< of them, the bytes to memory
    double pixels = 0;    ///< inside the image
    double fetched = 0;   ///< splats of the list that come from memory
    double sorting = 0;   ///< cycles of a sorter, of the busier one of its steps
    double keys = 0;      ///< that sorters read and write
    WorkCounts counts{};
};

/// Follows tiles through a design by recurrences over their splats. Tiles of similar lists come one
/// after the other, and each finds the units as the one before left them.
class TileClock {
public:
    virtual ~TileClock() = default;
    /// Is called before the first splat of `tile`.
    virtual void begin(const CoarseTile& tile) = 0;
    /// Is called when `tile` has solved a splat and not blended it yet.
    virtual void splat(const CoarseTile& tile) = 0;
    /// Is called after the last splat; returns what the tile took.
    virtual TileCycles end(const CoarseTile& tile) = 0;
};

/// The cycles of everything before the first tile.
struct PreparationCycles {
    double time = 0; ///< until the lists of the frame are complete
    UnitCycles busy{};
    double bytes = 0;         ///< moved, reads and writes
    double written = 0;       ///< of them, the bytes to memory
    double binning = 0;       ///< cycles of the binner
    double binning_bytes = 0; ///< to and from its SRAM
};

/// How far simulated cycles lie from a model's estimate, relative to it: from `below` under it to
/// `above` over it on views whose work many tiles carry and one kind of unit limits.
struct EstimateErrors {
    double below = 0, above = 0;
};

/// One design: kinds of units, and how to work out their cycles.
class AnalyticModel {
public:
    virtual ~AnalyticModel() = default;
    /// Names, at most kMostAnalyticUnits; the last is "memory".
    virtual std::vector<std::string> units() const = 0;
    virtual PreparationCycles preparation(const FrameWorkload& frame) const = 0;
    virtual std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const = 0;
    /// How a CoarseTile samples a tile for the clock.
    virtual CoarseTile::Options coarse_options() const = 0;
    /// How rows may be left out of a tile: of blocks of `height` rows one in up to `most_apart` is
    /// sampled, and of that every `step`-th row. One in up to `most_fitted` is enough where a fit
    /// to simulated tiles takes out the bias; 0: no fewer than for an estimate.
    struct Blocks {
        int height = 1, most_apart = 1, step = 1, most_fitted = 0;
    };
    virtual Blocks blocks() const = 0;
    /// Host time of the clock for a row of a splat, relative to that of most clocks.
    virtual double visit_cost() const { return 1; }
    /// Host time of the clock for a splat without a sampled row, relative to that of most clocks.
    virtual double visits_per_entry() const { return 1; }
    /// Units that sort lists, in turn; 0: lists come sorted.
    virtual int sorters() const { return 0; }
    /// Cycles of a sorter on a list: until its first splats may be fetched, and in all.
    struct SortCycles {
        double first = 0, all = 0;
        double busy = 0;       ///< of the busier one of its steps
        double keys = 0;       ///< that its steps take in
        double outside = 0;    ///< passes of the list through memory
        double first_step = 0; ///< of `first`, in which the list before may be in the second step
        double run = 0;        ///< of the second step, on what leaves the sorter at a time
    };
    virtual SortCycles sort_cycles(double /*entries*/, double /*walked*/) const { return {}; }
    /// Whether lists are granted to engines in turn when they are complete, as the Tile Dispatcher
    /// does; else splats are fetched while their list is being sorted.
    virtual bool grants_lists() const { return engines() > 1; }
    /// Chunks of splats that a fetcher may have, those in work among them, and splats of a chunk;
    /// without an answer a list is one chunk.
    struct Places {
        std::size_t chunks = 1;
        double splats = 1e9;
    };
    virtual Places places() const { return {}; }
    /// Tiles in work side by side; each is given to the first one that is free.
    virtual int engines() const { return 1; }
    virtual double memory_latency() const = 0; ///< cycles
    /// Bytes and memory cycles of pixels of tiles that list no splat.
    virtual TileCycles background(double pixels) const = 0;
    /// Cycles from complete lists to the first task, and from the last task to the last pixel in
    /// memory.
    virtual double latency() const = 0;
    virtual int pes() const = 0;
    /// What every block of the bill of materials does for the frame. `tiles`: sums of all tiles.
    virtual std::vector<cost::Activity> activity(const FrameWorkload& frame,
                                                 const PreparationCycles& before,
                                                 const TileCycles& tiles) const = 0;
    virtual const MainMemoryConfig& main_memory() const = 0;
    /// Measured against simulations (docs/analytic.md); empty: nobody has.
    virtual std::optional<EstimateErrors> errors() const { return {}; }
};

} // namespace degs
