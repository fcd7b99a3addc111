// SPDX-License-Identifier: Apache-2.0
#include "sim/config/statistics_list.hpp"

#include "sim/memory/memory_report.hpp"
#include "sim/report/measures.hpp"
#include "sim/report/report.hpp"
#include "sim/results/run_summary.hpp"

namespace degs::sim {
namespace {

std::vector<Statistic> report_statistics(const RunConfig& config) {
    Progress::silence();
    const AcceleratorConfig& accelerator = config.accelerator();
    Camera camera;
    camera.width = camera.height = accelerator.tile_size_px();
    camera.fx = camera.fy = camera.width;
    double seconds = 0;
    const std::vector<FrameWorkload> frames =
        make_workloads(GaussianCloud{}, SceneTraits{}, {camera}, accelerator, seconds);
    RunRequest request;
    request.config = config;
    const RunResult result = run_frames(request, source_of({&frames.front()}));
    return document_statistics([&result](StatsVisitor& visitor) { describe(result, visitor); });
}

} // namespace

std::vector<Statistic> statistics_of(const RunConfig& config) {
    return shared_once(report_statistics(config));
}

std::vector<Statistic> statistics_of_compare() {
    std::vector<Statistic> list = measure_statistics(report_statistics(RunConfig{}));
    for (Statistic& part : part_statistics()) {
        list.push_back(std::move(part));
    }
    return list;
}

std::vector<Statistic> statistics_of_memory() {
    const MemoryFacts facts;
    return shared_once(
        document_statistics([&facts](StatsVisitor& visitor) { describe(facts, visitor); }));
}

} // namespace degs::sim
