// SPDX-License-Identifier: Apache-2.0
// One run: workload -> accelerator -> results, and the reference to compare with.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/dynamic_scene.hpp"
#include "sim/accelerator/accelerator_run.hpp"
#include "sim/sampling/sampled_run.hpp"
#include "sim/simulation/foveated_image.hpp"
#include "sim/simulation/frame_changes.hpp"
#include "sim/simulation/run_config.hpp"
#include "sim/simulation/view.hpp"
#include "sim/simulation/what_if.hpp"
#include "splat/images/image_metrics.hpp"
#include "splat/reference/reference_renderer.hpp"

namespace degs::sim {

struct RunRequest {
    RunConfig config;
    Fidelity fidelity = Fidelity::Exact;
    BuildOptions build;
    bool reference = true; ///< render the double-precision image and compare
    int views = 1;         ///< of a frame; they follow each other
    Recording recording;
    std::optional<SamplingRequest> sampling; ///< simulate a sample of the tiles, if it will do
};

/// The facts of a scene that stay when its Gaussians have become a workload.
struct SceneFacts {
    std::string name, source;
    std::uint64_t gaussians = 0;
    int sh_degree = 0;
    SanitizeReport dropped;         ///< Gaussians of the file that cannot be drawn
    SceneTraits traits;             ///< how the file wants to be drawn
    std::vector<std::string> notes; ///< sentences: what was guessed or passed over in the file
    std::string workload_xxh128;    ///< checksum of the workload file that the source is, if any
};

struct WorkloadFacts {
    std::uint64_t gaussians = 0, visible = 0, tile_pairs = 0;
    CullCounts culled;
    ProjectionOptions projection; ///< of the accelerator's splats
    int tile_size = 0;
    std::uint64_t tiles = 0, empty_tiles = 0, pixels = 0; ///< without hidden tiles
    std::optional<ReferenceCounts> reference;
};

/// Seconds and bytes of the machine that simulates; the only part of a result that may differ
/// between two runs.
struct HostFacts {
    std::string fidelity;
    double load_s = 0, workload_s = 0, elaborate_s = 0, start_s = 0, sim_s = 0, functional_s = 0,
           run_s = 0, wall_s = 0;
    std::optional<double> render_s;
    std::uint64_t activations = 0; ///< see Timebase
    std::uint64_t peak_rss_bytes = 0;
};

/// One of several views of the first frame.
struct ViewFacts {
    Camera camera;
    WorkloadFacts workload;
    std::optional<ImageError> error; ///< against its reference
};

struct RunResult {
    SceneFacts scene;
    Camera camera; ///< of the first view of the first frame
    RunConfig config;
    WorkloadFacts workload; ///< of that view
    AcceleratorResult accelerator;
    std::vector<std::string> movable_keys;   ///< see LossKeys::movable; asked before the simulation
    std::vector<std::string> warnings;       ///< sentences; see warnings.hpp
    std::optional<ImageError> error;         ///< of that view against the reference
    std::vector<ViewFacts> views;            ///< of the first frame, if it has several
    std::optional<FoveationFacts> foveation; ///< then `camera` and `error` are of its first image
    std::optional<FrameChanges> changes;     ///< of a run of several frames
    std::optional<SamplingFacts> sampling;   ///< if the numbers are estimates from a sample
    std::vector<WhatIf> what_if;             ///< changes that were asked for (--what-if)
    HostFacts host;
};

/// The double-precision image of a frame, with which any number of runs can be compared.
struct Reference {
    Image image;
    ReferenceCounts counts;
    double render_s = 0; ///< host, what one processor needs
};

SceneFacts facts_of(const Scene& scene);
/// Completes the result of a run with its scene, whose notes become the first warnings.
void put_scene(const SceneFacts& scene, RunResult& result);
WorkloadFacts facts_of(const FrameWorkload& workload);
/// Largest resident set of this process so far.
std::uint64_t peak_rss_bytes();

/// The frames of `cameras` with the tiles of the accelerator, projected in its numbers and by its
/// rules; adds the host seconds to `seconds`.
std::vector<FrameWorkload> make_workloads(const GaussianCloud& cloud, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds);
/// InputError for more frames than the scene has.
void require_frames(const DynamicScene& scene, int frames);
/// The frames of a scene that changes, made like those of a cloud: frame k, seen by the `views`
/// cameras from k x views on. InputError for more frames than the scene has.
std::vector<FrameWorkload> make_workloads(const DynamicScene& scene, const SceneTraits& traits,
                                          const std::vector<Camera>& cameras,
                                          const AcceleratorConfig& config, double& seconds,
                                          int views = 1);
/// Gives `count` frames of a cloud, from `first` on, the colours that they have from the middle of
/// their cameras.
void share_colours(const GaussianCloud& cloud, std::vector<FrameWorkload>& frames,
                   std::size_t first, std::size_t count);
Reference make_reference(const FrameWorkload& workload);
/// The reference of a frame in any format: what was not projected in double is projected again, and
/// the host seconds of that are added to `seconds`.
Reference make_reference(const GaussianCloud& cloud, const FrameWorkload& frame, double& seconds);
/// Fills in the reference of the first image, and its error against it, which `compare` finds.
void judge(RunResult& result, const Reference& reference,
           const std::function<ImageError(const Image& reference, const Image& test)>& compare =
               compare_images);

/// Fills in the reference of a view of the first frame, and the error of its image likewise.
void judge_view(RunResult& result, std::size_t view, const Reference& reference,
                const std::function<ImageError(const Image& reference, const Image& test)>&
                    compare = compare_images);

/// The first view of every frame.
std::vector<const FrameWorkload*> first_views(const std::vector<const FrameWorkload*>& frames,
                                              std::size_t views);

/// Images of the first frame, and one of them: a view's, or composed from the levels of one.
std::size_t images_of(const RunResult& result);
const Image& image_of(const RunResult& result, std::size_t image);
const std::optional<ImageError>& error_of(const RunResult& result, std::size_t image);

/// Runs the accelerator on frames that are made for it (at least one, of as many views as the
/// request says), each when it is needed. The caller fills in the facts of the scene, the host
/// times of earlier steps and the comparison. Throws std::logic_error if the model violates an
/// invariant. May be called once per process. If a sample is asked for that does not reach the
/// interval, the run is exact, with a warning; another process may go on with it then. InputError
/// for a sample of several frames.
RunResult run_frames(const RunRequest& request, FrameSource frames);

} // namespace degs::sim
