// SPDX-License-Identifier: Apache-2.0
#include "baselines/gcc/colour_stage.hpp"

#include <algorithm>

#include "baselines/gcc/projection_stage.hpp"
#include "baselines/gcc/views_left.hpp"
#include "tlm/ceil_div.hpp"
#include "tlm/has_process.hpp"

namespace degs::gcc {

void ColourStage::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("units", units, 1, 64, "SH units [assumed]");
    visitor.integer("cycles_per_colour", cycles_per_colour, 1, 1024,
                    "cycles per Gaussian and unit for its SH colour [assumed]");
    visitor.integer("keys_per_cycle", keys_per_cycle, 1, 1024,
                    "keys per cycle and pass of the sorter [assumed]");
    visitor.integer("merge_ways", merge_ways, 2, 1024, "fan-in of a merge pass [assumed]");
    visitor.boolean("skip_ended", skip_ended,
                    "drop Gaussians that reach ended blocks only (cross-stage conditional "
                    "processing)");
    visitor.integer("block", block, 1, 1024, "px; granularity of the mask [unverified]");
    visitor.integer("feedback_cycles", feedback_cycles, 1, 4096,
                    "cycles from the slot that ends a block to the mask [assumed]");
    if (!skip_ended) {
        visitor.unused("block", "skip_ended", "skip_ended is false");
        visitor.unused("feedback_cycles", "skip_ended", "skip_ended is false");
    }
    visitor.integer("chunk", chunk, 1, 1024, "splats per hand-over to Stage IV [assumed]");
}

ColourStage::ColourStage(const sc_core::sc_module_name& name, const Config& config,
                         const Traffic& traffic, const Timebase& time, const RenderJob& job,
                         int groups_ahead, bool granted)
    : sc_core::sc_module(name), in("in"), cancel("cancel"),
      block_ended("block_ended", config.skip_ended ? 1 : 0), out("out"), sh("sh", time),
      config_(config), traffic_(traffic), job_(job), granted_(granted), fetcher_(time),
      shader_(time), fetched_("fetched", time, groups_ahead), mask_(job.tile_size, config.block) {
    fetched_.set_billed();
    DEGS_HAS_PROCESS(ColourStage);
    SC_THREAD(fetch);
    SC_THREAD(shade);
    fetcher_.show(*this, "SH");
    shader_.show(*this, shade_cycles_);
}

void ColourStage::end_of_elaboration() {
    in->connect_reader(fetcher_);
    cancel->connect_reader(fetcher_);
    for (auto& port : block_ended) {
        port->connect_reader(fetcher_);
    }
    fetched_.connect_writer(fetcher_);
    fetched_.connect_reader(shader_);
    out->connect_writer(shader_);
}

// A group enters when the one before has asked for its SH and a place behind it is free.
void ColourStage::fetch() {
    for (ViewsLeft left(job_, granted_); left.any();) {
        SplatChunk group = in->get(fetcher_);
        left.take(group);
        fetched_.reserve(fetcher_);
        if (group.tile == kNoTile) {
            fetched_.put(fetcher_, {group, 0, {}});
            break;
        }
        see_ended_blocks(group.tile);
        if (gcc_cancelled(fetcher_, cancel, from_, group.tile)) {
            stats_.cancelled += group.count;
            group.count = 0;
        }
        const Survivors survivors = filter(group);
        if (survivors.count != 0 || group.last) {
            fetched_.put_at(fetcher_, survivors, read_sh(survivors));
        }
    }
    fetcher_.finish();
}

void ColourStage::see_ended_blocks(TileNumber view) {
    if (masked_view_ != view) {
        masked_view_ = view;
        mask_.begin();
    }
    for (auto& port : block_ended) {
        while (fetcher_.arrived(port.ring())) {
            const BlockEnded block = port->take(fetcher_);
            if (block.view == view) {
                mask_.end_block(block.row, block.column);
            }
        }
    }
}

ColourStage::Survivors ColourStage::filter(const SplatChunk& group) {
    const JobTile& view = job_.tiles[group.tile];
    const FrameWorkload& frame = job_.frame_of(view);
    const std::uint32_t chunk = config_.chunk;
    Survivors left;
    left.group = group;
    for (std::uint64_t i = group.first; i < group.first + group.count; ++i) {
        const std::uint32_t splat = view.first_splat + frame.tile_splats[i];
        if (config_.skip_ended && !mask_.reaches(*job_.path, splat, view)) {
            stats_.masked++;
            continue;
        }
        ++left.count;
        const bool joins = !left.runs.empty() &&
                           left.runs.back().first + left.runs.back().count == i &&
                           left.runs.back().count < chunk;
        if (joins) {
            left.runs.back().count++;
        } else {
            left.runs.push_back({group.tile, i, 1, false});
        }
    }
    stats_.coloured += left.count;
    return left;
}

Completion ColourStage::read_sh(const Survivors& survivors) {
    const JobTile& view = job_.tiles[survivors.group.tile];
    gaussians_.clear();
    for (const SplatChunk& run : survivors.runs) {
        append_gaussians(job_.frame_of(view), run, gaussians_);
    }
    return sh.read(fetcher_, job_.sh_records(view.frame, traffic_.common(), gaussians_.data(),
                                             gaussians_.size()));
}

void ColourStage::shade() {
    const std::uint64_t units = config_.units;
    for (ViewsLeft left(job_, granted_); left.any();) {
        const Survivors survivors = fetched_.get(shader_);
        left.take(survivors.group);
        const Cycle colour = ceil_div(survivors.count, units) * config_.cycles_per_colour;
        const Cycle sort = sort_cycles(survivors.count);
        stats_.colour_busy += colour;
        stats_.sort_busy += sort;
        shader_.work(std::max(colour, sort), shade_cycles_);
        hand_over(survivors);
    }
    shader_.finish();
}

Cycle ColourStage::sort_cycles(std::uint64_t keys) const {
    const std::uint64_t ways = config_.merge_ways;
    const std::uint64_t rate = config_.keys_per_cycle;
    std::uint64_t passes = 0;
    for (std::uint64_t runs = keys; runs > 1; ++passes) {
        runs = (runs + ways - 1) / ways;
    }
    return (keys * std::max<std::uint64_t>(passes, 1) + rate - 1) / rate;
}

void ColourStage::hand_over(const Survivors& survivors) {
    SplatChunk none = survivors.group;
    none.count = 0;
    if (survivors.runs.empty() && none.last) {
        out->put(shader_, none);
    }
    for (std::size_t i = 0; i < survivors.runs.size(); ++i) {
        SplatChunk run = survivors.runs[i];
        run.last = none.last && i + 1 == survivors.runs.size();
        out->put(shader_, run);
    }
}

} // namespace degs::gcc
