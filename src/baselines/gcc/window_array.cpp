// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/window_array.hpp"

#include <algorithm>
#include <cmath>

#include "splat/frame/pixel_index.hpp"
#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs::gcc {
namespace {

constexpr int kLanes = 32; // pixels per call of the data path

} // namespace

void WindowArray::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("window", window, 1, 64,
                    "px; side of the traversal window, one PE per pixel (GCC: 8 x 8); it grows "
                    "with the array (paper, Sec. II-B)");
    visitor.integer("skip_cycles", skip_cycles, 0, 64,
                    "cycles for a window whose pixels have all ended [assumed]");
    visitor.integer("seed_cycles", seed_cycles, 0, 256,
                    "cycles to find a further part of a splat, which is not connected with those "
                    "that have been visited [assumed]");
    visitor.integer("discovery_cycles", discovery_cycles, 1, 256,
                    "cycles from a slot to the windows it leads to; 1: interleaved splats hide the "
                    "pipeline [assumed]");
    visitor.integer("writeback_cycles", writeback_cycles, 1, 4096,
                    "cycles from a slot to pixel state and reports written [assumed]");
}

WindowArray::WindowArray(const sc_core::sc_module_name& name, const Config& config,
                         const Timebase& time, RenderJob& job, const ArrayShare& share,
                         std::size_t listeners, int block)
    : sc_core::sc_module(name), in("in", share.inputs), context_free("context_free"),
      tile_done("tile_done"), tile_state("tile_state"), block_ended("block_ended", listeners),
      config_(config), job_(job), share_(share), block_(block),
      blocks_(ceil_div(job.tile_size, block)), grid_(ceil_div(job.tile_size, config.window)),
      self_(time), footprint_(job.tile_size, config.window), traversal_(grid_),
      startable_(share.contexts), live_in_window_(grid_ * grid_, 0),
      live_in_block_(blocks_ * blocks_, 0), live_windows_(grid_, 0),
      ended_head_(live_in_window_.size(), -1) {
    DEGS_HAS_PROCESS(WindowArray);
    SC_THREAD(run);
    self_.show(*this, stats_.windows);
    part_ = job.record_part(config.pes());
}

void WindowArray::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
    }
    context_free->connect_reader(self_);
    tile_done->connect_writer(self_);
    tile_state->connect_writer(self_);
    for (auto& port : block_ended) {
        port->connect_writer(self_);
    }
}

void WindowArray::run() {
    for (; share_.granted || !job_.over(views_); ++views_) {
        const SplatChunk chunk = next_chunk();
        if (chunk.tile == kNoTile) {
            tile_state->put(self_, {kNoTile, false});
            tile_done->put(self_, {kNoTile, false});
            break;
        }
        await_context();
        start_view(chunk.tile);
        render_view(chunk);
        end_view();
    }
    self_.finish();
}

void WindowArray::render_view(SplatChunk chunk) {
    const FrameWorkload& frame = job_.frame_of(*view_);
    for (;; chunk = next_chunk()) {
        for (std::uint32_t i = 0; i < chunk.count; ++i) {
            const std::uint32_t splat = frame.tile_splats[chunk.first + i];
            render(view_->first_splat + splat, frame.splats[splat]);
        }
        if (chunk.last) {
            return;
        }
    }
}

SplatChunk WindowArray::next_chunk() {
    const Cycle asked = self_.local();
    const SplatChunk chunk = in[views_ % in.size()]->get(self_);
    idle(Slot::Starved, asked, self_.local());
    return chunk;
}

void WindowArray::await_context() {
    const Cycle asked = self_.local();
    for (; startable_ <= views_; ++startable_) {
        context_free->get(self_);
    }
    idle(Slot::Blocked, asked, self_.local());
}

void WindowArray::start_view(TileNumber number) {
    const JobTile& view = job_.tiles[number];
    view_ = &view;
    first_entries_ = views_ == 0 ? view.count : first_entries_;
    number_ = number;
    context_ = context_in_turn(views_, share_.contexts, share_.first_context);
    const PixelRange columns = view.image_columns(), rows = view.image_rows();
    columns_ = {footprint_.window_of(columns.first), footprint_.window_of(columns.last)};
    rows_ = {footprint_.window_of(rows.first), footprint_.window_of(rows.last)};
    live_pixels_ = columns.size() * rows.size();
    reported_ = false;
    const auto inside = [&](int index, int per_row, int side) {
        const int x = index % per_row * side, y = index / per_row * side;
        return columns.within({x, x + side - 1}).size() * rows.within({y, y + side - 1}).size();
    };
    for (int w = 0; w < grid_ * grid_; ++w) {
        live_in_window_[w] = inside(w, grid_, config_.window);
    }
    for (int b = 0; b < blocks_ * blocks_; ++b) {
        live_in_block_[b] = inside(b, blocks_, block_);
    }
    std::fill_n(live_windows_.begin(), rows_.last + 1,
                windows_between(columns_.first, columns_.last));
}

