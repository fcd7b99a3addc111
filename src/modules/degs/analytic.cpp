// SPDX-License-Identifier: Apache-2.0
// DeGS without simulation: slicing, spans and banks as queues with rates. See docs/analytic.md.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "modules/degs/analytic_bank.hpp"
#include "modules/degs/analytic_slicing.hpp"
#include "modules/degs/config.hpp"
#include "modules/kit/analytic/front_end_load.hpp"
#include "modules/kit/analytic/memory_dates.hpp"
#include "modules/kit/analytic/ring_dates.hpp"

namespace degs {
namespace {

class DegsAnalytic : public FrontEndModel {
public:
    explicit DegsAnalytic(const DegsConfig& config)
        : FrontEndModel(config, config.gaussian_chunks(), kMemory), config_(config) {}
    std::vector<std::string> units() const override {
        return {"projection", "sorting", "slicing", "span", "packing", "blending", "memory"};
    }
    std::unique_ptr<TileClock> clock(const FrameWorkload& frame) const override;
    CoarseTile::Options coarse_options() const override {
        return {config_.scheduler.segment_length, 1, config_.pipeline.span_ends != SpanEnds::Exact,
                config_.pipeline.span_delta};
    }
    // Banks and Span Units own every n-th row, so rows are left out bank by bank. Those that have
    // more to do than others hold these up, which only shows if enough of them are sampled.
    Blocks blocks() const override {
        constexpr int kLeastBanks = 8;
        const int banks = std::gcd(config_.scheduler.banks, config_.span.count);
        return {1, std::max(1, banks / std::max(kLeastBanks, banks / 2)), 1, banks};
    }
    double visit_cost() const override { return 3; }
    int sorters() const override { return config_.sorting.count; }
    SortCycles sort_cycles(double entries, double) const override {
        return degs::sort_cycles(config_.sorting, entries, front());
    }
    int engines() const override { return config_.all_streams(); }
    double latency() const override;
    int pes() const override { return config_.pes(); }
    std::optional<EstimateErrors> errors() const override { return EstimateErrors{0.03, 0.065}; }
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
        RingDates crossbar;      ///< places for Span Vectors
        double cut = 0;          ///< when the next segment may be cut
        std::uint64_t splat = 0; ///< the last one with a segment in it, from 1
    };
    /// Rows that wait, and the Span Units that take them in order.
    struct Lane {
        RingDates rows, units;
        double taken = 0; ///< the row before
    };
    /// Where a row of a tile goes: the lane, the bank, and the first of its domains there.
    struct RowPlace {
        std::size_t lane = 0, bank = 0, domain = 0;
    };
    bool has_live_segment(const CoarseTile& tile, const CoarseSpan& span) const;
    double choose_rows(const CoarseTile& tile);
    void begin_lanes(double row_weight);
    void post(double date, double bytes);
    void post_lists(const CoarseTile& tile);
    double supply();
    double solve_row(int row);
    void segment(const CoarseTile& tile, const CoarseSpan& span, double solved);
    double tasks_of(const CoarseTile& tile, const CoarseSpan& part) const;
    double with_other_streams(double alone, double shared) const;
    double queue_segment(Bank& bank, double arrived);

