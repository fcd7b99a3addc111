// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/front_end/projection_unit.hpp"

#include <algorithm>

#include "tlm/has_process.hpp"

namespace degs {

void ProjectionUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 64, "units (paper Table I: 4)");
    visitor.integer("chunk", chunk, 1, 4096,
                    "Gaussians per geometry request, for long bursts [assumed]");
    visitor.integer("chunks_in_flight", chunks_in_flight, 1, 256,
                    "geometry requests outstanding per unit; 4 cover 100 ns [assumed]");
    visitor.integer("chunks_ahead", chunks_ahead, 1, 256,
                    "projected chunks of a unit that wait for the binner [assumed]");
    ProjectionRate::describe(visitor);
    visitor.integer("cycles_per_colour", cycles_per_colour, 1, 1024,
                    "cycles per visible Gaussian for its SH colour [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles; depth of the projection pipeline [assumed]");
    visitor.choice("shared_by_views", shared_by_views, {"nothing", "geometry", "sh", "colour"},
                   "views of a frame (--eyes, --views): nothing: each is a frame of its own; "
                   "geometry: it is read once; sh: SH, too; colour: SH are evaluated once for the "
                   "middle of the views, which changes images; sh is the most that does not "
                   "[assumed]");
}

ProjectionUnit::ProjectionUnit(const sc_core::sc_module_name& name, const Config& config,
                               const TrafficConfig& traffic, const Timebase& time,
                               const RenderJob& job, int index, int frames_in_flight)
    : sc_core::sc_module(name), geometry("geometry", time), sh("sh", time), out("out"),
      frame_free("frame_free", frames_in_flight == 0 ? 0 : 1), config_(config), traffic_(traffic),
      job_(job), index_(index), in_flight_(frames_in_flight), fetcher_(time), projector_(time),
      shader_(time), fetched_("fetched", time, config.chunks_in_flight),
      projected_("projected", time, config.chunks_in_flight * job.views, config.latency_cycles) {
    fetched_.set_billed();
    projected_.set_billed();
    DEGS_HAS_PROCESS(ProjectionUnit);
    SC_THREAD(fetch);
    SC_THREAD(project);
    SC_THREAD(shade);
    fetcher_.show(*this, "geometry");
    projector_.show(*this, stats_.project_busy);
    shader_.show(*this, stats_.shade_busy, 1, "colour");
}

void ProjectionUnit::end_of_elaboration() {
    fetched_.connect_writer(fetcher_);
    fetched_.connect_reader(projector_);
    projected_.connect_writer(projector_);
    projected_.connect_reader(shader_);
    out->connect_writer(shader_);
    for (auto& port : frame_free) {
        port->connect_reader(fetcher_);
    }
}

void ProjectionUnit::fetch() {
    const std::uint64_t chunk = config_.chunk;
    const std::uint64_t stride = chunk * config_.count;
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(fetcher_, f); f += views) {
        views = job_.views_of(f);
        in_flight_.begin(views, frame_free, fetcher_);
        const MemoryMap map = job_.map(f, traffic_);
        const std::uint64_t total = job_.frames[f]->gaussians;
        const std::uint64_t bytes = traffic_.geometry_size();
        for (std::uint64_t first = chunk * index_; first < total; first += stride) {
            const std::uint64_t count = std::min(chunk, total - first);
            fetched_.reserve(fetcher_);
            const Completion ready =
                geometry.read(fetcher_, map.geometry + first * bytes, count * bytes);
            fetched_.put_at(fetcher_, {f, first, count}, ready);
            fetcher_.advance();
        }
    }
    fetcher_.finish();
}

void ProjectionUnit::project() {
    const std::uint64_t chunk = config_.chunk;
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(projector_, f); f += views) {
        views = job_.views_of(f);
        views_.resize(views);
        projected_.set_depth(config_.chunks_in_flight * views); // all before has been shaded
        const std::uint64_t total = job_.frames[f]->gaussians;
        for (std::uint64_t first = chunk * index_; first < total; first += chunk * config_.count) {
            project_views(fetched_.get(projector_));
        }
    }
    projector_.finish();
}

