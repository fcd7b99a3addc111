// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/study_plan.hpp"

#include <algorithm>
#include <numeric>

#include "config/config_document.hpp"
#include "config/error.hpp"
#include "scene/scene.hpp"
#include "sim/cache/digest.hpp"
#include "sim/compare/run_summary.hpp"
#include "sim/report.hpp"
#include "sim/sweep/study_variants.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

std::vector<int> cameras_of(const std::string& scene, const CompareRequest& request) {
    const int count = static_cast<int>(camera_count(scene, request.camera_file));
    std::vector<int> cameras(count);
    std::iota(cameras.begin(), cameras.end(), 0);
    for (int camera : request.cameras.value_or(std::vector<int>{})) {
        if (camera >= count) {
            throw InputError("Camera " + std::to_string(camera) + " does not exist: scene '" +
                             scene + "' has " + std::to_string(count) +
                             " camera(s), numbered from 0.");
        }
    }
    return request.cameras.value_or(cameras);
}

void plan_views(const Study& study, StudyPlan& plan) {
    CompareRequest& request = plan.request;
    if (study.scenes.empty()) {
        throw InputError("The study names no scene; it needs 'scenes', or --scene.");
    }
    check_scenes(study.scenes);
    request.scenes = study.scenes;
    request.camera_file = study.camera_file;
    request.cameras = parse_cameras(study.cameras);
    if (study.resolutions.empty()) {
        request.sizes = {ImageSize{study.width, {}}};
    } else {
        request.sizes = parse_resolutions(study.resolutions);
    }
    request.path = study.path;
    request.array_only = study.array_only;
    request.reference = study.reference;
    request.sampling = study.sampling;
    for (std::size_t scene = 0; scene < request.scenes.size(); ++scene) {
        for (int camera : cameras_of(request.scenes[scene], request)) {
            for (std::size_t size = 0; size < request.sizes.size(); ++size) {
                for (std::size_t v = 0; v < plan.variants.size(); ++v) {
                    plan.points.push_back({v, scene, size, camera});
                }
            }
        }
    }
    if (plan.points.size() > kMostPoints) {
        throw InputError("The study has " + grouped(plan.points.size()) + " points; at most " +
                         grouped(kMostPoints) + " are allowed.");
    }
}

std::string digest_of(const StudyPlan& plan) {
    const CompareRequest& request = plan.request;
    Digest digest;
    digest.add(tool_json().dump() + std::to_string(kSummaryVersion));
    digest.add(plan.name + "\n" + plan.variants[plan.baseline].name);
    for (std::size_t v = 0; v < plan.variants.size(); ++v) {
        digest.add(plan.variants[v].name);
        digest.add(resolved(request.configs[v].config).dump());
    }
    for (const SkippedVariant& skipped : plan.skipped) {
        digest.add(skipped.variant.name);
    }
    for (const std::string& scene : request.scenes) {
        digest.add_scene(scene);
    }
    digest.add_file(request.camera_file);
    for (const ImageSize& size : request.sizes) {
        digest.add(std::to_string(size.width.value_or(0)) + "x" +
                   std::to_string(size.height.value_or(0)));
    }
    digest.add(std::to_string(request.path.frames) + " " + as_typed(request.path.step_degrees));
    digest.add(std::to_string(request.array_only) + std::to_string(request.reference));
    if (const std::optional<SamplingRequest>& sampling = request.sampling) {
        digest.add("within " + as_typed(sampling->within) + " " + sampling->measure + " " +
                   std::to_string(sampling->seed));
    }
    for (const StudyPoint& point : plan.points) {
        digest.add(std::to_string(point.camera));
    }
    return digest.text();
}

} // namespace

StudyPlan plan_study(const Study& study) {
    StudyPlan plan;
    plan.name = study.name;
    plan_variants(study, plan);
    plan_views(study, plan);
    plan.digest = digest_of(plan);
    return plan;
}

StudyPlan part_of(const StudyPlan& plan, const std::vector<std::size_t>& variants, int divisor) {
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
    for (ImageSize& size : part.request.sizes) {
        if (divisor != 1 && !size.width && !size.height) {
            throw InputError("The study needs 'width' or 'resolutions', because a search begins "
                             "with smaller images.");
        }
        for (std::optional<int>* side : {&size.width, &size.height}) {
            if (*side) {
                *side = std::max(1, **side / divisor);
            }
        }
    }
    const std::size_t all = plan.variants.size();
    for (std::size_t p = 0; p < plan.points.size(); p += all) { // the views
        for (std::size_t v = 0; v < part.variants.size(); ++v) {
            StudyPoint point = plan.points[p];
            point.variant = v;
            part.points.push_back(point);
        }
    }
    part.digest = digest_of(part);
    return part;
}

} // namespace degs::sim
