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
    visitor.integer("cycles_per_gaussian", cycles_per_gaussian, 1, 1024,
                    "cycles per Gaussian and unit, so that bandwidth limits [assumed]");
    visitor.integer("unscented_passes", unscented_passes, 1, 1024,
                    "of a Gaussian through a unit with pipeline.rules.projection: unscented, as "
                    "its 666 operations to the 167 of linear [assumed]");
    visitor.integer("cycles_per_colour", cycles_per_colour, 1, 1024,
                    "cycles per visible Gaussian for its SH colour [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 4096,
                    "cycles; depth of the projection pipeline [assumed]");
}

ProjectionUnit::ProjectionUnit(const sc_core::sc_module_name& name, const Config& config,
                               const TrafficConfig& traffic, const Timebase& time,
                               const RenderJob& job, int index, int frames_in_flight)
    : sc_core::sc_module(name), geometry("geometry", time), sh("sh", time), out("out"),
      frame_free("frame_free", frames_in_flight == 0 ? 0 : 1), config_(config), traffic_(traffic),
      job_(job), index_(index), frames_in_flight_(frames_in_flight), fetcher_(time),
      projector_(time), shader_(time), fetched_("fetched", time, config.chunks_in_flight),
      projected_("projected", time, config.chunks_in_flight, config.latency_cycles) {
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
    for (std::uint32_t f = 0; job_.has_frame(fetcher_, f); ++f) {
        if (frames_in_flight_ != 0 && f >= frames_in_flight_) {
            frame_free[0]->get(fetcher_);
        }
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
    for (std::uint32_t f = 0; job_.has_frame(projector_, f); ++f) {
        const FrameWorkload& frame = *job_.frames[f];
        const std::uint64_t chunk = config_.chunk;
        for (std::uint64_t first = chunk * index_; first < frame.gaussians;
             first += chunk * config_.count) {
            const Chunk in = fetched_.get(projector_);
            ProjectedChunk result;
            result.frame = f;
            result.first_visible = frame.visible_among(in.first);
            result.visible = frame.visible_among(in.first + in.count) - result.first_visible;
            result.tile_pairs = job_.pairs_before(f, result.first_visible + result.visible) -
                                job_.pairs_before(f, result.first_visible);
            const Cycle busy = in.count * config_.project_cycles(frame.projection.rule);
            projector_.work(busy, stats_.project_busy);
            stats_.gaussians += in.count;
            projected_.reserve(projector_);
            projected_.put_at(projector_, result, read_sh(f, in, result));
        }
    }
    projector_.finish();
}

Completion ProjectionUnit::read_sh(std::uint32_t f, const Chunk& chunk,
                                   const ProjectedChunk& visible) {
    const FrameWorkload& frame = *job_.frames[f];
    if (traffic_.sh == ShReads::All) {
        const std::uint64_t record = traffic_.sh_size(frame.sh_degree);
        const std::uint64_t array = job_.map(f, traffic_).sh;
        return sh.read(projector_, array + chunk.first * record, chunk.count * record);
    }
    ScatteredRecords records = job_.sh_records(
        f, traffic_, frame.visible_of.data() + visible.first_visible, visible.visible);
    records.neighbours_share = true;
    return sh.read(projector_, records);
}

void ProjectionUnit::shade() {
    const Cycle cycles = config_.cycles_per_colour;
    for (std::uint32_t f = 0; job_.has_frame(shader_, f); ++f) {
        const std::uint64_t chunk = config_.chunk;
        for (std::uint64_t first = chunk * index_; first < job_.frames[f]->gaussians;
             first += chunk * config_.count) {
            const ProjectedChunk in = projected_.get(shader_);
            const Cycle busy = in.visible * cycles;
            shader_.work(busy, stats_.shade_busy);
            stats_.visible += in.visible;
            out->put(shader_, in);
        }
    }
    shader_.finish();
}

} // namespace degs
