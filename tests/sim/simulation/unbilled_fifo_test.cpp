// SPDX-License-Identifier: Apache-2.0
// A FIFO of an engine that no buffer of its results and no unit stands for.
#include <gtest/gtest.h>

#include "baselines/gscore/config.hpp"
#include "sim/accelerator/accelerator_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs::sim_test {
namespace {

/// Another engine, with a queue of its own.
class QueueBeside : public RenderEngine {
public:
    QueueBeside(const sc_core::sc_module_name& name, const AcceleratorConfig& config,
                const Timebase& time, RenderJob& job, const BuildOptions& options)
        : RenderEngine(name), inner_(config.build("inner", time, job, options)),
          queue_("queue", time, 16) {}
    std::size_t finished_tiles() const override { return inner_->finished_tiles(); }
    void collect(AcceleratorResult& result) const override { inner_->collect(result); }

private:
    std::unique_ptr<RenderEngine> inner_;
    DatedFifo<std::uint32_t> queue_;
};

struct WithQueue : gscore::Config {
    std::unique_ptr<RenderEngine> build(const char* module, const Timebase& time, RenderJob& job,
                                        const BuildOptions& options) const override {
        return std::make_unique<QueueBeside>(module, gscore::Config(*this), time, job, options);
    }
};

TEST(SmallRunUnbilledFifo, EndsTheRunWithItsName) {
    const WithQueue config;
    const GaussianCloud cloud = test::random_cloud(50, 1);
    Camera camera;
    camera.width = camera.height = 64;
    camera.fx = camera.fy = 64;
    camera.position = {0, 0, -4};
    const FrameWorkload frame = make_frame_workload(cloud, camera, config.tile_size_px(),
                                                    config.tile_mode(), ProjectionOptions());
    sim::Progress progress("");
    try {
        sim::run_accelerator(config, source_of({&frame}), Fidelity::Exact, {}, {}, progress);
        FAIL() << "the queue is nowhere in the results";
    } catch (const std::logic_error& error) {
        EXPECT_NE(std::string(error.what()).find("stands for accelerator.queue of 16 cells;"),
                  std::string::npos)
            << error.what();
    }
}

} // namespace
} // namespace degs::sim_test
