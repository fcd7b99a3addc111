// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/projection_stage.hpp"

#include <algorithm>

#include "baselines/gcc/views_left.hpp"
#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs::gcc {

void ProjectionStage::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("units", units, 1, 64, "projection units [assumed]");
    visitor.integer("group", group, 1, 4096, "Gaussians per depth group; about 256 [unverified]");
    visitor.integer("groups_ahead", groups_ahead, 1, 64,
                    "groups between two steps of Stages II and III [assumed]");
    ProjectionRate::describe(visitor);
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles; depth of the projection pipeline [assumed]");
}

void append_gaussians(const FrameWorkload& frame, const SplatChunk& entries,
                      std::vector<std::uint32_t>& gaussians) {
    for (std::uint32_t i = 0; i < entries.count; ++i) {
        gaussians.push_back(frame.splats[frame.tile_splats[entries.first + i]].id);
    }
}

bool gcc_cancelled(Process& self, FifoPort<TileNumber>& cancel, TileNumber& first,
                   TileNumber view) {
    while (self.arrived(cancel.ring())) {
        first = std::max(first, cancel->take(self) + 1);
    }
    self.advance(); // what has arrived by a date is certain half a cycle after it
    return view < first;
}

ProjectionStage::ProjectionStage(const sc_core::sc_module_name& name, const Config& config,
                                 const Traffic& traffic, const Timebase& time, const RenderJob& job,
                                 bool granted)
    : sc_core::sc_module(name), start("start"), cancel("cancel", 2), out("out"),
      request("request", granted ? 1 : 0), views("views", granted ? 1 : 0), lists("lists", time),
      shapes("shapes", time), config_(config), traffic_(traffic), job_(job), granted_(granted),
      loader_(time), fetcher_(time), projector_(time), loaded_("loaded", time, config.groups_ahead),
      fetched_("fetched", time, config.groups_ahead) {
    loaded_.set_billed();
    fetched_.set_billed();
    DEGS_HAS_PROCESS(ProjectionStage);
    SC_THREAD(load);
    SC_THREAD(fetch);
    SC_THREAD(project);
    loader_.show(*this, "lists");
    fetcher_.show(*this, "shapes");
    projector_.show(*this, stats_.busy);
}

void ProjectionStage::end_of_elaboration() {
    start->connect_reader(loader_);
    cancel[0]->connect_reader(loader_);
    cancel[1]->connect_reader(fetcher_);
    loaded_.connect_writer(loader_);
    loaded_.connect_reader(fetcher_);
    fetched_.connect_writer(fetcher_);
    fetched_.connect_reader(projector_);
    out->connect_writer(projector_);
    for (auto& port : request) {
        port->connect_writer(loader_);
    }
    for (auto& port : views) {
        port->connect_reader(loader_);
    }
}

TileNumber ProjectionStage::next_view() {
    if (granted_) {
        request[0]->put(loader_, {});
        return views[0]->get(loader_).tile;
    }
    return job_.has_tile(loader_, next_view_) ? next_view_++ : kNoTile;
}

void ProjectionStage::load() {
    std::uint32_t frames_started = 0;
    for (TileNumber number = next_view(); number != kNoTile; number = next_view()) {
        for (; frames_started <= job_.tiles[number].frame; ++frames_started) {
            start->get(loader_);
        }
        load_view(number);
    }
    if (granted_) {
        loaded_.put(loader_, {kNoTile, 0, 0, true});
    }
    loader_.finish();
}

void ProjectionStage::load_view(TileNumber number) {
    const JobTile& view = job_.tiles[number];
    const MemoryMap map(traffic_, job_, view.frame);
    SplatChunk group;
    group.tile = number;
    for (std::uint64_t done = 0; done < view.count;) {
        loaded_.reserve(loader_);
        group.first = view.first + done;
        group.count = 0;
        Completion ready;
        if (gcc_cancelled(loader_, cancel[0], load_from_, number)) {
            stats_.entries_cancelled += view.count - done;
            done = view.count;
        } else {
            group.count = next_chunk_of(config_.group, view.count - done);
            ready = lists.read(loader_, map.views + group.first * traffic_.entry_bytes(),
                               group.count * traffic_.entry_bytes());
            done += group.count;
            stats_.groups++;
            stats_.entries += group.count;
        }
        group.last = done == view.count;
        loaded_.put_at(loader_, group, ready);
    }
}

void ProjectionStage::fetch() {
    for (ViewsLeft left(job_, granted_); left.any();) {
        SplatChunk group = loaded_.get(fetcher_);
        left.take(group);
        fetched_.reserve(fetcher_);
        Completion ready;
        if (gcc_cancelled(fetcher_, cancel[1], fetch_from_, group.tile)) {
            stats_.shapes_cancelled += group.count;
            group.count = 0;
        }
        if (group.count != 0) {
            ready = read_shapes(group);
        }
        if (group.count != 0 || group.last) {
            fetched_.put_at(fetcher_, group, ready);
        }
    }
    fetcher_.finish();
}

Completion ProjectionStage::read_shapes(const SplatChunk& group) {
    const JobTile& view = job_.tiles[group.tile];
    gaussians_.clear();
    append_gaussians(job_.frame_of(view), group, gaussians_);
    return shapes.read(
        fetcher_, shape_records(traffic_, job_, view.frame, gaussians_.data(), gaussians_.size()));
}

void ProjectionStage::project() {
    const Cycle units = config_.units;
    for (ViewsLeft left(job_, granted_); left.any();) {
        const SplatChunk group = fetched_.get(projector_);
        left.take(group);
        if (group.count != 0) { // the end of granted views has no tile
            const FrameWorkload& frame = job_.frame_of(job_.tiles[group.tile]);
            const Cycle each = config_.project_cycles(frame.projection.rule);
            projector_.work(ceil_div(group.count, units) * each, stats_.busy);
        }
        stats_.shapes += group.count;
        out->put(projector_, group);
    }
    projector_.finish();
}

} // namespace degs::gcc
