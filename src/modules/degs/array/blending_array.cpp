// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/array/blending_array.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/kit/job/row_map.hpp"
#include "tlm/has_process.hpp"

namespace degs {
namespace {

// Logs the pixels of a segment that end with a packet.
void log_ended(EventLog& log, Cycle now, const TaskRun& run, std::uint32_t ended) {
    log.begin(
        log.kind("ended", {{"tile", {}}, {"splat", {}}, {"row", {}}, {"column", {}}, {"mask", {}}}),
        now);
    for (const std::int64_t value :
         {std::int64_t{run.tile}, std::int64_t{run.task.splat}, std::int64_t{run.task.row},
          std::int64_t{run.task.column}, std::int64_t{ended}}) {
        log.put(value);
    }
}

// Logs the rows and columns of a tile that lie inside the image, which may cut it on every side.
void log_tile(EventLog& log, Cycle now, TileNumber number, const JobTile& tile) {
    const PixelRange rows = tile.image_rows(), columns = tile.image_columns();
    log.begin(log.kind("tile", {{"tile", {}},
                                {"first_row", {}},
                                {"last_row", {}},
                                {"first_column", {}},
                                {"last_column", {}}}),
              now);
    for (const std::int64_t value :
         {std::int64_t{number}, std::int64_t{rows.first}, std::int64_t{rows.last},
          std::int64_t{columns.first}, std::int64_t{columns.last}}) {
        log.put(value);
    }
}

} // namespace

void ArraySlice::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("pes_per_bank", pes_per_bank, 1, TaskPacket::kMaxRuns,
                    "PEs per array slice (paper Table III)");
    visitor.integer("writeback_cycles", writeback_cycles, 1, 64,
                    "cycles from execution to written-back pixel state and feedback (paper: 4)");
}

ArraySlice::ArraySlice(const sc_core::sc_module_name& name, const Config& config,
                       const Timebase& time, RenderJob& job, int index, int slices,
                       int segment_length)
    : sc_core::sc_module(name), in("in"), terminated("terminated"),
      region_ended("region_ended",
                   config.streams * reachable(index, slices, config.region_listeners)),
      tile_done("tile_done", config.streams), tile_state("tile_state", config.streams),
      config_(config), job_(job), index_(index), slices_(slices), segment_length_(segment_length),
      segments_per_row_((job.tile_size + segment_length - 1) / segment_length), self_(time),
      contexts_(std::size_t{1} * config.streams * config.contexts), current_(&contexts_.front()),
      segments_((job.tile_size + slices - 1) / slices * segments_per_row_),
      plain_(config.scoreboard && !config.tests), blender_(job, config.tests),
      tiles_(job, config.granted ? 1 : 0) {
    if (!config.scoreboard) {
        early_.emplace(job, config.writeback_cycles, config.tests);
    }
    if (config.region_listeners != 0) {
        port_of_row_ = ports_of_rows(job.tile_size, index, slices, config.region_listeners);
    }
    DEGS_HAS_PROCESS(ArraySlice);
    if (self_.strict()) {
        SC_THREAD(run);
    }
    self_.show(*this, stats_.packets);
}

void ArraySlice::end_of_elaboration() {
    packets_ = &in.ring();
    packets_->connect_reader(self_);
    if (!self_.strict()) {
        Pumped& recorded = recorded_;
        self_.pump_with(part_ == nullptr ? *this : recorded, *packets_);
    }
    terminated->connect_writer(self_);
    for (auto& listener : region_ended) {
        listener->connect_writer(self_);
    }
    for (auto& port : tile_done) {
        port->connect_writer(self_);
    }
    for (auto& port : tile_state) {
        port->connect_writer(self_);
    }
}

void ArraySlice::start_of_simulation() {
    if (log_ == nullptr) {
        return;
    }
    const std::pair<const char*, std::int64_t> facts[] = {
        {"tile_size", job_.tile_size},
        {"slice", index_},
        {"slices", slices_},
        {"pes", config_.pes_per_bank},
        {"writeback_cycles", config_.writeback_cycles},
        {"termination", static_cast<int>(config_.termination)},
        {"contexts", config_.contexts},
        {"first_context", config_.first_context},
        {"streams", config_.streams},
        {"granted", config_.granted},
        {"segment_length", segment_length_},
        {"region_listeners", config_.region_listeners}};
    for (const auto& [name, value] : facts) {
        log_->set(name, value);
    }
    in.ring().log_takes(*log_, "packet");
    terminated.ring().log_puts(*log_, "terminated");
    for (std::size_t i = 0; i < region_ended.size(); ++i) {
        region_ended[i].ring().log_puts(*log_, "region_ended", i);
    }
    for (std::size_t i = 0; i < tile_done.size(); ++i) {
        tile_done[i].ring().log_puts(*log_, "tile_done", i);
        tile_state[i].ring().log_puts(*log_, "tile_state", i);
    }
}