void WindowArray::end_view() {
    const SliceReport report{number_, live_pixels_ == 0};
    if (!reported_) {
        tile_state->put(self_, report);
    }
    tile_done->put(self_, report);
    job_.tiles[number_].passed = true; // all stages have handed on its last splat
}

void WindowArray::render(std::uint32_t splat, const ProjectedSplat& projected) {
    if (live_pixels_ == 0) {
        stats_.splats_dropped++;
        return;
    }
    stats_.splats++;
    const std::uint64_t windows = stats_.windows;
    const std::uint64_t valid = stats_.valid_pixels;
    footprint_.solve(*job_.path, splat, *view_);
    const SlotAccount before = stats_.slots;
    evaluate(splat);
    const std::uint64_t useful = stats_.slots[Slot::Useful] - before[Slot::Useful];
    const std::uint64_t terminated = stats_.slots[Slot::Terminated] - before[Slot::Terminated];
    traverse(projected);
    if (part_ != nullptr) {
        record_splat(useful, terminated);
    }
    stats_.slots[Slot::Boundary] +=
        (stats_.windows - windows) * config_.pes() - (stats_.valid_pixels - valid);
}

// Every window is visited at most once per splat, so that the order of the windows does not matter
// to the pixels: they are blended row by row, in long runs, before the windows are given dates.
void WindowArray::evaluate(std::uint32_t splat) {
    ended_.clear();
    const int side = config_.window;
    for (const Footprint::Row& row : footprint_.rows()) {
        WindowMask live = live_windows_[footprint_.window_of(row.y)] &
                          windows_between(footprint_.window_of(row.columns.first),
                                          footprint_.window_of(row.columns.last));
        while (live != 0) {
            const int first = __builtin_ctzll(live);
            const WindowMask behind = ~(live >> first);
            const int last = behind == 0 ? 63 : first + __builtin_ctzll(behind) - 1;
            evaluate_run(splat, row.y, row.columns.within({first * side, last * side + side - 1}));
            live &= ~windows_between(first, last);
        }
    }
}

void WindowArray::evaluate_run(std::uint32_t splat, int y, const PixelRange& columns) {
    PixelTest test;
    test.splat = splat;
    test.y = view_->y + y;
    test.row = y;
    test.context = context_;
    stats_.valid_pixels += columns.size();
    for (int column = columns.first; column <= columns.last; column += kLanes) {
        test.x = view_->x + column;
        test.column = column;
        test.mask = ~0U >> (kLanes - std::min(kLanes, columns.last - column + 1));
        const BlendOutcome outcome = job_.path->test(test);
        stats_.slots[Slot::Useful] += __builtin_popcount(outcome.useful);
        stats_.slots[Slot::Terminated] += __builtin_popcount(outcome.terminated);
        if (outcome.ended != 0) {
            note_ended(y, column, outcome.ended);
        }
    }
}

void WindowArray::note_ended(int y, int column, std::uint32_t ended) {
    for (; ended != 0; ended &= ended - 1) {
        const int x = column + __builtin_ctz(ended);
        int& head = ended_head_[window_at(footprint_.window_of(y), footprint_.window_of(x))];
        ended_.push_back({y / block_ * blocks_ + x / block_, head});
        head = static_cast<int>(ended_.size()) - 1;
    }
}

Traversal::Window WindowArray::centre_window(const ProjectedSplat& splat) const {
    const auto clamped = [&](double centre, int begin, const PixelRange& inside) {
        const double pixel = std::floor(centre + 0.5) - begin;
        return footprint_.window_of(index_within(pixel, inside.first, inside.last));
    };
    Traversal::Window window;
    window.row = clamped(splat.mu_y, view_->y, view_->image_rows());
    window.column = clamped(splat.mu_x, view_->x, view_->image_columns());
    return window;
}

