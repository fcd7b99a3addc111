// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/gaussian_slicing_unit.hpp"

#include <algorithm>
#include <initializer_list>
#include <limits>

#include "tlm/has_process.hpp"

namespace degs {
namespace {

// Rows remember the ends of 63 segments; the last bit stands for all further ones and never ends.
constexpr int kLastBit = 63;
constexpr int kUnlimited = std::numeric_limits<int>::max();

// A splat that a unit begins with. The ranges lie inside the tile; an empty one ends before it
// begins.
void log_splat(EventLog& log, Cycle now, std::initializer_list<std::int64_t> numbers) {
    log.begin(log.kind("splat", {{"tile", {}},
                                 {"entry", {}},
                                 {"splat", {}},
                                 {"first_row", {}},
                                 {"last_row", {}},
                                 {"first_column", {}},
                                 {"last_column", {}}}),
              now);
    for (const std::int64_t number : numbers) {
        log.put(number);
    }
}

} // namespace

void GaussianSlicingUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64, "units (paper Table III: 1, 2, 4, 8)");
    visitor.integer("interleave", interleave, 1, 16,
                    "tile streams: tiles that are sliced and blended at once [assumed]");
    visitor.integer("rows_per_cycle", rows_per_cycle, 1, 64,
                    "scanlines per unit and cycle [assumed]");
    visitor.integer("splats_per_cycle", splats_per_cycle, 1, 16,
                    "splats per unit and cycle at most, which share its rows_per_cycle [assumed]");
    visitor.choice("distribution", distribution, {"broadcast", "broadcast_skip", "splats"},
                   "what units share: the rows of every splat, each unit spending a cycle on it, "
                   "or none where it has no row; or the splats of a tile [assumed]");
    visitor.choice("rows", rows, {"splat", "tile"},
                   "scanlines of a splat: all that its ellipse meets (paper: y_min..y_max), or "
                   "those inside the tile's columns");
    visitor.boolean("skip_dead_rows", skip_dead_rows,
                    "leave out rows whose segments below the splat have all ended; the paper's "
                    "feedback reaches the Issue Banks only");
    visitor.integer("feedback_cycles", feedback_cycles, 1, 4096,
                    "cycles from the array to the region mask of skip_dead_rows [assumed]");
    if (!skip_dead_rows) {
        visitor.unused("feedback_cycles", "skip_dead_rows", "skip_dead_rows is false");
    }
}

GaussianSlicingUnit::GaussianSlicingUnit(const sc_core::sc_module_name& name, const Config& config,
                                         const Timebase& time, const RenderJob& job, int index,
                                         std::size_t inputs, int lanes, std::size_t slices,
                                         int segment_length)
    : sc_core::sc_module(name), in("in", inputs), cancel("cancel"),
      out("out", lanes / config.modules()),
      region_ended("region_ended", config.skip_dead_rows ? slices : 0),
      sliced("sliced", config.reports_chunks ? 1 : 0),
      row_counts("row_counts", config.reports_chunks ? out.size() : 0), config_(config), job_(job),
      index_(index), modules_(config.modules()), segment_length_(segment_length), self_(time),
      readers_(out.size()), open_chunks_(sliced, row_counts) {
    for (int row = 0; row < job.tile_size; ++row) {
        lane_of_row_.push_back((row % lanes) / config.modules());
    }
    slices_.reserve(std::size_t{1} * config.units_per_module() * config.splats_per_cycle);
    DEGS_HAS_PROCESS(GaussianSlicingUnit);
    SC_THREAD(run);
    self_.show(*this, stats_.busy, config_.units_per_module());
}

void GaussianSlicingUnit::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    cancel->connect_reader(self_);
    for (auto& port : region_ended) {
        port->connect_reader(self_);
    }
    for (auto& port : out) {
        lanes_.push_back(&port.ring());
        lanes_.back()->connect_writer(self_);
    }
    row_writes_.resize(lanes_.size());
    replay_lanes_.resize(lanes_.size());
    open_chunks_.connect_writer(self_);
}

void GaussianSlicingUnit::run() {
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
        const SpanStage* const reader = readers_[lane];
        replay_lanes_[lane] = reader != nullptr ? reader->replay_of(*lanes_[lane]) : nullptr;
    }
    for (TileNumber number = tile_after(kNoTile); number != kNoTile; number = tile_after(number)) {
        slice_tile(number);
        end_lanes(number);
    }
    if (config_.granted) {
        if (log_ != nullptr) {
            log_->begin(log_->kind("over", {}), self_.local());
        }
        end_lanes(kNoTile);
    }
    self_.finish();
}

void GaussianSlicingUnit::end_lanes(TileNumber number) {
    RowItem end;
    end.tile = number;
    end.end = true;
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
        if (SpanReplay* const spans = replay_lanes_[lane]) {
            spans->reserve(self_);
            spans->put_end(self_, number);
        } else {
            lanes_[lane]->put(self_, end);
        }
    }
}

