// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/simulation.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <sys/resource.h>

#include "degs/error.hpp"
#include "scene/cameras/eyes.hpp"
#include "sim/process/reserve.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/simulation/loss_keys.hpp"
#include "sim/simulation/warnings.hpp"
#include "splat/frame/shared_colours.hpp"

namespace degs::sim {

SceneFacts facts_of(const Scene& scene) {
    return {scene.name,    scene.source, scene.cloud.size(), scene.cloud.sh_degree,
            scene.dropped, scene.traits, scene.notes,        ""};
}

void put_scene(const SceneFacts& scene, RunResult& result) {
    result.scene = scene;
    result.warnings.insert(result.warnings.begin(), scene.notes.begin(), scene.notes.end());
}

WorkloadFacts facts_of(const FrameWorkload& workload) {
    WorkloadFacts facts;
    facts.gaussians = workload.gaussians;
    facts.visible = workload.splats.size();
    facts.tile_pairs = workload.tile_pairs();
    facts.culled = workload.culled;
    facts.projection = workload.projection;
    facts.tile_size = workload.tile_size;
    const TileGrid grid = workload.grid();
    facts.tiles = grid.shown_tiles();
    facts.pixels = grid.shown_pixels();
    for (int t = 0; t < workload.tiles(); ++t) {
        const bool lists = workload.tile_begin[t] != workload.tile_begin[t + 1];
        facts.empty_tiles += lists || grid.is_hidden(t) ? 0 : 1;
    }
    return facts;
}

std::uint64_t peak_rss_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return std::uint64_t{1024} * usage.ru_maxrss; // Linux counts in KiB
}

std::vector<FrameWorkload> make_workloads(const GaussianCloud& cloud, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds) {
    const Progress progress("projecting and sorting");
    const Stopwatch clock;
    std::vector<FrameWorkload> workloads;
    workloads.reserve(cameras.size());
    const ProjectionOptions options = projection_of(config.data_path(), traits.antialiased);
    for (const Camera& camera : cameras) {
        workloads.push_back(
            make_frame_workload(cloud, camera, config.tile_size_px(), config.tile_mode(), options));
    }
    seconds += clock.seconds();
    return workloads;
}

void require_frames(const DynamicScene& scene, int frames) {
    if (frames > scene.frames()) {
        throw InputError("The scene has " + std::to_string(scene.frames()) + " frames, and " +
                         std::to_string(frames) + " were asked for (--frames).");
    }
}

std::vector<FrameWorkload> make_workloads(const DynamicScene& scene, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds,
                                          int views) {
    const int frames = static_cast<int>(cameras.size()) / views;
    require_frames(scene, frames);
    std::vector<FrameWorkload> workloads;
    for (int k = 0; k < frames; ++k) {
        const GaussianCloud cloud = scene.frame(k);
        const auto first = cameras.begin() + k * views;
        for (FrameWorkload& view :
             make_workloads(cloud, traits, {first, first + views}, config, seconds)) {
            workloads.push_back(std::move(view));
        }
    }
    return workloads;
}

void share_colours(const GaussianCloud& cloud, std::vector<FrameWorkload>& frames,
                   std::size_t first, std::size_t count) {
    std::vector<Camera> cameras;
    for (std::size_t f = first; f < first + count; ++f) {
        cameras.push_back(frames[f].camera);
    }
    for (std::size_t f = first; f < first + count; ++f) {
        shade_from(cloud, middle_of(cameras), frames[f]);
    }
}

Reference make_reference(const FrameWorkload& workload) {
    const Progress progress("reference image");
    const CpuStopwatch clock;
    Reference reference;
    reference.image = render_reference(workload, reference.counts);
    reference.render_s = clock.seconds();
    return reference;
}

Reference make_reference(const GaussianCloud& cloud, const FrameWorkload& frame, double& seconds) {
    if (frame.projection.numbers.is_reference()) {
        return make_reference(frame);
    }
    const Stopwatch clock;
    ProjectionOptions options = frame.projection;
    options.numbers = ProjectionNumbers();
    const FrameWorkload exact =
        make_frame_workload(cloud, frame.camera, frame.tile_size, frame.tile_mode, options);
    seconds += clock.seconds();
    return make_reference(exact);
}

void judge(RunResult& result, const Reference& reference,
           const std::function<ImageError(const Image&, const Image&)>& compare) {
    result.host.render_s = reference.render_s;
    result.workload.reference = reference.counts;
    result.error = compare(reference.image, result.accelerator.images.front());
}

void judge_view(RunResult& result, std::size_t view, const Reference& reference,
                const std::function<ImageError(const Image&, const Image&)>& compare) {
    result.views[view].workload.reference = reference.counts;
    result.views[view].error = compare(reference.image, result.accelerator.images[view]);
}

std::vector<const FrameWorkload*> first_views(const std::vector<const FrameWorkload*>& frames,
                                              std::size_t views) {
    std::vector<const FrameWorkload*> first;
    for (std::size_t f = 0; f < frames.size(); f += views) {
        first.push_back(frames[f]);
    }
    return first;
}

std::size_t images_of(const RunResult& result) {
    return result.foveation ? result.foveation->images.size()
                            : std::max<std::size_t>(1, result.views.size());
}

const Image& image_of(const RunResult& result, std::size_t image) {
    return result.foveation ? result.foveation->images[image].image
                            : result.accelerator.images[image];
}

const std::optional<ImageError>& error_of(const RunResult& result, std::size_t image) {
    return result.foveation       ? result.foveation->images[image].error
           : result.views.empty() ? result.error
                                  : result.views[image].error;
}

