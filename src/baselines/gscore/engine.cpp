// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore/engine.hpp"

namespace degs::gscore {
namespace {

ArrayAccelerator::Parts parts_of(const Config& config) {
    ArrayAccelerator::Parts parts(config);
    parts.granted = config.clusters > 1;
    parts.engines = config.clusters;
    parts.contexts = config.contexts();
    parts.splat_chunks = config.splat_chunks();
    parts.buffer_bytes = config.buffer.bytes - config.pixel_buffer.bytes;
    parts.pixel_bytes = config.pixel_bytes();
    parts.writeback_cycles = config.array.pipeline_cycles;
    return parts;
}

} // namespace

Engine::Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, const BuildOptions& options)
    : ArrayAccelerator(name, parts_of(config), time, job, options), config_(config), boxes_(job) {
    for (int c = 0; c < config_.clusters; ++c) {
        arrays_.push_back(std::make_unique<LockstepArray>(
            name_of("array", c).c_str(), config_.array, time, job, boxes_, share_of(c)));
        connect(*arrays_.back());
    }
}

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

} // namespace degs::gscore