void WindowArray::traverse(const ProjectedSplat& splat) {
    const Cycle latency = config_.discovery_cycles - 1;
    traversal_.begin(footprint_, columns_, rows_);
    for (std::optional<Traversal::Window> seed = centre_window(splat); seed; seed = missed()) {
        seed->known = self_.local();
        traversal_.seed(*seed);
        while (const auto window = traversal_.next()) {
            wait_until(window->known);
            visit(*window);
            traversal_.expand(*window, self_.local() + latency);
        }
        wait_until(self_.local() + latency); // only then is it known that nothing follows
    }
}

std::optional<Traversal::Window> WindowArray::missed() {
    const std::optional<Traversal::Window> found = traversal_.find_missed();
    if (found) {
        stats_.extra_seeds++;
        wait_until(self_.local() + config_.seed_cycles);
    }
    return found;
}

void WindowArray::visit(const Traversal::Window& window) {
    const std::size_t index = window_at(window.row, window.column);
    if (live_in_window_[index] == 0) {
        const Cycle cycles = config_.skip_cycles;
        stats_.windows_ended++;
        pending_skips_ += cycles;
        if (part_ != nullptr) {
            part_->idle(Slot::Terminated, self_.local(), self_.local() + cycles,
                        cycles * config_.pes());
        }
        idle_pending_ = idle_pending_ || cycles != 0;
        self_.advance(cycles);
        return;
    }
    if (idle_pending_) {
        settle_idle();
    }
    stats_.window.include(self_.local());
    if (part_ != nullptr) {
        part_->work(number_, self_.local(), self_.local() + 1);
        visits_.push_back(self_.local());
    }
    stats_.windows++;
    stats_.windows_empty += ~footprint_.valid(window.row) >> window.column & 1U;
    if (ended_head_[index] >= 0) {
        end_pixels(index);
    }
    self_.advance();
}

void WindowArray::end_pixels(std::size_t window) {
    for (int& i = ended_head_[window]; i >= 0;) {
        const EndedPixel pixel = ended_[i];
        i = pixel.next;
        stats_.pixels_ended++;
        --live_in_window_[window];
        --live_pixels_;
        const std::size_t block = pixel.block;
        if (--live_in_block_[block] == 0) {
            report_block(pixel.block);
        }
    }
    if (live_in_window_[window] == 0) {
        live_windows_[window / grid_] &= ~(WindowMask{1} << window % grid_);
    }
    if (live_pixels_ == 0) {
        reported_ = true;
        tile_state->put(self_, {number_, true});
    }
}

void WindowArray::report_block(int block) {
    for (auto& port : block_ended) {
        port->put(self_, {number_, inside_tile(block / blocks_), inside_tile(block % blocks_)});
    }
}

void WindowArray::wait_until(Cycle date) {
    if (date > self_.local()) {
        idle(Slot::Conflict, self_.local(), date);
        self_.advance_to(date);
    }
}

void WindowArray::idle(Slot cause, Cycle from, Cycle to) {
    const std::uint64_t slots = (to - from) * config_.pes();
    pending_idle_[cause] += slots;
    if (part_ != nullptr) {
        part_->idle(cause, from, to, slots);
    }
    idle_pending_ = true;
}

// The pixels of a splat are known for all of its windows together, and are dealt out evenly.
void WindowArray::record_splat(std::uint64_t useful, std::uint64_t terminated) {
    for (std::size_t left = visits_.size(); left != 0; --left) {
        const Cycle date = visits_[visits_.size() - left];
        const std::uint64_t here = (useful + terminated) / left;
        const std::uint64_t useful_here = useful / left;
        part_->add(Slot::Useful, number_, date, useful_here);
        part_->add(Slot::Terminated, number_, date, here - useful_here);
        part_->add(Slot::Boundary, number_, date, config_.pes() - here);
        useful -= useful_here;
        terminated -= here - useful_here;
    }
    visits_.clear();
}

// Idle time lies inside the window of activity only if a slot follows it, and one has gone before.
void WindowArray::settle_idle() {
    pending_idle_[Slot::Terminated] += pending_skips_ * config_.pes();
    if (!stats_.window.empty()) {
        stats_.slots += pending_idle_;
        stats_.skip_cycles += pending_skips_;
        if (part_ != nullptr) {
            part_->settle(number_);
        }
    }
    if (part_ != nullptr) {
        part_->drop_pending();
    }
    pending_idle_ = {};
    pending_skips_ = 0;
    idle_pending_ = false;
}

} // namespace degs::gcc