namespace {

/// The sample that the request asks for, or the reason why there is none. A sample that turns out
/// to be too small costs the process its simulation, so that a reserve goes on.
std::optional<SampledResult> try_sample(const RunRequest& request, const FrameWorkload& frame,
                                        std::string& refusal, double& lost_s) {
    Reserve reserve;
    refusal = reserve.called_for();
    lost_s = reserve.replaced_s();
    if (!refusal.empty()) {
        return {};
    }
    std::optional<SampledResult> sampled;
    {
        Progress progress("simulation of a sample");
        sampled = run_sampled(request.config.accelerator(), frame, request.fidelity, request.build,
                              *request.sampling, progress);
    }
    if (sampled->facts.refusal.empty()) {
        return sampled;
    }
    refusal = sampled->facts.refusal;
    if (sampled->facts.groups == 0) { // nothing has been simulated yet
        return {};
    }
    if (!reserve.available()) {
        throw std::runtime_error("No process could be started for the exact run. " + refusal);
    }
    reserve.call(refusal);
}

const char* name_of(Fidelity fidelity) {
    return fidelity == Fidelity::Strict ? "strict" : "exact";
}

void append(std::vector<std::string>& to, const std::vector<std::string>& sentences) {
    to.insert(to.end(), sentences.begin(), sentences.end());
}

/// The frames of a run on their way to the accelerator. Those of the first frame are there before
/// the others are taken.
class TakenFrames {
public:
    TakenFrames(FrameSource frames, std::size_t views)
        : all_(frames.frames), views_(views), frames_(std::move(frames)), changes_(all_ / views) {
        while (first_.size() < views) {
            first_.push_back(take_next());
        }
    }

    const std::vector<FramePointer>& first() const { return first_; }
    bool several() const { return all_ > views_; }
    /// All frames, from the first on.
    FrameSource source() {
        return {all_, [this] { return take(); }};
    }
    /// Is asked when all have been taken.
    FrameChanges changes() const { return changes_.changes(); }
    const WorstNearPlane& near_plane() const { return near_plane_; }
    /// Host time of all threads in which they were made.
    double made_s() const { return made_s_; }

private:
    FramePointer take() {
        FramePointer frame = given_ < views_ ? std::move(first_[given_]) : take_next();
        ++given_;
        return frame;
    }
    FramePointer take_next() {
        const CpuStopwatch clock;
        FramePointer frame = frames_.take();
        made_s_ += clock.seconds();
        if (frame != nullptr) {
            near_plane_.add(*frame);
            if (several() && taken_++ % views_ == 0) {
                changes_.add(frame);
            }
        }
        return frame;
    }

    std::size_t all_, views_, taken_ = 0, given_ = 0;
    FrameSource frames_;
    double made_s_ = 0;
    std::vector<FramePointer> first_; ///< until they are given
    FrameChangesSum changes_;         ///< of the first view of each frame
    WorstNearPlane near_plane_;
};

/// What is known of the first frame, its views and the design before the run.
void put_first_frame(const RunRequest& request, const std::vector<FramePointer>& views,
                     RunResult& result) {
    const FrameWorkload& first = *views.front();
    result.config = request.config;
    // Designs that are refused throw, behind a simulation from a stack that sanitizers do not know.
    result.movable_keys = LossKeys(result).movable();
    result.camera = first.camera;
    result.workload = facts_of(first);
    result.warnings = request.config.warnings;
    for (std::size_t v = 0; views.size() > 1 && v < views.size(); ++v) {
        result.views.push_back({views[v]->camera, facts_of(*views[v]), {}});
    }
    append(result.warnings, saturation_warnings(request.config.accelerator().data_path(), first));
    append(result.warnings, lens_warnings(first.camera, first.projection));
}

void put_host(const RunRequest& request, RunResult& result, double run_s) {
    result.host.fidelity = result.sampling ? "sampled" : name_of(request.fidelity);
    result.host.elaborate_s = result.accelerator.elaborate_s;
    result.host.sim_s = result.accelerator.sim_s;
    result.host.functional_s = result.accelerator.functional_s;
    result.host.activations = result.accelerator.activations;
    result.host.run_s = run_s;
    result.host.peak_rss_bytes = peak_rss_bytes();
}

} // namespace

RunResult run_frames(const RunRequest& request, FrameSource frames) {
    const CpuStopwatch clock;
    RunResult result;
    TakenFrames taken(std::move(frames), request.views);
    put_first_frame(request, taken.first(), result);
    std::string refusal;
    double lost_s = 0;
    std::optional<SampledResult> sampled;
    if (request.sampling) {
        if (taken.several()) {
            throw std::logic_error("a sample of tiles is of one frame, and the run has several");
        }
        sampled = try_sample(request, *taken.first().front(), refusal, lost_s);
    }
    std::vector<std::string> later; // warnings of the run
    if (sampled) {
        result.accelerator = std::move(sampled->result);
        result.sampling = std::move(sampled->facts);
    } else {
        Progress progress("simulation");
        result.accelerator =
            run_accelerator(request.config.accelerator(), taken.source(), request.fidelity,
                            request.build, request.recording, progress, request.views);
        if (!result.accelerator.images.empty()) {
            later = saturation_warnings(request.config.accelerator().data_path(),
                                        result.accelerator.images.front());
        }
    }
    if (taken.several()) {
        result.changes = taken.changes();
    }
    append(result.warnings, taken.near_plane().sentences());
    if (!refusal.empty()) {
        result.warnings.push_back(refusal);
    }
    append(result.warnings, later);
    append(result.warnings, hazard_warnings(result.accelerator));
    put_host(request, result, lost_s + clock.seconds() - taken.made_s());
    return result;
}

} // namespace degs::sim
