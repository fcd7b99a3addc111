// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/study_plan.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "config/config_document.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/cache/digest.hpp"
#include "sim/report/report.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/sweep/design_space.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// Nothing is listed before, because the points might not fit into memory.
void check_size(const Study& study, std::uint64_t views) {
    const std::uint64_t points = bounded_product(DesignSpace::size_of(study), views);
    if (points > kMostPoints) {
        const bool endless = points == std::numeric_limits<std::uint64_t>::max();
        throw InputError("The study has " + std::string(endless ? "more than " : "") +
                         grouped(points) + " points; at most " + grouped(kMostPoints) +
                         " are allowed.");
    }
}

/// Expands the designs and axes of the study into the variants of the plan, with a configuration
/// for each, those that cannot be built, and the baseline.
void plan_variants(const Study& study, StudyPlan& plan) {
    DesignSpace space(study, plan);
    const bool coincide = // points that are the same count once
        study.one_at_a_time || std::any_of(study.axes.begin(), study.axes.end(),
                                           [](const Axis& axis) { return axis.random; });
    for (const Genes& place : space.places()) {
        const DesignSpace::Added added = space.add(place);
        if (!added.is_new && !coincide) {
            throw InputError("The study has the point " + config_words::quote(added.name) +
                             " twice; a value of an axis is given twice.");
        }
    }
    if (plan.variants.empty()) {
        throw InputError("No point of the study can be built; the first one: " +
                         plan.skipped.front().why);
    }
    space.add_baseline();
}

/// The views of the request in the outer, the variants in the inner loop.
void plan_points(StudyPlan& plan) {
    for (const StudyView& view : plan.views) {
        for (std::size_t v = 0; v < plan.variants.size(); ++v) {
            plan.points.push_back({v, view.scene, view.size, view.camera});
        }
    }
}

std::vector<StudyView> views_of(const CompareRequest& request) {
    std::vector<StudyView> views;
    const std::vector<std::vector<int>> cameras = cameras_by_scene(request);
    for (std::size_t scene = 0; scene < cameras.size(); ++scene) {
        for (const int camera : cameras[scene]) {
            for (std::size_t size = 0; size < request.sizes.size(); ++size) {
                views.push_back({scene, size, camera});
            }
        }
    }
    return views;
}

std::vector<std::string> digests_of_scenes(const CompareRequest& request) {
    std::vector<std::string> digests;
    for (const std::string& scene : request.scenes) {
        Digest digest;
        digest.add_scene(scene);
        if (!request.camera_file.empty()) {
            digest.add_cameras(request.camera_file);
        }
        digest.add(request.camera_file);
        digests.push_back(digest.text());
    }
    return digests;
}

/// What all runs of a request have in common.
std::string run_options(const CompareRequest& request) {
    std::string text = std::to_string(request.path.frames);
    if (request.path.frames > 1) {
        text += " of " + decimal_text(request.path.step_degrees);
        const double near = nearest_plane(request.configs);
        text += near == ProjectionOptions().near_plane ? "" : " about near " + decimal_text(near);
    }
    const GroupRequest& group = request.path.group;
    if (group.eyes_m) {
        text += " eyes " + decimal_text(*group.eyes_m * group.units_per_metre);
    }
    text += group.cameras.empty() ? "" : " views " + positions_words(group.cameras);
    text += request.crop.empty() ? "" : " crop " + request.crop;
    text += request.analytic ? " analytic" : "";
    text += request.array_only ? " array_only" : "";
    text += request.reference && !request.sampling ? " reference" : "";
    if (const std::optional<SamplingRequest>& sampling = request.sampling) {
        text += " within " + decimal_text(sampling->within) + " " + sampling->measure + " " +
                std::to_string(sampling->seed);
    }
    return text;
}

/// Gives every point its key, and the plan its digest. A point has the same key in every study.
void identify(StudyPlan& plan) {
    const CompareRequest& request = plan.request;
    const std::string program = dump_json(tool_json()) + std::to_string(kSummaryVersion);
    const std::string options = run_options(request);
    std::vector<std::string> designs;
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
        designs.push_back(json_text(resolved(request.configs[v].config)));
    }
    Digest all;
    all.add(plan.name + "\n" + plan.variants[plan.baseline].name);
    for (StudyPoint& point : plan.points) {
        const ImageSize& size = request.sizes[point.size];
        Digest digest;
        digest.add(program);
        digest.add(designs[point.variant]);
        digest.add(plan.scene_digests[point.scene]);
        digest.add(std::to_string(point.camera) + " " + std::to_string(size.width.value_or(0)) +
                   "x" + std::to_string(size.height.value_or(0)));
        digest.add(options);
        point.key = digest.text();
        all.add(point.key + plan.variants[point.variant].name);
    }
    for (const SkippedVariant& skipped : plan.skipped) {
        all.add(skipped.variant.name);
    }
    plan.digest = all.text();
}

Aims aims_of(const Study& study) {
    Aims aims;
    if (!study.goals.text.empty()) {
        aims.goals = parse_goals(study.goals.text, study.goals.place);
    }
    if (!study.limits.text.empty()) {
        aims.limits = parse_limits(study.limits.text, study.limits.place);
    }
    return aims;
}

} // namespace

std::string text_without(const StudyPlan& plan, const StudyVariant& variant,
                         const std::set<std::size_t>& along) {
    std::string text = variant.design;
    for (std::size_t k = 0; k < plan.keys.size(); ++k) {
        if (along.count(k) == 0) {
            text += " " + plan.keys[k] + "=" + variant.values[k];
        }
    }
    return text;
}

StudyPlan plan_views(const Study& study) {
    StudyPlan plan;
    plan.name = study.name;
    put_views(study, plan.request);
    plan.request.sampling = study.sampling;
    check_combinations(plan.request);
    plan.views = views_of(plan.request);
    plan.aims = aims_of(study);
    plan.watch = std::make_shared<InputWatch>();
    plan.scene_digests = digests_of_scenes(plan.request);
    return plan;
}

StudyPlan plan_study(const Study& study) {
    StudyPlan plan = plan_views(study);
    check_size(study, plan.views.size());
    plan_variants(study, plan);
    check_estimates(plan.request);
    plan_points(plan);
    identify(plan);
    return plan;
}

StudyPlan part_of(const StudyPlan& plan, const std::vector<std::size_t>& variants, PartRuns runs) {
    StudyPlan part = plan;
    part.variants.clear();
    part.request.configs.clear();
    part.skipped.clear();
    part.points.clear();
    for (const std::size_t variant : variants) {
        if (variant == plan.baseline) {
            part.baseline = part.variants.size();
        }
        part.variants.push_back(plan.variants[variant]);
        part.request.configs.push_back(plan.request.configs[variant]);
    }
    if (runs == PartRuns::Estimates) {
        part.request.analytic = true;
        part.request.reference = false;
        part.request.sampling.reset();
        part.request.path = PathRequest();
    }
    plan_points(part);
    identify(part);
    return part;
}

} // namespace degs::sim