void ProjectionUnit::project_views(const Chunk& chunk) {
    const bool together = views_.size() > 1 && config_.shared_by_views >= ViewSharing::Sh;
    stats_.gaussians += chunk.count;
    std::uint32_t frame = chunk.frame;
    for (ProjectedChunk& view : views_) {
        view = seen_in(frame++, chunk);
        const ProjectionRule rule = job_.frames[view.frame]->projection.rule;
        const Cycle busy = chunk.count * config_.project_cycles(rule);
        projector_.work(busy, stats_.project_busy);
        if (!together) {
            projected_.reserve(projector_);
            const std::uint32_t* const gaussians =
                job_.frames[view.frame]->visible_of.data() + view.first_visible;
            projected_.put_at(projector_, view, read_sh(chunk, gaussians, view.visible));
        }
    }
    if (together) {
        hand_over_together(chunk);
    }
}

ProjectedChunk ProjectionUnit::seen_in(std::uint32_t view, const Chunk& chunk) const {
    const FrameWorkload& frame = *job_.frames[view];
    ProjectedChunk seen;
    seen.frame = view;
    seen.first_visible = frame.visible_among(chunk.first);
    seen.visible = frame.visible_among(chunk.first + chunk.count) - seen.first_visible;
    seen.colours = seen.visible;
    seen.tile_pairs = job_.pairs_before(view, seen.first_visible + seen.visible) -
                      job_.pairs_before(view, seen.first_visible);
    return seen;
}

// Which Gaussians any view shows is known when the last one has been projected.
void ProjectionUnit::hand_over_together(const Chunk& chunk) {
    collect_seen();
    if (config_.shared_by_views == ViewSharing::Colour) {
        for (ProjectedChunk& view : views_) {
            view.colours = 0;
        }
        views_.front().colours = static_cast<std::uint32_t>(seen_.size());
    }
    projected_.reserve(projector_);
    const Completion ready = read_sh(chunk, seen_.data(), seen_.size());
    for (const ProjectedChunk& view : views_) {
        projected_.put_at(projector_, view, ready);
    }
}

void ProjectionUnit::collect_seen() {
    seen_.clear();
    for (const ProjectedChunk& view : views_) {
        const std::uint32_t* const first =
            job_.frames[view.frame]->visible_of.data() + view.first_visible;
        const auto middle = static_cast<std::ptrdiff_t>(seen_.size());
        seen_.insert(seen_.end(), first, first + view.visible);
        std::inplace_merge(seen_.begin(), seen_.begin() + middle, seen_.end());
    }
    seen_.erase(std::unique(seen_.begin(), seen_.end()), seen_.end());
}

Completion ProjectionUnit::read_sh(const Chunk& chunk, const std::uint32_t* gaussians,
                                   std::size_t count) {
    if (traffic_.sh == ShReads::All) {
        const std::uint64_t record = traffic_.sh_size(job_.frames[chunk.frame]->sh_degree);
        const std::uint64_t array = job_.map(chunk.frame, traffic_).sh;
        return sh.read(projector_, array + chunk.first * record, chunk.count * record);
    }
    ScatteredRecords records = job_.sh_records(chunk.frame, traffic_, gaussians, count);
    records.neighbours_share = true;
    return sh.read(projector_, records);
}

void ProjectionUnit::shade() {
    const Cycle cycles = config_.cycles_per_colour;
    const std::uint64_t chunk = config_.chunk;
    std::uint32_t views = 0;
    for (std::uint32_t f = 0; job_.has_frame(shader_, f); f += views) {
        views = job_.views_of(f);
        const std::uint64_t total = job_.frames[f]->gaussians;
        for (std::uint64_t first = chunk * index_; first < total; first += chunk * config_.count) {
            for (std::uint32_t v = 0; v < views; ++v) {
                const ProjectedChunk in = projected_.get(shader_);
                const Cycle busy = in.colours * cycles;
                shader_.work(busy, stats_.shade_busy);
                stats_.visible += in.visible;
                out->put(shader_, in);
            }
        }
    }
    shader_.finish();
}

} // namespace degs