// This is inlined, because a call more per packet is 1 % of a run.
template <ArraySlice::Tasks Kind>
inline __attribute__((always_inline)) void ArraySlice::execute(const TaskPacket& packet) {
    const Cycle now = self_.local();
    if (now != packet.slot) {
        refuse(packet.slot);
    }
    stats_.packets++;
    stats_.window.include(now);
    if (Kind == Tasks::Replayed) {
        end_pixels(packet);
        return;
    }
    const bool early = early_.has_value();
    for (const TaskRun& run : packet) {
        Context& context = context_of(run.task.context, run.tile);
        if (!early) {
            check_reuse(context.recent[run.domain], run.part, now);
        }
        // A segment is blended when its first task executes: nobody else touches its pixels before
        // its last one, so each packet only has to take its part of the outcome.
        const std::uint32_t first_task = run.task.mask & (0U - run.task.mask);
        if ((run.part & first_task) != 0 || early) {
            outcome_ = plain_ ? job_.path->blend(run.task) : blend_otherwise(context, run, now);
            const auto count = [](std::uint32_t mask) { return __builtin_popcount(mask); };
            stats_.slots[Slot::Useful] += count(outcome_.useful);
            stats_.slots[Slot::Boundary] += count(outcome_.boundary);
            stats_.slots[Slot::Terminated] += count(outcome_.terminated);
        }
        if (Kind == Tasks::Recorded) {
            record(run, now);
        }
        if ((outcome_.ended & run.part) != 0) {
            pixels_ended(context, run, outcome_.ended & run.part);
        }
    }
}

void ArraySlice::refuse(Cycle slot) const {
    throw std::logic_error(std::string(name()) + ": a packet planned for cycle " +
                           std::to_string(slot) + " executes in cycle " +
                           std::to_string(self_.local()));
}

BlendOutcome ArraySlice::blend_otherwise(const Context& context, const TaskRun& run, Cycle date) {
    return early_ ? blend_early(context, run, date) : blender_.blend(run.task, run.tile);
}

// Without scoreboard another task may come between two parts, so each is blended at its own date. A
// pixel that two tasks end, the second before it saw the first, is reported once.
BlendOutcome ArraySlice::blend_early(const Context& context, const TaskRun& run, Cycle date) {
    BlendOutcome outcome = early_->blend(run, date);
    stats_.hazards = early_->hazards();
    outcome.ended &= ~context.ended_in_segment[run.domain];
    return outcome;
}

void ArraySlice::record(const TaskRun& run, Cycle date) {
    part_->work(run.tile, date, date + 1);
    const auto add = [&](Slot slot, std::uint32_t mask) {
        if ((mask & run.part) != 0) {
            part_->add(slot, run.tile, date, __builtin_popcount(mask & run.part));
        }
    };
    add(Slot::Useful, outcome_.useful);
    add(Slot::Boundary, outcome_.boundary);
    add(Slot::Terminated, outcome_.terminated);
}

void ArraySlice::end_pixels(const TaskPacket& packet) {
    for (const TaskRun& run : packet) {
        pixels_ended(context_of(run.task.context, run.tile), run, run.outcome.ended & run.part);
    }
}

template <ArraySlice::Tasks Kind>
inline __attribute__((always_inline)) void ArraySlice::pump_packets() {
    while (!packets_->empty()) {
        const TaskPacket& packet = packets_->arrive(self_);
        const bool executed = packet.tasks != 0;
        if (executed) {
            execute<Kind>(packet);
        }
        const bool ends = packet.ends_tile;
        const TileNumber tile = packet.ended_tile;
        const std::int16_t context = packet.ended_context;
        packets_->drop(self_);
        if (ends) {
            end_tile(tile, context);
        }
        if (executed) {
            self_.advance();
        }
        if (ends) {
            count_tile(tile);
        }
    }
}

