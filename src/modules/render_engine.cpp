// SPDX-License-Identifier: Apache-2.0
#include "modules/render_engine.hpp"

#include "config/config_source.hpp"

namespace degs {

void AreaConfig::describe(ConfigVisitor& visitor) {
    visitor.real("fixed_mm2", fixed_mm2, 0, 1e6,
                 "mm2 at 28 nm of the blocks that do not follow the number of PEs");
    visitor.real("array_mm2", array_mm2, 0, 1e6,
                 "mm2 at 28 nm of the blocks that follow the number of PEs, at this number");
}

void AcceleratorConfig::describe_common(ConfigVisitor& visitor) {
    visitor.text("name", name, "what reports call this accelerator");
    visitor.real("clock_ghz", clock_ghz, 0.01, 10.0, "GHz (paper: 1.0)");
    visitor.section("area", area, "silicon; both 0: unknown");
    visitor.integer("frames_in_flight", frames_in_flight, 1, 64,
                    "frames being preprocessed or rendered at a time; 2: lists are double-buffered "
                    "and preprocessing of a frame overlaps rendering of the one before [assumed]");
    visitor.section("frame_end", frame_end, "background pixels, and who waits for a frame");
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

RenderJob make_render_job(const std::vector<const FrameWorkload*>& frames,
                          const AcceleratorConfig& config) {
    return make_render_job(frames, config.data_path(), config.tile_contexts(),
                           config.record_order());
}

} // namespace degs
