// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/engine.hpp"

namespace degs::orange {
namespace {

TiledAccelerator::Parts parts_of(const Config& config) {
    TiledAccelerator::Parts parts(config);
    parts.pixel_buffer = config.pixel_buffer.part_of(config.cores.count);
    parts.granted = true;
    parts.engines = config.cores.count;
    parts.contexts = config.contexts();
    parts.splat_chunks = config.scratchpad.splat_batches;
    parts.splat_rings = "splat_buffer";
    return parts;
}

} // namespace

Engine::Engine(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
               RenderJob& job, const BuildOptions& options)
    : TiledAccelerator(name, parts_of(config), time, job, options), config_(config) {
    for (int core = 0; core < config_.cores.count; ++core) {
        build_core(core);
    }
}

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

void Engine::build_core(int index) {
    const std::size_t core = index;
    const Config::Cores& cores = config_.cores;
    vector_units_.push_back(std::make_unique<VectorUnit>(
        numbered("vector_unit", core).c_str(), cores.vector, time(), job(), cores.array.macs(),
        first_context(index), config_.contexts()));
    arrays_.push_back(std::make_unique<SystolicArray>(numbered("systolic_array", core).c_str(),
                                                      cores.array, time(), job()));
    VectorUnit& vector = *vector_units_.back();
    SystolicArray& array = *arrays_.back();
    connect(vector);
    const auto ring = [&](Rings<GemmBatch>& rings, const char* name, int batches,
                          FifoPort<GemmBatch>& writer, FifoPort<GemmBatch>& reader) {
        auto& batches_ring = add_ring(rings, name, time(), batches, 1, 1);
        writer.bind(batches_ring);
        reader.bind(batches_ring);
    };
    ring(coefficient_rings_, "coefficients", config_.scratchpad.coefficient_batches,
         vector.coefficients, array.in);
    ring(product_rings_, "products", config_.scratchpad.product_batches, array.out,
         vector.products);
}

} // namespace degs::orange
