// SPDX-License-Identifier: Apache-2.0
// DeGS without simulation: slicing, spans and banks as queues with rates. See docs/analytic.md.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "modules/degs/analytic_bank.hpp"
#include "modules/degs/config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"

namespace degs {
namespace {

/// Dates at which the cells of a ring are free again, oldest first.
class RingDates {
public:
    explicit RingDates(int cells = 1) : dates_(cells, 0) {}
    double oldest() const { return dates_[next_]; }
    void replace_oldest(double date) {
        dates_[next_] = date;
        next_ = next_ + 1 == dates_.size() ? 0 : next_ + 1;
    }

private:
    std::vector<double> dates_;
    std::size_t next_ = 0;
};

class DegsAnalytic : public FrontEndModel {
public:
    explicit DegsAnalytic(const DegsConfig& config)
        : FrontEndModel(config, config.gaussian_chunks(), kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "slicing", "span", "packing", "blending", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options drawing() const override {
        return {config_.scheduler.segment_length, 1, config_.pipeline.span_ends != SpanEnds::Exact,
                config_.pipeline.span_delta};
    }
    // Banks and Span Units own every n-th row, so rows are left out bank by bank. Those that have
    // more to do than others hold these up, which only shows if enough of them are drawn.
    Blocks blocks() const override {
        constexpr int kLeastBanks = 8;
        const int banks = std::gcd(config_.scheduler.banks, config_.span.count);
        return {1, std::max(1, banks / std::max(kLeastBanks, banks / 2))};
    }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double) const override {
        return degs::sort_cycles(config_.sorting, entries, front());
    }
    int engines() const override { return config_.all_streams(); }
    double latency() const override;
    int pes() const override { return config_.pes(); }
    std::vector<cost::Activity> activity(const FrameWorkload& frame,
                                         const PreparationCycles& before,
                                         const TileCycles& tiles) const override;

    enum Count : std::size_t { kSlices, kTaken, kRows, kIssues, kSegments, kFeatures };
    enum Unit : std::size_t { kSlicing = kArrayUnits, kSpan, kPacking, kBlending, kMemory };
    const DegsConfig& config() const { return config_; }

private:
    DegsConfig config_;
};

/// A tile is a stream of rows through the Slicing Units, a lane of the Span Buffer, a Span Unit and
/// the queue of a bank. A segment leaves the bank when the PEs before it have had their tasks and
/// its region may be updated again; a full ring holds up whatever is before it.
class DegsClock : public TileClock {
public:
    DegsClock(const DegsAnalytic& model, const FrameWorkload& frame);
    void begin(const CoarseTile& tile) override;
    void splat(const CoarseTile& tile) override;
    TileCycles end(const CoarseTile& tile) override;

private:
    struct Bank {
        AnalyticBank queue;
        double cut = 0;          ///< when the next segment may be cut
        std::uint64_t splat = 0; ///< the last one with a segment in it, from 1
    };
    struct Lane {
        RingDates rows;
        double free = 0; ///< when its Span Unit has solved the rows so far
    };
    bool has_live_segment(const CoarseTile& tile, const CoarseSpan& span) const;
    double choose_rows(const CoarseTile& tile);
    void supply();
    double solve_row(int row, double sliced);
    void segment(const CoarseTile& tile, const CoarseSpan& span, double solved);
    double tasks_of(const CoarseTile& tile, const CoarseSpan& part) const;
    double with_other_streams(double alone, double shared) const;
    double queue_segment(Bank& bank, double arrived);