void ArraySlice::count_tile(TileNumber number) {
    tiles_.count(number);
    if (tiles_.over()) {
        end_reports();
        self_.finish();
    }
}

void ArraySlice::end_replayed(const TaskRun& run, std::uint32_t ended, Cycle date) {
    self_.advance_to(date);
    pixels_ended(context_of(run.task.context, run.tile), run, ended);
}

void ArraySlice::pass_end(TileNumber tile, std::int16_t context, Cycle date, bool packet) {
    self_.advance_to(date);
    end_tile(tile, context);
    if (packet) {
        pass_packet(date);
    }
    count_tile(tile);
}

void ArraySlice::run() {
    while (!tiles_.over()) {
        packets_->wait_for_item(self_);
        if (part_ == nullptr) {
            pump();
        } else {
            recorded_.pump();
        }
    }
}

void ArraySlice::pump() {
    pump_packets<Tasks::Blended>();
}

void ArraySlice::RecordedPump::pump() {
    if (slice_.replays_) {
        slice_.pump_packets<Tasks::Replayed>();
    } else {
        slice_.pump_packets<Tasks::Recorded>();
    }
}

void ArraySlice::start_tile(Context& context, TileNumber number) {
    const JobTile& tile = job_.tiles[number];
    if (log_ != nullptr) {
        log_tile(*log_, self_.local(), number, tile);
    }
    context.tile = number;
    context.live_pixels = 0;
    context.reported = false;
    context.live_in_segment.resize(segments_);
    context.ended_in_segment.assign(segments_, 0);
    context.recent.assign(segments_, Recent{});
    for (int s = 0; s < segments_; ++s) {
        const int row = s / segments_per_row_ * slices_ + index_;
        const int column = s % segments_per_row_ * segment_length_;
        const PixelRange segment{column, column + segment_length_ - 1};
        const int in_image = segment.within(tile.image_columns()).size();
        context.live_in_segment[s] = tile.image_rows().holds(row) ? in_image : 0;
        context.live_pixels += context.live_in_segment[s];
    }
}

void ArraySlice::pixels_ended(Context& context, const TaskRun& run, std::uint32_t ended) {
    const std::size_t segment = run.domain;
    const int count = __builtin_popcount(ended);
    if (log_ != nullptr) {
        log_ended(*log_, self_.local(), run, ended);
    }
    context.ended_in_segment[segment] |= ended;
    context.live_in_segment[segment] -= count;
    context.live_pixels -= count;
    stats_.pixels_ended += count;
    const bool all = context.live_in_segment[segment] == 0;
    if (all && config_.region_listeners != 0) {
        report_region(context, run);
    }
    if (all || config_.termination != TerminationGrain::Segment) {
        Termination message;
        message.tile = context.tile;
        message.row = run.task.row;
        message.column = run.task.column;
        message.context = run.task.context;
        message.mask = context.ended_in_segment[segment];
        terminated->put(self_, message);
    }
    if (context.live_pixels == 0 && !context.reported) {
        context.reported = true;
        tile_state[stream_of(run.task.context)]->put(self_, {context.tile, true});
    }
}

void ArraySlice::report_region(const Context& context, const TaskRun& run) {
    const std::size_t ports = region_ended.size() / config_.streams;
    const std::size_t port = stream_of(run.task.context) * ports + port_of_row_[run.task.row];
    const std::int16_t segment = inside_tile(run.task.column / segment_length_);
    region_ended[port]->put(self_, {context.tile, run.task.row, segment});
}

// It may be that no task of the tile came here.
void ArraySlice::end_tile(TileNumber number, std::int16_t in_context) {
    if (number == kNoTile) {
        return;
    }
    if (early_) {
        early_->finish(number);
    }
    Context& context = context_of(in_context, number);
    const std::size_t stream = stream_of(in_context);
    if (!context.reported) {
        context.reported = true;
        tile_state[stream]->put(self_, {number, context.live_pixels == 0});
    }
    tile_done[stream]->put(self_, {number, context.live_pixels == 0});
}

// Who is granted tiles does not know which is the last one.
void ArraySlice::end_reports() {
    for (int stream = 0; config_.granted && stream < config_.streams; ++stream) {
        tile_state[stream]->put(self_, {kNoTile, false});
        tile_done[stream]->put(self_, {kNoTile, false});
    }
}

} // namespace degs