// The number of the tile that is sliced after tile `number`, or kNoTile if none follows. With
// kNoTile as the argument, the first tile.
TileNumber GaussianSlicingUnit::tile_after(TileNumber number) {
    if (config_.granted) {
        return in[0]->arrive(self_).tile;
    }
    const TileNumber next = number + 1; // 0 after kNoTile
    return job_.has_tile(self_, next) ? next : kNoTile;
}

void GaussianSlicingUnit::slice_tile(TileNumber number) {
    ended_.assign(job_.tile_size, 0);
    chunk_ = SplatChunk();
    dealt_ = 0;
    for (;;) {
        dropping_ = false;
        splat_reads_left_ = config_.splat_ports.neighbours(kUnlimited);
        deal(number);
        if (slices_.empty() && !dropping_ && splat_reads_left_ != 0) {
            return;
        }
        work(number);
        self_.advance();
    }
}

// Units without a splat take the next ones of the tile.
void GaussianSlicingUnit::deal(TileNumber number) {
    const std::size_t units = config_.units_per_module();
    while (slices_.size() < units) {
        if (!add_slice(number)) {
            break;
        }
    }
    for (Slice& slice : slices_) {
        slice.rows_left = config_.rows_per_cycle;
        slice.splats_left = config_.splats_per_cycle;
    }
    stats_.busy += slices_.size();
}

// Takes the tile's next splat that costs the unit something, if it is there at this date.
bool GaussianSlicingUnit::add_slice(TileNumber number) {
    while (splat_reads_left_ != 0 && more_splats(number)) {
        --splat_reads_left_;
        Slice& slice = slices_.emplace_back();
        begin(number, slice);
        if (!slice.done() || config_.distribution != SliceDistribution::BroadcastSkip) {
            return true;
        }
        open_chunks_.finish_splat(self_, slice.chunk);
        free_row_buffers_.push_back(slice.row_buffer);
        slices_.pop_back();
    }
    stats_.splat_port_waits += splat_reads_left_ == 0 && dealt_ < chunk_.count ? 1 : 0;
    return false;
}

// True if the tile has a splat at this date. Waits for one only if no unit has work. A chunk of a
// cancelled tile takes the cycle.
bool GaussianSlicingUnit::more_splats(TileNumber number) {
    const std::size_t input = config_.granted ? 0 : job_.sorter_of(number, in.size());
    FifoPort<SplatChunk>& source = in[input];
    while (dealt_ == chunk_.count) {
        if (chunk_.last || dropping_ || (!slices_.empty() && !self_.arrived(source.ring()))) {
            return false;
        }
        chunk_ = source->get(self_);
        dealt_ = 0;
        if (cancelled(number)) {
            stats_.splats_cancelled += chunk_.count;
            dealt_ = chunk_.count;
            dropping_ = true;
        } else {
            see_ended_regions(number);
            expect_splats();
        }
        open_chunks_.open(self_, input, chunk_.count - dealt_);
    }
    return true;
}

// A cycle of the units. They go in the order of age of their splats, because an older splat passes
// a row before a younger one may send it.
void GaussianSlicingUnit::work(TileNumber number) {
    int passed = job_.tile_size; // the first row that some older splat has not passed
    bool finished = false;
    for (std::size_t i = 0; i < slices_.size(); ++i) {
        send_rows(number, slices_[i], passed);
        const Slice slice = slices_[i];
        if (!slice.done()) {
            passed = std::min(passed, slice.row);
            continue;
        }
        finished = true;
        open_chunks_.finish_splat(self_, slice.chunk);
        free_row_buffers_.push_back(slice.row_buffer);
        if (slice.splats_left > 1) {
            if (add_slice(number)) {
                slices_.back().rows_left = slice.rows_left;
                slices_.back().splats_left = slice.splats_left - 1;
            }
        }
    }
    if (finished) {
        const auto done = [](const Slice& slice) { return slice.done(); };
        slices_.erase(std::remove_if(slices_.begin(), slices_.end(), done), slices_.end());
    }
}

inline __attribute__((always_inline)) void
GaussianSlicingUnit::put_row(TileNumber number, const Slice& slice, DatedFifo<RowItem>& lane) {
    RowItem& item = lane.staged();
    item.tile = number;
    item.splat = slice.splat;
    item.row = inside_tile(slice.row);
    item.end = false;
    if (functional_ != nullptr) {
        item.outcome = *slice.outcome;
    }
    lane.put_staged(self_);
}

