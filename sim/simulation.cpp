// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.hpp"

#include <sys/resource.h>

#include "sim/stopwatch.hpp"

namespace degs::sim {
namespace {

std::vector<FrameWorkload> make_workloads(View& view, const RunRequest& request,
                                          RunResult& result) {
    const AcceleratorConfig& config = request.config.accelerator();
    const Progress progress("projecting and sorting");
    const Stopwatch clock;
    std::vector<Camera> cameras{view.camera};
    cameras.insert(cameras.end(), request.following.begin(), request.following.end());
    std::vector<FrameWorkload> workloads;
    for (const Camera& camera : cameras) {
        workloads.push_back(make_frame_workload(view.scene.cloud, camera, config.tile_size_px(),
                                                config.tile_mode()));
    }
    view.scene.cloud = GaussianCloud{}; // everything that follows needs the splats only
    result.host.workload_s = clock.seconds();
    result.workload = facts_of(workloads.front());
    return workloads;
}

void compare_with_reference(const FrameWorkload& workload, RunResult& result) {
    const Progress progress("reference image");
    const Stopwatch clock;
    ReferenceCounts counts;
    const Image reference = render_reference(workload, counts);
    result.host.render_s = clock.seconds();
    result.workload.reference = counts;
    result.error = compare_images(reference, result.accelerator.images.front());
}

} // namespace

SceneFacts facts_of(const Scene& scene) {
    return {scene.name, scene.source, scene.cloud.size(), scene.cloud.sh_degree, scene.dropped};
}

WorkloadFacts facts_of(const FrameWorkload& workload) {
    WorkloadFacts facts;
    facts.gaussians = workload.gaussians;
    facts.visible = workload.splats.size();
    facts.tile_pairs = workload.tile_pairs();
    facts.culled = workload.culled;
    facts.tile_size = workload.tile_size;
    facts.tiles = static_cast<std::uint64_t>(workload.tiles());
    for (std::size_t t = 0; t < facts.tiles; ++t) {
        facts.empty_tiles += workload.tile_begin[t] == workload.tile_begin[t + 1] ? 1 : 0;
    }
    return facts;
}

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024; // Linux counts in KiB
}

RunResult simulate(const RunRequest& request, View view) {
    const Stopwatch wall;
    RunResult result;
    result.config = request.config;
    result.scene = facts_of(view.scene);
    result.camera = view.camera;
    result.host.load_s = view.load_s;
    const std::vector<FrameWorkload> workloads = make_workloads(view, request, result);
    std::vector<const FrameWorkload*> frames;
    for (const FrameWorkload& workload : workloads) {
        frames.push_back(&workload);
    }
    {
        Progress progress("simulation");
        result.accelerator = run_accelerator(request.config.accelerator(), frames, request.fidelity,
                                             request.build, progress);
    }
    if (request.reference) {
        compare_with_reference(workloads.front(), result);
    }
    result.host.fidelity = request.fidelity == Fidelity::Strict ? "strict" : "exact";
    result.host.elaborate_s = result.accelerator.elaborate_s;
    result.host.sim_s = result.accelerator.sim_s;
    result.host.wall_s = view.load_s + wall.seconds();
    result.host.peak_rss_bytes = peak_rss_bytes();
    return result;
}

} // namespace degs::sim
