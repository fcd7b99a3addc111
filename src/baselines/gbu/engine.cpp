// SPDX-License-Identifier: Apache-2.0
#include "baselines/gbu/engine.hpp"

namespace degs::gbu {
namespace {

TiledAccelerator::Parts parts_of(const Config& config) {
    TiledAccelerator::Parts parts(config);
    parts.pixel_buffer = config.pixel_buffer.part_of(config.engines.count);
    parts.granted = true;
    parts.engines = config.engines.count;
    parts.contexts = config.contexts();
    parts.splat_chunks = config.list_buffer.chunks;
    parts.cache_records = config.cache_records();
    parts.splat_rings = "splat_buffer";
    return parts;
}

} // namespace

Engine::Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, const BuildOptions& options)
    : TiledAccelerator(name, parts_of(config), time, job, options), config_(config) {
    for (int e = 0; e < config_.engines.count; ++e) {
        engines_.push_back(std::make_unique<TileEngine>(numbered("engine", e).c_str(),
                                                        config_.engines, time, job,
                                                        first_context(e), config_.contexts()));
        connect(*engines_.back());
    }
}

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

} // namespace degs::gbu