void GaussianSlicingUnit::send_rows(TileNumber number, Slice& slice, int before) {
    const int step = functional_ != nullptr ? 1 : 0;
    for (; slice.row <= slice.last && slice.row < before;
         slice.row += modules_, slice.outcome += step) {
        if ((slice.below & ~ended_[slice.row]) == 0) {
            stats_.rows_skipped++;
            continue;
        }
        if (slice.rows_left == 0) {
            return;
        }
        const std::size_t lane = lane_of_row_[slice.row];
        SpanReplay* const spans = replay_lanes_[lane];
        if (spans != nullptr) {
            spans->reserve(self_);
        } else {
            lanes_[lane]->reserve(self_);
        }
        if (!takes_row_port(lane)) {
            return;
        }
        --slice.rows_left;
        open_chunks_.count_row(slice.chunk, lane);
        stats_.rows++;
        if (spans != nullptr) {
            spans->put(self_, number, slice.splat, slice.row, *slice.outcome);
        } else {
            put_row(number, slice, *lanes_[lane]);
        }
    }
}

// A lane is an SRAM bank. The units share its write ports.
bool GaussianSlicingUnit::takes_row_port(std::size_t lane) {
    if (!config_.row_ports.limited()) {
        return true;
    }
    Writes& writes = row_writes_[lane];
    if (writes.date != self_.local()) {
        writes = {self_.local(), 0};
    }
    if (writes.count == config_.row_ports.ports) {
        ++stats_.row_port_waits;
        return false;
    }
    ++writes.count;
    return true;
}

bool GaussianSlicingUnit::cancelled(TileNumber number) {
    while (self_.arrived(cancel.ring())) {
        cancelled_before_ = std::max(cancelled_before_, cancel->take(self_) + 1);
    }
    return number < cancelled_before_;
}

void GaussianSlicingUnit::see_ended_regions(TileNumber number) {
    for (auto& port : region_ended) {
        while (self_.arrived(port.ring())) {
            const RegionEnded message = port->take(self_);
            if (message.tile == number && message.segment < kLastBit) {
                ended_[message.row] |= std::uint64_t{1} << message.segment;
            }
        }
    }
}

// Asks early for all splats of the chunk, so that the host's caches load them side by side.
void GaussianSlicingUnit::expect_splats() const {
    if (functional_ != nullptr) {
        functional_->expect(chunk_);
    } else {
        expect_listed(job_, chunk_);
    }
}

// The segments of a row that the splat's box covers inside the tile, a bit each.
std::uint64_t GaussianSlicingUnit::segments_below(const JobTile& tile, std::uint32_t splat) const {
    const PixelRange columns = job_.path->columns(splat).within(tile.columns()).relative_to(tile.x);
    if (columns.empty()) {
        return 0;
    }
    const auto upto = [](int n) { return (std::uint64_t{2} << n) - 1; }; // bits 0 .. n
    const int first_bit = std::min(columns.first / segment_length_, kLastBit);
    const int last_bit = std::min(columns.last / segment_length_, kLastBit);
    return upto(last_bit) & ~(upto(first_bit) >> 1);
}

void GaussianSlicingUnit::begin(TileNumber number, Slice& slice) {
    const JobTile& tile = job_.tiles[number];
    const auto place = static_cast<std::uint32_t>(chunk_.first + dealt_ - tile.first);
    ++dealt_;
    slice.splat = tile.splat(place);
    slice.chunk = open_chunks_.latest();
    const PixelRange rows = functional_ != nullptr
                                ? functional_->rows(number, place)
                                : sliced_rows(job_, tile, slice.splat, config_.rows);
    // The first row that this module owns.
    slice.row = rows.first + (index_ - rows.first % modules_ + modules_) % modules_;
    slice.last = rows.last;
    if (log_ != nullptr) {
        const PixelRange columns = job_.path->columns(slice.splat).within(tile.columns());
        log_splat(*log_, self_.local(),
                  {number, static_cast<std::int64_t>(tile.first + place), slice.splat, rows.first,
                   rows.last, columns.first - tile.x, columns.last - tile.x});
    }
    slice.below = config_.skip_dead_rows ? segments_below(tile, slice.splat) : ~std::uint64_t{0};
    stats_.splats++;
    take_outcomes(number, place, slice);
}

// Takes the outcomes of the slice's rows from the functional model, if there is one. The model asks
// for depth order, which holds because splats begin in that order in all units of a module.
void GaussianSlicingUnit::take_outcomes(TileNumber number, std::uint32_t place, Slice& slice) {
    if (free_row_buffers_.empty()) {
        free_row_buffers_.push_back(row_buffers_.size());
        row_buffers_.emplace_back(functional_ == nullptr ? 0 : job_.tile_size);
    }
    slice.row_buffer = free_row_buffers_.back();
    free_row_buffers_.pop_back();
    slice.outcome = row_buffers_[slice.row_buffer].data();
    if (functional_ != nullptr) {
        functional_->take(number, place, {slice.row, slice.last}, modules_,
                          row_buffers_[slice.row_buffer].data());
    }
}

} // namespace degs
