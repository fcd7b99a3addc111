// SPDX-License-Identifier: Apache-2.0
#include "config.hpp"
#include "modules/kit/engine/array_accelerator.hpp"

namespace degs::row_sweep {
namespace {

ArrayAccelerator::Parts parts_of(const Config& config) {
    ArrayAccelerator::Parts parts(config);
    parts.granted = true;
    parts.engines = config.arrays.count;
    parts.contexts = config.contexts();
    parts.splat_chunks = config.buffer.chunks;
    parts.buffer_bytes = config.buffer.bytes;
    parts.pixel_bytes = config.pixel_bytes();
    return parts;
}

class Engine : public ArrayAccelerator {
public:
    Engine(const char* name, const Config& config, const Timebase& time, RenderJob& job,
           const BuildOptions& options)
        : ArrayAccelerator(name, parts_of(config), time, job, options),
          tile_size_(config.tile_size) {
        for (int i = 0; i < config.arrays.count; ++i) {
            arrays_.push_back(std::make_unique<Array>(name_of("array", i).c_str(), config.arrays,
                                                      time, job, share_of(i)));
            connect(*arrays_.back());
        }
    }

private:
    void collect_array(AcceleratorResult& result) const override {
        using A = Array::Stats;
        add_array_slots(result, arrays_, tile_size_);
        const std::uint64_t rows = sum_of(arrays_, &A::busy);
        add_stage(result, {"blending", "Arrays, busy with a row of a splat.", true}, arrays_.size(),
                  rows, Counters().add(arrays_));
        add_activity(result, "blending", result.slots.executed());
        auto& laws = result.conservation;
        laws.push_back({"records fetched = swept over + abandoned", records_fetched(),
                        sum_of(arrays_, &A::splats) + sum_of(arrays_, &A::abandoned)});
        laws.push_back({"rows x PEs = slots executed", rows * tile_size_, result.slots.executed()});
        laws.push_back(
            {"tiles granted = worked on", dispatcher().stats().tiles, sum_of(arrays_, &A::tiles)});
    }

    std::uint64_t tile_size_;
    std::vector<std::unique_ptr<Array>> arrays_;
};

} // namespace

std::unique_ptr<RenderEngine> Config::build(const char* module, const Timebase& time,
                                            RenderJob& job, const BuildOptions& options) const {
    return std::make_unique<Engine>(module, *this, time, job, options);
}

} // namespace degs::row_sweep