    const DegsAnalytic& model_;
    const DegsConfig& config_;
    std::vector<Bank> banks_;
    std::vector<Lane> lanes_;
    std::vector<double> finished_; ///< when the tiles that hold the contexts are over, by turn
    std::size_t tiles_ = 0;
    std::vector<CoarseSpan> sent_; ///< rows of a splat; empty ones, too
    std::size_t segments_per_row_;
    double units_;          ///< Slicing Units of a tile
    RingDates supply_;      ///< places for chunks of splats before the Slicing Units
    double asked_ = 0;      ///< when the latest chunk was asked for
    double arrived_ = 0;    ///< and when it is there
    int left_of_chunk_ = 0; ///< splats
    double sliced_ = 0;     ///< when the Slicing Units have sent the rows so far
    double last_end_ = 0;   ///< of the tile before
    double start_ = 0;      ///< when a context is free
    double tasks_ = 0, rows_ = 0, segments_ = 0, slices_ = 0;
    double issues_ = 0;   ///< cycles of banks with an issue
    double features_ = 0; ///< splats with a segment in a bank, for every bank
    std::uint64_t splats_ = 0;
};

std::vector<cost::Activity> DegsAnalytic::activity(const FrameWorkload&,
                                                   const PreparationCycles& before,
                                                   const TileCycles& tiles) const {
    const WorkCounts& counts = tiles.counts;
    DegsWork work;
    work.slicing_cycles = counts[kSlices];
    work.issue_cycles = work.packets = counts[kIssues];
    work.splats_fetched = tiles.fetched;
    work.splats_sliced = counts[kTaken];
    work.keys_moved = tiles.keys;
    work.supplied = 2 * tiles.fetched; // through a FIFO
    work.rows_sent = work.rows = counts[kRows];
    work.features = counts[kFeatures];
    work.segments_issued = counts[kSegments];
    work.slots = tiles.slots;
    std::vector<cost::Activity> all = config_.activity(work);
    for (const cost::Activity& each : front().activity(before, tiles)) {
        all.push_back(each);
    }
    all.push_back(pixel_activity(tiles, config_.pixel_bytes()));
    return all;
}

std::unique_ptr<TileClock> DegsAnalytic::clock(const FrameWorkload& frame) const {
    return std::make_unique<DegsClock>(*this, frame);
}

double DegsAnalytic::latency() const {
    return 3 * memory_latency() + config_.span.latency_cycles + config_.packing.latency_cycles +
           config_.array.writeback_cycles;
}

DegsClock::DegsClock(const DegsAnalytic& model, const FrameWorkload& frame)
    : model_(model), config_(model.config()), lanes_(config_.span.count),
      finished_(config_.contexts(), 0),
      segments_per_row_((frame.tile_size + config_.scheduler.segment_length - 1) /
                        config_.scheduler.segment_length),
      units_(config_.slicing.units_per_module()), supply_(std::max(1, config_.gaussian_chunks())),
      asked_(-model.front().cycles_per_chunk()) {
    banks_.assign(
        config_.scheduler.banks,
        {AnalyticBank(config_.queue_depth(),
                      Segmenter::domains_per_tile(frame.tile_size, config_.scheduler.segment_length,
                                                  config_.scheduler.banks),
                      config_.scheduler.reuse_cycles, config_.scheduler.scan)});
    const int rows = config_.span_buffer.bytes / config_.span_buffer.row_bytes / config_.span.count;
    for (Lane& lane : lanes_) {
        lane.rows = RingDates(std::max(rows, 1));
    }
}

void DegsClock::begin(const CoarseTile&) {
    if (left_of_chunk_ != 0) { // the last one of a tile is not full
        supply_.replace_oldest(sliced_);
        left_of_chunk_ = 0;
    }
    start_ = finished_[tiles_ % finished_.size()];
    for (Bank& bank : banks_) {
        bank.queue.begin_tile();
    }
    tasks_ = rows_ = segments_ = slices_ = issues_ = features_ = 0;
}

// The date at which the row has been solved.
double DegsClock::solve_row(int row, double sliced) {
    Lane& lane = lanes_[row % lanes_.size()];
    const double entered = std::max(sliced, lane.rows.oldest());
    lane.free = std::max(lane.free, entered) +
                static_cast<double>(config_.span.cycles_per_row) / config_.span.rows_per_cycle;
    lane.rows.replace_oldest(lane.free);
    sliced_ = std::max(sliced_, entered); // a full lane stops all units
    return lane.free;
}

double DegsClock::queue_segment(Bank& bank, double arrived) {
    const double at = std::max({arrived, bank.cut, start_});
    bank.cut = at + 1.0 / config_.scheduler.segments_per_cycle;
    return at;
}

/// Tasks of a segment that are issued.
double DegsClock::tasks_of(const CoarseTile& tile, const CoarseSpan& part) const {
    switch (config_.scheduler.termination) {
    case TerminationGrain::Pixel:
        return part.length() * tile.live_share(part);
    case TerminationGrain::Task:
        return tile.live_share(part) == 0 ? 0 : part.length();
    default:
        return part.length();
    }
}

void DegsClock::segment(const CoarseTile& tile, const CoarseSpan& span, double solved) {
    const int length = config_.scheduler.segment_length;
    Bank& bank = banks_[span.row % banks_.size()];
    for (int s = span.first / length; s <= span.last / length; ++s) {
        double at = queue_segment(bank, solved);
        if (!tile.cell_is_live(span.row, s * length)) {
            continue;
        }
        const CoarseSpan part{span.row, std::max(span.first, s * length),
                              std::min(span.last, s * length + length - 1)};
        const double tasks = tasks_of(tile, part);
        if (tasks == 0) {
            continue;
        }
        const double taken =
            std::max(tasks / config_.array.pes_per_bank, 1.0 / config_.scheduler.issue_width);
        at = bank.queue.add(at, taken, span.row / banks_.size() * segments_per_row_ + s);
        bank.cut = std::max(bank.cut, at);
        issues_ += taken;
        features_ += bank.splat == splats_ ? 0 : 1;
        bank.splat = splats_;
        tasks_ += tasks;
        ++segments_;
        // Span Vectors wait in their unit until the bank takes them.
        Lane& lane = lanes_[span.row % lanes_.size()];
        lane.free = std::max(lane.free, at - config_.crossbar_cells());
    }
}

bool DegsClock::has_live_segment(const CoarseTile& tile, const CoarseSpan& span) const {
    const int length = config_.scheduler.segment_length;
    for (int s = span.first / length; s <= span.last / length; ++s) {
        if (tile.cell_is_live(span.row, s * length)) {
            return true;
        }
    }
    return false;
}

/// Rows that the Slicing Units send; those of the bounding box may have no pixel on the tile.
double DegsClock::choose_rows(const CoarseTile& tile) {
    sent_.clear();
    const bool tile_rows =
        config_.slicing.rows == SlicedRows::Tile || config_.slicing.skip_dead_rows;
    if (!tile_rows) {
        auto span = tile.spans().begin();
        for (int r = tile.first_drawn(); r < tile.end_drawn(); ++r) {
            const int row = tile.rows()[r];
            const bool solved = span != tile.spans().end() && span->row == row;
            sent_.push_back(solved ? *span++ : CoarseSpan{row, 0, -1});
        }
        return tile.last_row() - tile.first_row() + 1;
    }
    for (const CoarseSpan& span : tile.spans()) {
        if (!config_.slicing.skip_dead_rows || has_live_segment(tile, span)) {
            sent_.push_back(span);
        }
    }
    return tile.rows_per_drawn() * static_cast<double>(sent_.size());
}

// A chunk is asked for when there is a place for it and fewer requests are in flight than may be.
void DegsClock::supply() {
    if (left_of_chunk_ == 0) {
        const FrontEndLoad& front = model_.front();
        asked_ = std::max(asked_ + front.cycles_per_chunk() / front.fetching.chunks_in_flight,
                          supply_.oldest());
        arrived_ = asked_ + front.cycles_per_chunk();
        left_of_chunk_ = front.fetching.chunk;
    }
}

void DegsClock::splat(const CoarseTile& tile) {
    ++splats_;
    const double rows = choose_rows(tile);
    const double cycles = std::max(1.0, std::ceil(rows / config_.slicing.rows_per_cycle));
    supply();
    slices_ += cycles;
    sliced_ = std::max(sliced_, arrived_) + cycles / units_;
    if (--left_of_chunk_ == 0) {
        supply_.replace_oldest(sliced_);
    }
    rows_ += rows;
    const double sliced = sliced_;
    for (const CoarseSpan& span : sent_) {
        const double solved = solve_row(span.row, sliced);
        if (span.last >= span.first) {
            segment(tile, span, solved);
        }
    }
}

/// The tile alone takes `alone` cycles, and keeps units that all streams share busy for `shared`.
/// Tiles of several streams hold each other up most if both are about the same: between the longer
/// and the sum, the root of the third powers is nearest to simulations [calibrated,
/// docs/analytic.md].
double DegsClock::with_other_streams(double alone, double shared) const {
    const double streams = config_.streams();
    return streams == 1 ? alone
                        : streams * std::cbrt(std::pow(alone / streams, 3) + std::pow(shared, 3));
}

TileCycles DegsClock::end(const CoarseTile& tile) {
    const double left = tile.entries() - tile.walked();
    double done = 0;
    for (const Bank& bank : banks_) {
        done = std::max(done, bank.queue.done());
    }
    // The rest of the list keeps coming until the end of the last pixel is known.
    const double known = std::min(done + config_.slicing.feedback_cycles, sliced_ + left / units_);
    sliced_ = std::max(sliced_, known);
    finished_[tiles_ % finished_.size()] =
        done + config_.array.writeback_cycles + tile.pixels() / config_.pixel_buffer.readout_pixels;
    ++tiles_;
    const double drawn = tile.rows_per_drawn();
    TileCycles cycles = model_.front_end_cycles(tile, tile.walked());
    cycles.slots = drawn * tasks_;
    // Every module of a stream takes each splat.
    cycles.counts[DegsAnalytic::kSlices] =
        std::max(slices_, tile.walked() * config_.slicing.modules());
    cycles.counts[DegsAnalytic::kTaken] = tile.walked() * config_.slicing.modules();
    cycles.counts[DegsAnalytic::kRows] = rows_;
    cycles.counts[DegsAnalytic::kIssues] = drawn * issues_;
    cycles.counts[DegsAnalytic::kSegments] = drawn * segments_;
    cycles.counts[DegsAnalytic::kFeatures] = drawn * features_;
    cycles.busy[DegsAnalytic::kSlicing] = slices_ / (config_.clusters * config_.slicing.count);
    cycles.busy[DegsAnalytic::kSpan] = rows_ * config_.span.cycles_per_row /
                                       config_.span.rows_per_cycle /
                                       (config_.clusters * config_.span.count);
    cycles.busy[DegsAnalytic::kPacking] = drawn * segments_ / config_.scheduler.issue_width /
                                          (config_.clusters * config_.scheduler.banks);
    cycles.busy[DegsAnalytic::kBlending] = cycles.slots / config_.pes();
    const double behind = std::max(done - sliced_, 0.0); // cycles of the banks behind the last row
    cycles.time = with_other_streams(
        std::max(sliced_ + behind - last_end_, cycles.time),
        config_.clusters * *std::max_element(cycles.busy.begin() + DegsAnalytic::kSpan,
                                             cycles.busy.begin() + DegsAnalytic::kMemory));
    last_end_ += cycles.time;
    sliced_ = last_end_ - behind; // the next tile is sliced while the banks catch up
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> DegsConfig::analytic() const {
    return std::make_unique<DegsAnalytic>(*this);
}

} // namespace degs
