// SPDX-License-Identifier: Apache-2.0
#include "modules/span_engine/gaussian_slicing_unit.hpp"

#include <algorithm>

namespace degs {
namespace {

// Rows remember the ends of 63 segments; the last bit stands for all further ones and never ends.
constexpr int kLastBit = 63;

} // namespace

void GaussianSlicingUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64,
                    "units (paper Table II: 1, 2, 4, 8); divides the Span Units");
    visitor.integer("rows_per_cycle", rows_per_cycle, 1, 64,
                    "scanlines per unit and cycle; 8 x 2 units keep 8 Span Units fed although a "
                    "splat's last cycle is rarely full [assumed]");
    visitor.choice(
        "rows", rows, {"splat", "tile"},
        "scanlines of a splat: all that its ellipse meets (paper: y_min..y_max), or those "
        "inside the tile's columns, found by binning with the exact tile test");
    visitor.boolean("skip_dead_rows", skip_dead_rows,
                    "leave out rows whose segments below the splat have all ended; the paper's "
                    "feedback reaches the Issue Banks only, so false");
    visitor.integer("feedback_cycles", feedback_cycles, 1, 4096,
                    "cycles from the array to the region mask of skip_dead_rows [assumed]");
}

GaussianSlicingUnit::GaussianSlicingUnit(const sc_core::sc_module_name& name, const Config& config,
                                         const Timebase& time, const RenderJob& job, int index,
                                         std::size_t inputs, int lanes, std::size_t slices,
                                         int segment_length)
    : sc_core::sc_module(name), in("in", inputs), cancel("cancel"),
      out("out", lanes / config.count),
      region_ended("region_ended", config.skip_dead_rows ? slices : 0), config_(config), job_(job),
      index_(index), segment_length_(segment_length), self_(time) {
    for (int row = 0; row < job.tile_size; ++row) {
        lane_of_row_.push_back((row % lanes) / config.count);
    }
    SC_HAS_PROCESS(GaussianSlicingUnit);
    SC_THREAD(run);
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
}

void GaussianSlicingUnit::run() {
    for (TileNumber number = 0; !job_.over(number); ++number) {
        ended_.assign(job_.tile_size, 0);
        FifoPort<SplatChunk>& source = in[number % in.size()];
        for (bool last = false; !last;) {
            const SplatChunk chunk = source->get(self_);
            last = chunk.last;
            if (cancelled(number)) {
                stats_.splats_cancelled += chunk.count;
                self_.advance();
            } else {
                see_ended_regions(number);
                slice(chunk);
            }
        }
        RowItem end;
        end.tile = number;
        end.end = true;
        for (DatedFifo<RowItem>* lane : lanes_) {
            lane->put(self_, end);
        }
    }
    self_.finish();
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

void GaussianSlicingUnit::slice(const SplatChunk& chunk) {
    const JobTile& tile = job_.tiles[chunk.tile];
    const FrameWorkload& frame = job_.frame_of(tile);
    const auto splat = [&](std::uint32_t i) {
        return job_.first_splat[tile.frame] + frame.tile_splats[chunk.first + i];
    };
    for (std::uint32_t i = 0; i < chunk.count; ++i) {
        job_.path->expect(splat(i)); // the host's memory then answers all of them at once
    }
    for (std::uint32_t i = 0; i < chunk.count; ++i) {
        slice_splat(chunk.tile, splat(i));
    }
}

// The segments of a row that the splat's box covers inside the tile.
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

void GaussianSlicingUnit::slice_splat(TileNumber number, std::uint32_t splat) {
    const JobTile& tile = job_.tiles[number];
    const PixelRange met = config_.rows == SlicedRows::Tile
                               ? job_.path->rows_in_columns(splat, tile.x, tile.x + tile.width)
                               : job_.path->rows(splat);
    const PixelRange rows = met.within(tile.rows()).relative_to(tile.y);
    const int others = (index_ - rows.first % config_.count + config_.count) % config_.count;
    const std::uint64_t below =
        config_.skip_dead_rows ? segments_below(tile, splat) : ~std::uint64_t{0};
    int emitted = 0;
    int left = config_.rows_per_cycle; // of this cycle
    Cycle busy = 1;
    for (int row = rows.first + others; row <= rows.last; row += config_.count) {
        if ((below & ~ended_[row]) == 0) {
            stats_.rows_skipped++;
            continue;
        }
        if (left-- == 0) {
            self_.advance();
            ++busy;
            left = config_.rows_per_cycle - 1;
        }
        DatedFifo<RowItem>& lane = *lanes_[lane_of_row_[row]];
        lane.reserve(self_);
        RowItem& item = lane.staged();
        item.tile = number;
        item.splat = splat;
        item.row = inside_tile(row);
        item.end = false;
        lane.put_staged(self_);
        ++emitted;
    }
    self_.advance();
    stats_.busy += busy;
    stats_.splats++;
    stats_.rows += emitted;
}

} // namespace degs