    const DegsAnalytic& model_;
    const DegsConfig& config_;
    std::vector<Bank> banks_;
    std::vector<Lane> lanes_;
    std::vector<RowPlace> places_; ///< by row
    std::vector<int> segment_of_;  ///< by column
    std::vector<double> finished_; ///< when the tiles that hold the contexts are over, by turn
    std::size_t tiles_ = 0;
    std::vector<CoarseSpan> sent_; ///< rows of a splat; empty ones, too
    AnalyticSlicing slicing_;
    MemoryDates memory_;
    std::vector<FetcherDates> fetchers_;  ///< tiles take them in turn
    double arrived_ = 0;                  ///< when the latest chunk of splats is there
    int left_of_chunk_ = 0;               ///< splats
    double sliced_ = 0;                   ///< when the Slicing Units have sent the rows so far
    double last_time_ = 0, last_end_ = 0; ///< of the tile before
    double start_ = 0;                    ///< when a context is free
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
    : model_(model), config_(model.config()), places_(frame.tile_size),
      segment_of_(frame.tile_size), finished_(config_.contexts(), 0),
      slicing_(config_.slicing.units_per_module(), config_.slicing.splats_per_cycle,
               frame.tile_size),
      memory_(model.front().memory.bytes_per_cycle, model.front().memory.latency),
      fetchers_(config_.granted() ? 1 : config_.sorting.count,
                FetcherDates(config_.gaussian_chunks(), model.front().fetching.chunks_in_flight)) {
    banks_.assign(
        config_.scheduler.banks,
        {AnalyticBank(config_.queue_depth(),
                      Segmenter::domains_per_tile(frame.tile_size, config_.scheduler.segment_length,
                                                  config_.scheduler.banks),
                      config_.scheduler.reuse_cycles, config_.scheduler.scan),
         RingDates(config_.crossbar_cells())});
    for (int column = 0; column < frame.tile_size; ++column) {
        segment_of_[column] = column / config_.scheduler.segment_length;
    }
}

/// Span Units own every n-th row, or are a pool that takes the rows of one lane.
void DegsClock::begin_lanes(double row_weight) {
    if (!lanes_.empty()) {
        return;
    }
    const bool pool = config_.spans_cross();
    const int lanes = pool ? 1 : config_.span.count;
    // Only a sample of the rows goes through a pool, so that it gets only its share of the units.
    const long weight = pool ? std::lround(row_weight) : 1;
    const int rows = config_.span_buffer.bytes / config_.span_buffer.row_bytes / lanes;
    const int units = config_.span.count * config_.span.rows_per_cycle / lanes;
    lanes_.assign(lanes, {RingDates(rows / weight), RingDates(units / weight)});
    const std::size_t segments_per_row = segment_of_.back() + 1;
    for (std::size_t row = 0; row < places_.size(); ++row) {
        places_[row] = {row % lanes_.size(), row % banks_.size(),
                        row / banks_.size() * segments_per_row};
    }
}

void DegsClock::begin(const CoarseTile& tile) {
    begin_lanes(tile.row_weight());
    const int rows = config_.slicing.rows_per_cycle * config_.slicing.modules();
    slicing_.begin_tile(sliced_, std::lround(rows / tile.row_weight()));
    left_of_chunk_ = 0;
    post_lists(tile);
    start_ = finished_[tiles_ % finished_.size()];
    for (Bank& bank : banks_) {
        bank.queue.begin_tile();
    }
    tasks_ = rows_ = segments_ = slices_ = issues_ = features_ = 0;
}

// A unit takes the row when its bank has a place for the Span Vector; returns when it is solved.
double DegsClock::solve_row(int row) {
    const RowPlace& goes = places_[row];
    Lane& lane = lanes_[goes.lane];
    double entered = slicing_.send(row);
    if (entered < lane.rows.oldest()) { // a full lane stops all units
        entered = lane.rows.oldest();
        slicing_.stall(entered);
    }
    const double place = banks_[goes.bank].crossbar.oldest();
    lane.taken = std::max({lane.taken, entered, lane.units.oldest(), place});
    lane.rows.replace_oldest(lane.taken);
    lane.units.replace_oldest(lane.taken + config_.span.cycles_per_row);
    return lane.taken + config_.span.cycles_per_row;
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
    const RowPlace& goes = places_[span.row];
    Bank& bank = banks_[goes.bank];
    bank.crossbar.replace_oldest(std::max({solved, bank.cut, start_}));
    for (int s = segment_of_[span.first]; s <= segment_of_[span.last]; ++s) {
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
        at = bank.queue.add(at, taken, goes.domain + s);
        bank.cut = std::max(bank.cut, at);
        issues_ += taken;
        features_ += bank.splat == splats_ ? 0 : 1;
        bank.splat = splats_;
        tasks_ += tasks;
        ++segments_;
    }
}

bool DegsClock::has_live_segment(const CoarseTile& tile, const CoarseSpan& span) const {
    const int length = config_.scheduler.segment_length;
    for (int s = segment_of_[span.first]; s <= segment_of_[span.last]; ++s) {
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
        for (int r = tile.first_sampled(); r < tile.end_sampled(); ++r) {
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
    return tile.row_weight() * static_cast<double>(sent_.size());
}

// The other streams do the same, each in its turn.
void DegsClock::post(double date, double bytes) {
    const int streams = config_.all_streams();
    for (int stream = 0; stream < streams; ++stream) {
        memory_.post(date + stream * last_time_ / streams, bytes);
    }
}

/// The lists of the tiles that follow are read, and written and read again in every pass through
/// memory, while this one is rendered.
void DegsClock::post_lists(const CoarseTile& tile) {
    const FrontEndLoad& front = model_.front();
    const auto sorted = model_.sort_cycles(tile.entries(), tile.entries());
    const double bytes = tile.entries() * front.traffic.list_entry_bytes;
    const double accesses = 1 + 2 * sorted.outside;
    for (int access = 0; access < accesses; ++access) {
        post(sliced_ + access * sorted.all / accesses, bytes);
    }
}

// Returns the date at which the next splat is in the Gaussian Buffer.
double DegsClock::supply() {
    if (left_of_chunk_ == 0) {
        arrived_ = fetchers_[tiles_ % fetchers_.size()].next(memory_, model_.front().chunk_bytes());
    }
    return arrived_;
}

void DegsClock::splat(const CoarseTile& tile) {
    ++splats_;
    rows_ += choose_rows(tile);
    const double taken = slicing_.begin(supply());
    if (left_of_chunk_ == 0) {
        fetchers_[tiles_ % fetchers_.size()].take(taken);
        left_of_chunk_ = model_.front().fetching.chunk;
    }
    --left_of_chunk_;
    for (const CoarseSpan& span : sent_) {
        const double solved = solve_row(span.row);
        if (span.last >= span.first) {
            segment(tile, span, solved);
        }
    }
    slices_ += slicing_.end();
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
    sliced_ = slicing_.done();
    const double known = std::min(done + config_.slicing.feedback_cycles,
                                  sliced_ + left / config_.slicing.units_per_module());
    sliced_ = std::max(sliced_, known);
    const double over = done + config_.array.writeback_cycles;
    finished_[tiles_ % finished_.size()] =
        over + tile.pixels() / config_.pixel_buffer.readout_pixels;
    post(over, tile.pixels() * model_.front().traffic.pixel_bytes);
    ++tiles_;
    const double weight = tile.row_weight();
    const double behind = std::max(done - sliced_, 0.0); // cycles of the banks behind the last row
    const double alone = sliced_ + behind - last_end_;
    TileCycles cycles = model_.front_end_cycles(tile, tile.walked(), alone);
    cycles.slots = weight * tasks_;
    // Every module of a stream takes each splat.
    cycles.counts[DegsAnalytic::kSlices] =
        std::max(slices_, tile.walked() * config_.slicing.modules());
    cycles.counts[DegsAnalytic::kTaken] = tile.walked() * config_.slicing.modules();
    cycles.counts[DegsAnalytic::kRows] = rows_;
    cycles.counts[DegsAnalytic::kIssues] = weight * issues_;
    cycles.counts[DegsAnalytic::kSegments] = weight * segments_;
    cycles.counts[DegsAnalytic::kFeatures] = weight * features_;
    cycles.busy[DegsAnalytic::kSlicing] = slices_ / (config_.clusters * config_.slicing.count);
    cycles.busy[DegsAnalytic::kSpan] = rows_ * config_.span.cycles_per_row /
                                       config_.span.rows_per_cycle /
                                       (config_.clusters * config_.span.count);
    cycles.busy[DegsAnalytic::kPacking] = weight * segments_ / config_.scheduler.issue_width /
                                          (config_.clusters * config_.scheduler.banks);
    cycles.busy[DegsAnalytic::kBlending] = cycles.slots / config_.pes();
    cycles.time = with_other_streams(
        std::max(alone, cycles.time),
        config_.clusters * *std::max_element(cycles.busy.begin() + DegsAnalytic::kSpan,
                                             cycles.busy.begin() + DegsAnalytic::kMemory));
    last_time_ = cycles.time;
    last_end_ += cycles.time;
    sliced_ = last_end_ - behind; // the next tile is sliced while the banks catch up
    return cycles;
}

} // namespace

std::unique_ptr<AnalyticModel> DegsConfig::analytic() const {
    return std::make_unique<DegsAnalytic>(*this);
}

} // namespace degs
