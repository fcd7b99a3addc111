// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation.hpp"

#include <sys/resource.h>

#include "sim/stopwatch.hpp"
#include "sim/warnings.hpp"

namespace degs::sim {
SceneFacts facts_of(const Scene& scene) {
    return {scene.name, scene.source, scene.cloud.size(), scene.cloud.sh_degree, scene.dropped};
}

WorkloadFacts facts_of(const FrameWorkload& workload) {
    WorkloadFacts facts;
    facts.gaussians = workload.gaussians;
    facts.visible = workload.splats.size();
    facts.tile_pairs = workload.tile_pairs();
    facts.culled = workload.culled;
    facts.projection = workload.projection.format.name();
    facts.tile_size = workload.tile_size;
    facts.tiles = workload.tiles();
    for (std::size_t t = 0; t < facts.tiles; ++t) {
        facts.empty_tiles += workload.tile_begin[t] == workload.tile_begin[t + 1] ? 1 : 0;
    }
    return facts;
}

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t{1024} * usage.ru_maxrss; // Linux counts in KiB
}

std::vector<FrameWorkload> make_workloads(const GaussianCloud& cloud,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds) {
    const Progress progress("projecting and sorting");
    const Stopwatch clock;
    std::vector<FrameWorkload> workloads;
    workloads.reserve(cameras.size());
    ProjectionOptions options;
    options.format = config.data_path().projection;
    for (const Camera& camera : cameras) {
        workloads.push_back(
            make_frame_workload(cloud, camera, config.tile_size_px(), config.tile_mode(), options));
    }
    seconds += clock.seconds();
    return workloads;
}

Reference make_reference(const FrameWorkload& workload) {
    const Progress progress("reference image");
    const Stopwatch clock;
    Reference reference;
    reference.image = render_reference(workload, reference.counts);
    reference.render_s = clock.seconds();
    return reference;
}

Reference make_reference(const GaussianCloud& cloud, const FrameWorkload& frame, double& seconds) {
    if (frame.projection.format.is_fp64()) {
        return make_reference(frame);
    }
    const Stopwatch clock;
    ProjectionOptions options = frame.projection;
    options.format = NumberFormat();
    const FrameWorkload exact =
        make_frame_workload(cloud, frame.camera, frame.tile_size, frame.tile_mode, options);
    seconds += clock.seconds();
    return make_reference(exact);
}

void judge(RunResult& result, const Reference& reference) {
    result.host.render_s = reference.render_s;
    result.workload.reference = reference.counts;
    result.error = compare_images(reference.image, result.accelerator.images.front());
}

RunResult run_frames(const RunRequest& request, const std::vector<const FrameWorkload*>& frames) {
    RunResult result;
    result.config = request.config;
    result.camera = frames.front()->camera;
    result.workload = facts_of(*frames.front());
    result.warnings = request.config.warnings;
    for (std::string& sentence :
         saturation_warnings(request.config.accelerator().data_path(), *frames.front())) {
        result.warnings.push_back(std::move(sentence));
    }
    Progress progress("simulation");
    result.accelerator = run_accelerator(request.config.accelerator(), frames, request.fidelity,
                                         request.build, request.recording, progress);
    for (std::string& sentence : hazard_warnings(result.accelerator)) {
        result.warnings.push_back(std::move(sentence));
    }
    result.host.fidelity = request.fidelity == Fidelity::Strict ? "strict" : "exact";
    result.host.elaborate_s = result.accelerator.elaborate_s;
    result.host.sim_s = result.accelerator.sim_s;
    result.host.peak_rss_bytes = peak_rss_bytes();
    return result;
}

RunResult simulate(const RunRequest& request, View view) {
    const Stopwatch wall;
    std::vector<Camera> cameras{view.camera};
    cameras.insert(cameras.end(), request.following.begin(), request.following.end());
    double workload_s = 0;
    const std::vector<FrameWorkload> workloads =
        make_workloads(view.scene.cloud, cameras, request.config.accelerator(), workload_s);
    const SceneFacts scene = facts_of(view.scene);
    std::optional<Reference> reference; // now if it needs the Gaussians, else after the run
    if (request.reference && !workloads.front().projection.format.is_fp64()) {
        reference = make_reference(view.scene.cloud, workloads.front(), workload_s);
    }
    view.scene.cloud = GaussianCloud{}; // everything that follows needs the splats only
    std::vector<const FrameWorkload*> frames;
    frames.reserve(workloads.size());
    for (const FrameWorkload& workload : workloads) {
        frames.push_back(&workload);
    }
    RunResult result = run_frames(request, frames);
    result.scene = scene;
    if (request.reference) {
        judge(result, reference ? *reference : make_reference(workloads.front()));
    }
    result.host.load_s = view.load_s;
    result.host.workload_s = workload_s;
    result.host.wall_s = view.load_s + wall.seconds();
    result.host.peak_rss_bytes = peak_rss_bytes();
    return result;
}

} // namespace degs::sim
