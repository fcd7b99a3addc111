// SPDX-License-Identifier: Apache-2.0
// The paper's test of single Gaussians on made-up and on projected ones.
#include <functional>
#include <random>

#include "accuracy/single_gaussian.hpp"
#include "base/ratio.hpp"
#include "degs/error.hpp"
#include "sim/accuracy/accuracy.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/frame_warnings.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"
#include "splat/frame/frame_workload.hpp"

namespace degs::sim {
namespace {

/// A Gaussian and the window it is looked at through.
struct Sample {
    ProjectedSplat splat;
    WindowCorner corner;
};
using Sampler = std::function<Sample(std::mt19937_64&)>;

/// One column of results: a number set, or fp16-direct without one.
struct Candidate {
    std::string name;
    const QuantizedRow* path = nullptr;
    AlphaError error, to_fp16;
};

AccuracyRow row_of(const AccuracyRow& kind, const Candidate& candidate) {
    AccuracyRow row = kind;
    row.numbers = candidate.name;
    row.alpha_error_mean = candidate.error.mean();
    row.alpha_error_max = candidate.error.max;
    row.nonfinite = candidate.error.nonfinite;
    row.spread = candidate.error.spread();
    if (candidate.path != nullptr) {
        row.mean_to_fp16 = candidate.to_fp16.mean();
    }
    row.gaussians = candidate.error.gaussians;
    row.support = candidate.error.support;
    row.flips = candidate.error.flips;
    return row;
}

void measure_kind(const SingleGaussianRequest& request, const std::vector<QuantizedRow>& paths,
                  const AccuracyRow& kind, const Sampler& sampler, std::vector<AccuracyRow>& rows) {
    Progress progress("single Gaussians");
    const NumberFormat fp64 = parse_format("fp64");
    const NumberFormat fp16 = parse_format("fp16");
    std::vector<Candidate> candidates{{"fp16-direct", nullptr, {}, {}}};
    for (const QuantizedRow& path : paths) {
        candidates.push_back({path.set().name, &path, {}, {}});
    }
    std::mt19937_64 random(request.seed);
    for (int i = 0; i < request.gaussians; ++i) {
        const Sample sample = sampler(random);
        const AlphaMap truth = direct_alpha(sample.splat, sample.corner, fp64);
        const AlphaMap half = direct_alpha(sample.splat, sample.corner, fp16);
        candidates.front().error.add(truth, half);
        for (std::size_t k = 1; k < candidates.size(); ++k) {
            const AlphaMap map = row_alpha(sample.splat, sample.corner, *candidates[k].path);
            candidates[k].error.add(truth, map);
            candidates[k].to_fp16.add(half, map);
        }
        progress.done(ratio_of(i, request.gaussians));
    }
    for (const Candidate& candidate : candidates) {
        rows.push_back(row_of(kind, candidate));
    }
}

/// Splats that a camera sees, each through the tile that has its mean. `kind` says which camera.
void measure_splats(const SingleGaussianRequest& request, const std::vector<QuantizedRow>& paths,
                    const Scene& scene, const Camera& camera, AccuracyRow kind,
                    std::vector<AccuracyRow>& rows) {
    const ProjectionOptions options = request.rules.options(false);
    const FrameWorkload workload =
        make_frame_workload(scene.cloud, camera, kAlphaWindow, TileMode::Exact, options);
    print_warnings(near_plane_warnings(workload));
    const std::vector<ProjectedSplat>& splats = workload.splats;
    if (splats.empty()) {
        throw InputError("Camera " + std::to_string(kind.camera.value_or(0)) + " of the scene '" +
                         scene.source + "' sees no Gaussian.");
    }
    kind.resolution = std::to_string(camera.width) + "x" + std::to_string(camera.height);
    const auto sampler = [&](std::mt19937_64& random) {
        const ProjectedSplat& splat = splats[random() % splats.size()];
        return Sample{splat, window_of(splat, camera.window())};
    };
    measure_kind(request, paths, kind, sampler, rows);
}

void measure_view_splats(const SingleGaussianRequest& request,
                         const std::vector<QuantizedRow>& paths, const ViewRequest& view,
                         const std::string& label, std::vector<AccuracyRow>& rows) {
    const View loaded = load_view(view);
    const std::vector<Camera> cameras = cameras_of_frame(view, request.group, loaded.scene);
    for (std::size_t number = 0; number < cameras.size(); ++number) {
        AccuracyRow kind;
        kind.scene = label;
        name_view(view, request.group, number, kind);
        measure_splats(request, paths, loaded.scene, cameras[number], kind, rows);
    }
}

} // namespace

std::vector<AccuracyRow> measure_single_gaussians(const SingleGaussianRequest& request) {
    std::vector<QuantizedRow> paths;
    paths.reserve(request.sets.size());
    for (const NumberSet& set : request.sets) {
        paths.emplace_back(set);
    }
    std::vector<AccuracyRow> rows;
    AccuracyRow kind;
    kind.resolution = std::to_string(kAlphaWindow) + "x" + std::to_string(kAlphaWindow);
    kind.scene = "isotropic-3";
    measure_kind(
        request, paths, kind,
        [](std::mt19937_64& random) {
            return Sample{isotropic_splat(random), {}};
        },
        rows);
    kind.scene = "random";
    measure_kind(
        request, paths, kind,
        [](std::mt19937_64& random) {
            return Sample{random_window_splat(random), {}};
        },
        rows);
    const std::vector<std::string> labels = scene_labels(request.views);
    for (std::size_t v = 0; v < labels.size(); ++v) {
        measure_view_splats(request, paths, request.views[v], labels[v], rows);
    }
    return rows;
}

} // namespace degs::sim
