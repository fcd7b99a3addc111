// SPDX-License-Identifier: Apache-2.0
// Runs in processes of their own, and what they counted.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/design/run_config.hpp"
#include "sim/process/child_process.hpp"
#include "sim/simulation/simulation.hpp"
#include "splat/numbers/lookup_table.hpp"

namespace degs::sim_test {

inline sim::RunConfig shipped(const std::string& design,
                              const std::vector<std::string>& overrides = {}) {
    return sim::load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", overrides);
}

/// Counters by "stage.counter", bytes and requests by "stream.bytes", and besides "activations",
/// "tiles", "background_tiles", "lookup_tables" (with cells) and "dram_commands" (null without
/// LPDDR5).
using Counts = nlohmann::json;

inline Counts counts_of(const AcceleratorResult& result) {
    Counts counts{{"activations", result.activations},
                  {"tiles", result.tiles},
                  {"background_tiles", result.background_tiles},
                  {"lookup_tables", LookupTable::filled()},
                  {"dram_commands", nullptr}};
    for (const StageUse& stage : result.stages) {
        counts["stages"][stage.name]["busy_cycles"] = stage.busy_cycles;
        for (const Counters::Counter& counter : stage.counters) {
            counts["stages"][stage.name][counter.doc.name] = counter.value;
        }
    }
    for (const StreamUse& stream : result.streams) {
        counts["streams"][stream.name] = {{"bytes", stream.bytes_read + stream.bytes_written},
                                          {"requests", stream.requests}};
    }
    if (result.dram_activity) {
        counts["dram_commands"] = result.dram_activity->all.commands;
    }
    return counts;
}

/// Simulates the frame in a child, because SystemC elaborates once per process.
inline Counts counted_run(const sim::RunConfig& config, const FrameWorkload& frame,
                          const BuildOptions& build = {}) {
    sim::RunRequest request;
    request.config = config;
    request.build = build;
    request.reference = false;
    Counts counts;
    const auto work = [&] {
        return counts_of(sim::run_frames(request, source_of({&frame})).accelerator).dump();
    };
    sim::run_children({{"counted run", work}}, 1,
                      {[&](std::size_t, sim::ChildOutcome&& outcome) {
                           EXPECT_FALSE(outcome.failure) << outcome.failure->sentence;
                           counts = Counts::parse(outcome.output, nullptr, false);
                       },
                       {}});
    return counts;
}

inline FrameWorkload frame_for(const sim::RunConfig& config, const GaussianCloud& cloud,
                               const Camera& camera) {
    ProjectionOptions options;
    options.numbers = config.accelerator().data_path().projection;
    return make_frame_workload(cloud, camera, config.accelerator().tile_size_px(),
                               config.accelerator().tile_mode(), options);
}

/// At the origin, looking along z.
inline Camera plain_camera(int width, int height) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = width;
    return camera;
}

/// Adds a round Gaussian whose coefficients are all `colour`.
inline void add_ball(GaussianCloud& cloud, const glm::dvec3& mean, float size, float opacity = 0.5F,
                     float colour = 0.3F) {
    cloud.means.push_back(mean);
    cloud.scales.emplace_back(size);
    cloud.rotations.emplace_back(1, 0, 0, 0);
    cloud.opacities.push_back(opacity);
    cloud.sh.insert(cloud.sh.end(), std::size_t{3} * cloud.sh_coefficients(), colour);
}

} // namespace degs::sim_test
