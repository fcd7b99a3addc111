// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/render_engine.hpp"

#include <utility>

#include "config/config_source.hpp"

namespace degs {

LoggedBlock& logged_block(const RenderEngine& engine, const std::string& design,
                          const std::string& name) {
    std::string known;
    for (const RenderEngine::BlockGroup& group : engine.logged_blocks()) {
        for (std::size_t i = 0; i < group.blocks.size(); ++i) {
            if (name == group.kind + ":" + std::to_string(i)) {
                return *group.blocks[i];
            }
        }
        known += (known.empty() ? "" : ", ") + group.kind + ":0 to " +
                 std::to_string(group.blocks.size() - 1);
    }
    throw InputError("--block-log " + name + ": " + design +
                     (known.empty() ? " has no block that writes a log."
                                    : " has no such block; there are " + known + "."));
}

void AcceleratorConfig::describe_common(ConfigVisitor& visitor) {
    visitor.text("name", name, "what reports call this accelerator");
    visitor.real("clock_ghz", clock_ghz, 0.01, 10.0, "GHz (paper: 1.0)");
    visitor.integer("frames_in_flight", frames_in_flight, 1, 64,
                    "frames that are preprocessed or rendered at a time [assumed]");
    visitor.integer("grant_cycles", grant_cycles, 1, 1024,
                    "cycles of a request for a tile, and of its grant, where several engines or "
                    "streams take tiles in turn [assumed]");
    visitor.choice("tile_order", tile_order, {"raster", "longest_list"},
                   "order of sorting and rendering; longest_list: by falling length of the lists, "
                   "in no time and on no area [assumed]");
    visitor.section("frame_end", frame_end, "background pixels, and who waits for a frame");
}

void AcceleratorConfig::describe_cost(ConfigVisitor& visitor) {
    visitor.begin_section("cost", "area, power and energy: the keys of configs/cost/*.yaml");
    cost.describe(visitor);
    describe_rows(visitor);
    visitor.end_section();
}

std::string AcceleratorConfig::problem() const {
    const std::unique_ptr<AcceleratorConfig> copy = clone();
    try {
        ConfigSource::from_overrides().read(
            [&](ConfigVisitor& visitor) { copy->describe(visitor); });
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

void AcceleratorConfig::scale_to(int pes) {
    throw InputError("--pes " + std::to_string(pes) + ": " + name +
                     " belongs to no family that says what other sizes look like.");
}

RenderJob make_render_job(const AcceleratorConfig& config, int views) {
    RenderJob job =
        make_render_job(config.data_path(), config.tile_size_px(), config.tile_contexts(),
                        config.record_order(), config.tile_order);
    if (config.view_sharing() != ViewSharing::Nothing) {
        job.views = views;
    }
    return job;
}

RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const AcceleratorConfig& config, int views) {
    RenderJob job = make_render_job(config, views);
    for (std::size_t f = 0; f < frames.size(); f += job.views) {
        std::vector<FramePointer> group;
        for (std::size_t v = f; v < f + job.views; ++v) {
            group.push_back(borrowed(*frames.at(v)));
        }
        job.add_together(std::move(group));
    }
    return job;
}

} // namespace degs
