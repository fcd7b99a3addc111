// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/grouping.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs::gcc {

void Grouping::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("means_per_cycle", means_per_cycle, 1, 1024, "means per cycle [assumed]");
    visitor.integer("chunk", chunk, 1, 65536, "means per request [assumed]");
    visitor.integer("chunks_in_flight", chunks_in_flight, 1, 256,
                    "requests outstanding; 4 cover 100 ns [assumed]");
    visitor.integer("entries_per_cycle", entries_per_cycle, 1, 1024,
                    "list entries per cycle [assumed]");
    visitor.integer("writes_in_flight", writes_in_flight, 1, 1024,
                    "chunk writes not yet acknowledged by memory [assumed]");
    visitor.choice("lists", lists, {"direct", "regrouped"},
                   "image of several views: entries go to the lists of the views at once, or "
                   "through groups of the image in a second pass [assumed]");
    visitor.choice("shared_by_views", shared_by_views, {"nothing", "geometry"},
                   "views of a frame (--eyes, --views): nothing: each is a frame of its own; "
                   "geometry: Stage I reads the means once, Stages II and III share nothing "
                   "[assumed]");
}

Grouping::Grouping(const sc_core::sc_module_name& name, const Config& config,
                   const Traffic& traffic, const Timebase& time, const RenderJob& job,
                   int frames_in_flight, std::size_t listeners, std::size_t readers)
    : sc_core::sc_module(name), out("out", readers), listed("listed", listeners),
      frame_free("frame_free", frames_in_flight == 0 ? 0 : 1), means("means", time),
      lists("lists", time), config_(config), traffic_(traffic), job_(job),
      in_flight_(frames_in_flight), fetcher_(time), grouper_(time),
      fetched_("fetched", time, config.chunks_in_flight),
      acknowledged_(config.writes_in_flight, 0) {
    fetched_.set_billed();
    DEGS_HAS_PROCESS(Grouping);
    SC_THREAD(fetch);
    SC_THREAD(group);
    fetcher_.show(*this, "means");
    grouper_.show(*this, stats_.busy);
}

void Grouping::end_of_elaboration() {
    fetched_.connect_writer(fetcher_);
    fetched_.connect_reader(grouper_);
    for (auto& port : out) {
        port->connect_writer(grouper_);
    }
    for (auto& port : listed) {
        port->connect_writer(grouper_);
    }
    for (auto& port : frame_free) {
        port->connect_reader(fetcher_);
    }
}

void Grouping::fetch() {
    const std::uint64_t chunk = config_.chunk;
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(fetcher_, f); f += views) {
        views = job_.views_of(f);
        in_flight_.begin(views, frame_free, fetcher_);
        const FrameWorkload& frame = *job_.frames[f];
        const MemoryMap map(traffic_, job_, f);
        const std::uint64_t record = traffic_.stage_one_bytes();
        for (std::uint64_t first = 0; first < frame.gaussians; first += chunk) {
            const std::uint64_t count = std::min(chunk, frame.gaussians - first);
            fetched_.reserve(fetcher_);
            const Completion ready =
                means.read(fetcher_, map.means + first * record, count * record);
            fetched_.put_at(fetcher_, {first, count}, ready);
            fetcher_.advance();
        }
    }
    fetcher_.finish();
}

void Grouping::group() {
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(grouper_, f); f += views) {
        views = job_.views_of(f);
        regions_.resize(views);
        for (std::uint32_t v = 0; v < views; ++v) {
            const MemoryMap map(traffic_, job_, f + v);
            regions_[v] = {by_view(*job_.frames[f + v]) ? map.views : map.groups, 0};
        }
        const std::uint64_t chunks = ceil_div(job_.frames[f]->gaussians, config_.chunk);
        for (std::uint64_t c = 0; c < chunks; ++c) {
            const Chunk chunk = fetched_.get(grouper_);
            stats_.gaussians += chunk.count;
            for (std::uint32_t v = 0; v < views; ++v) {
                group_chunk(f + v, chunk);
            }
        }
        for (std::uint32_t v = 0; v < views; ++v) {
            finish_lists(f + v);
        }
    }
    grouper_.finish();
}

void Grouping::finish_lists(std::uint32_t f) {
    const FrameWorkload& frame = *job_.frames[f];
    grouper_.wait_for_memory(last_write_); // lists are read back from memory: they must be there
    if (!by_view(frame)) {
        regroup(f);
    }
    stats_.view_entries += frame.tile_pairs();
    frames_grouped_.push_back(grouper_.local());
    frames_grouped_.drop_before(job_.first_dated());
    for (auto& port : out) {
        port->put(grouper_, f);
    }
    for (auto& port : listed) {
        port->put(grouper_, f);
    }
}

void Grouping::group_chunk(std::uint32_t f, const Chunk& chunk) {
    const FrameWorkload& frame = *job_.frames[f];
    const std::uint32_t begin = frame.visible_among(chunk.first);
    const std::uint32_t end = frame.visible_among(chunk.first + chunk.count);
    const std::uint64_t entries =
        by_view(frame) ? job_.pairs_before(f, end) - job_.pairs_before(f, begin) : end - begin;
    write(regions_[f - job_.first_view_of(f)], entries,
          ceil_div(chunk.count, config_.means_per_cycle));
}

// Entries of the image's groups come back near to far, as many requests ahead as for the means.
void Grouping::regroup(std::uint32_t f) {
    const FrameWorkload& frame = *job_.frames[f];
    const MemoryMap map(traffic_, job_, f);
    const std::size_t chunk = config_.chunk;
    const std::size_t visible = frame.splats.size();
    const std::size_t pieces = (visible + chunk - 1) / chunk;
    std::vector<Completion> ready(config_.chunks_in_flight, 0);
    Region views{map.views, 0};
    std::size_t asked = 0;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
        for (; asked < std::min(pieces, piece + ready.size()); ++asked) {
            const std::size_t count = std::min(chunk, visible - asked * chunk);
            ready[asked % ready.size()] =
                lists.read(grouper_, map.groups + asked * chunk * traffic_.entry_bytes(),
                           count * traffic_.entry_bytes());
            grouper_.advance();
        }
        grouper_.wait_for_memory(ready[piece % ready.size()]);
        std::uint64_t entries = 0;
        for (std::size_t s = piece * chunk; s < std::min(visible, (piece + 1) * chunk); ++s) {
            entries += frame.tiles_touched[s];
        }
        write(views, entries, 1);
    }
    grouper_.wait_for_memory(last_write_);
}

void Grouping::write(Region& region, std::uint64_t entries, Cycle least_cycles) {
    const Cycle entry_cycles = ceil_div(entries, config_.entries_per_cycle);
    grouper_.work(std::max(least_cycles, entry_cycles), stats_.busy);
    stats_.mean_cycles += least_cycles;
    stats_.entry_cycles += entry_cycles;
    stats_.entries_written += entries;
    Completion& oldest = acknowledged_[writes_++ % acknowledged_.size()];
    grouper_.wait_for_memory(oldest);
    oldest = lists.write(grouper_, region.base + region.entries * traffic_.entry_bytes(),
                         entries * traffic_.entry_bytes());
    region.entries += entries;
    last_write_ = latest(last_write_, oldest);
}

} // namespace degs::gcc
