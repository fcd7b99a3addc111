// SPDX-License-Identifier: Apache-2.0
#include "sim/statistics_list.hpp"

#include "sim/report.hpp"

namespace degs::sim {

std::vector<Statistic> statistics_of(const RunConfig& config) {
    Progress::silence();
    const AcceleratorConfig& accelerator = config.accelerator();
    Camera camera;
    camera.width = camera.height = accelerator.tile_size_px();
    camera.fx = camera.fy = camera.width;
    double seconds = 0;
    const std::vector<FrameWorkload> frames =
        make_workloads(GaussianCloud{}, {camera}, accelerator, seconds);
    RunRequest request;
    request.config = config;
    const RunResult result = run_frames(request, {&frames.front()});
    return shared_once(
        document_statistics([&result](StatsVisitor& visitor) { describe(result, visitor); }));
}

} // namespace degs::sim
