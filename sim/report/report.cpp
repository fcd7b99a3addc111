// SPDX-License-Identifier: Apache-2.0
#include "sim/report/report.hpp"

#include <optional>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "base/ratio.hpp"
#include "config/config_document.hpp"
#include "scene/cameras/lens_terms.hpp"
#include "scene/files/image_io.hpp"
#include "sim/report/foveation_words.hpp"
#include "sim/report/losses.hpp"
#include "sim/report/view_words.hpp"
#include "sim/report/what_if_words.hpp"
#include "sim/sampling/regression.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

void describe_culled(const CullCounts& culled, StatsVisitor& v) {
    v.begin_section("culled", "The other Gaussians, by reason.");
    v.count("near", culled.near, "Gaussians", "At or before the near plane.");
    v.count("near_in_view", culled.near_in_view, "Gaussians",
            "Of these, in view; a warning names them.");
    v.count("transparent", culled.transparent, "Gaussians", "Opacity under 1/255.");
    v.count("degenerate", culled.degenerate, "Gaussians", "No finite projection or colour.");
    v.count("off_screen", culled.off_screen, "Gaussians", "No pixel touched.");
    v.end_section();
}

std::optional<double> fragments_per_splat(const WorkloadFacts& workload) {
    if (!workload.reference || workload.visible == 0) {
        return {};
    }
    return ratio_of(workload.reference->fragments, workload.visible);
}

void describe_workload(const WorkloadFacts& workload, const SceneFacts& scene, StatsVisitor& v) {
    const auto of_reference = [&workload](std::uint64_t ReferenceCounts::*count) {
        return workload.reference ? std::optional<std::uint64_t>((*workload.reference).*count)
                                  : std::nullopt;
    };
    v.begin_section("workload", "What the first frame asks for.");
    v.count("gaussians", workload.gaussians, "Gaussians", "Read by projection.");
    v.count("dropped", scene.dropped.total(), "Gaussians", "The sum of scene.dropped.");
    v.count("visible", workload.visible, "Gaussians", "Splats that at least one tile lists.");
    describe_culled(workload.culled, v);
    v.text("projection", workload.projection.numbers.name(),
           "Formats of the projection, and of SH coefficients and depth keys if they are not the "
           "default.");
    v.text("order", name_of(workload.projection.order),
           "What splats are blended by: view z, or distance to the camera.");
    v.text("antialiasing", workload.projection.compensated ? "on" : "off",
           "Whether opacities make up for the low-pass filter.");
    v.real("low_pass", workload.projection.dilation, "px2", "Added to both variances of a splat.");
    v.real("cut", workload.projection.cut, "",
           "Squared Mahalanobis distance at which splats end; 12: where alpha is 1/255.");
    v.real("near", workload.projection.near_plane, "scene units",
           "View z at or before which Gaussians are not drawn.");
    v.count("tile_size", workload.tile_size, "px", "Side of a tile.");
    v.count("tiles", workload.tiles, "tiles", "Tiles of the image.");
    v.count("empty_tiles", workload.empty_tiles, "tiles", "Tiles that list no splat.");
    v.count("tile_pairs", workload.tile_pairs, "entries", "Entries of all tile lists.");
    v.count("fragments", of_reference(&ReferenceCounts::fragments), "pixels",
            "Pixel updates of the reference renderer; null with --no-reference.");
    v.real("fragments_per_splat", fragments_per_splat(workload), "pixels",
           "fragments / visible; null likewise, and if nothing is visible.");
    v.count("terminated_pixels", of_reference(&ReferenceCounts::terminated), "pixels",
            "Pixels of the reference that ended early; null likewise.");
    v.end_section();
}

StatValue checksum(const RunResult& result) {
    if (result.accelerator.images.empty()) {
        return {};
    }
    return pixel_crc32(image_of(result, 0));
}

void describe_image(const RunResult& result, StatsVisitor& v) {
    const std::optional<ImageError>& error = result.error;
    const auto of_error = [&error](double ImageError::*number) {
        return error ? std::optional<double>((*error).*number) : std::nullopt;
    };
    v.begin_section("image", "The first frame against the reference in double precision.");
    v.real("psnr_db", of_error(&ImageError::psnr_db), "dB",
           "Peak 1, all channels, unclamped; \"inf\" if the images are identical.");
    v.real("ssim", of_error(&ImageError::ssim), "",
           "Gaussian window of 11 x 11 pixels, sigma 1.5, mean over channels.");
    v.real(
        "max_abs_error", of_error(&ImageError::max_abs_error), "",
        "Largest difference of a channel or of the transmittance; \"inf\" if one is infinite, null "
        "if one is not a number.");
    v.statistic({"crc32", "",
                 "CRC-32 of the pixels of image.png, red, green and blue from the top left, in "
                 "hexadecimal."},
                checksum(result));
    if (v.wants(!error)) {
        v.text("why",
               result.sampling ? "a sample of the tiles leaves most of the image undrawn"
                               : "the run was asked not to render the reference (--no-reference)",
               "Only with --no-reference or from a sample, when the first three are null.");
    }
    v.end_section();
}

std::optional<double> ratio(double part, const std::optional<double>& whole) {
    return whole && *whole != 0 ? std::optional<double>(part / *whole) : std::nullopt;
}

void describe_host(const RunResult& result, StatsVisitor& v) {
    const HostFacts& host = result.host;
    v.begin_section("host", "The machine that simulated; differs between runs.");
    v.text("fidelity", host.fidelity, "exact, strict or sampled.");
    v.real("load_s", host.load_s, "s", "Reading the scene.");
    v.real("workload_s", host.workload_s, "s", "Projection, depth order and tile lists.");
    v.real("elaborate_s", host.elaborate_s, "s", "Building the model.");
    v.real("start_s", host.start_s, "s",
           "From the start of the command to that of the simulation proper.");
    v.real("sim_s", host.sim_s, "s",
           "The simulation proper: its processor's time, and its waits for the functional model.");
    v.real("functional_s", host.functional_s, "s",
           "What the thread of the functional model computed meanwhile.");
    v.real("run_s", host.run_s, "s",
           "Everything between the projected frames and their results, of all threads.");
    v.real("render_s", host.render_s, "s",
           "The reference image, on one processor; null with --no-reference.");
    v.real("sim_over_render", ratio(host.sim_s, host.render_s), "", "sim_s / render_s.");
    v.real("wall_s", host.wall_s, "s", "All of it, without writing the files.");
    v.real("fragments_per_s",
           ratio(static_cast<double>(result.accelerator.fragments()), host.sim_s), "pixels/s",
           "Pixels of splats that were blended / sim_s.");
    v.count("activations", host.activations, "resumptions",
            "How often the kernel resumed a process of the model.");
    v.count("peak_rss_bytes", host.peak_rss_bytes, "bytes", "Largest resident set.");
    v.end_section();
}

/// The sections of a report between `conservation` and `warnings`.
void describe_outcome(const RunResult& result, StatsVisitor& v) {
    v.section("energy", result.accelerator.energy, "Energy of the accelerator and its memory.");
    v.section("area", result.config.accelerator().bill(), "What the design costs.");
    v.section("clock", result.config.accelerator().clock(), "What clock our RTL of it allows.");
    describe_image(result, v);
}

/// Intervals at the places that their numbers have in the report.
ordered_json intervals_json(const std::vector<ReportInterval>& intervals) {
    ordered_json json = ordered_json::object();
    for (const ReportInterval& interval : intervals) {
        ordered_json* place = &json;
        std::size_t from = 0;
        for (std::size_t dot = interval.path.find('.'); dot != std::string::npos;
             dot = interval.path.find('.', from)) {
            place = &(*place)[interval.path.substr(from, dot - from)];
            from = dot + 1;
        }
        (*place)[interval.path.substr(from)] = {interval.low, interval.high};
    }
    return json;
}

ordered_json sampling_json(const SamplingFacts& sampling) {
    const SamplingRequest& request = sampling.request;
    ordered_json json;
    json["measure"] = request.measure;
    json["within"] = request.within > 0 ? ordered_json(request.within) : ordered_json(nullptr);
    json["share"] = request.share > 0 ? ordered_json(request.share) : ordered_json(nullptr);
    json["seed"] = request.seed;
    json["reached"] = sampling.reached;
    json["confidence"] = kConfidence;
    json["tiles"] = sampling.tiles;
    json["tiles_measured"] = sampling.measured;
    json["tiles_simulated"] = sampling.simulated;
    json["groups"] = sampling.groups;
    json["looks"] = sampling.looks;
    json["intervals"] = intervals_json(sampling.intervals);
    return json;
}

ordered_json laws_json(const AcceleratorResult& run) {
    ordered_json json = ordered_json::array();
    for (const Conservation& c : run.conservation) {
        json.push_back({{"law", c.law}, {"left", c.left}, {"right", c.right}});
    }
    return json;
}

ordered_json losses_json(const RunResult& result) {
    ordered_json json = ordered_json::array();
    for (const Loss& loss : losses_of(result)) {
        ordered_json keys = ordered_json::array();
        for (const LossStep& key : loss.keys) {
            keys.push_back(key.words);
        }
        json.push_back({{"reason", loss.reason}, {"share", loss.share}, {"keys", keys}});
    }
    return json;
}

/// What the changes of the largest losses gain, as the summary has them.
ordered_json gains_json(const RunResult& result) {
    ordered_json json = ordered_json::array();
    for (const Loss& loss : largest_losses(result)) {
        if (const WhatIf* const best = best_gain(loss, result)) {
            json.push_back(
                {{"reason", loss.reason},
                 {"change", best->change},
                 {"gain", -best->share()},
                 {"interval",
                  {-best->share() - best->half_width(), -best->share() + best->half_width()}}});
        }
    }
    return json;
}

} // namespace

ordered_json tool_json() {
    return {{"name", "degs"}, {"version", DEGS_VERSION}};
}

ordered_json scene_json(const SceneFacts& scene) {
    ordered_json json{{"name", scene.name},
                      {"source", scene.source},
                      {"gaussians", scene.gaussians},
                      {"sh_degree", scene.sh_degree},
                      {"antialiased", scene.traits.antialiased},
                      {"dropped",
                       {{"non_finite", scene.dropped.non_finite},
                        {"zero_rotation", scene.dropped.zero_rotation},
                        {"bad_scale", scene.dropped.bad_scale},
                        {"bad_opacity", scene.dropped.bad_opacity}}}};
    if (!scene.workload_xxh128.empty()) {
        json["workload_xxh128"] = scene.workload_xxh128;
    }
    return json;
}

ordered_json camera_json(const Camera& camera) {
    ordered_json rotation = ordered_json::array();
    for (int row = 0; row < 3; ++row) {
        rotation.push_back({camera.camera_to_world[0][row], camera.camera_to_world[1][row],
                            camera.camera_to_world[2][row]});
    }
    ordered_json json = {{"id", camera.id},
                         {"img_name", camera.name},
                         {"width", camera.width},
                         {"height", camera.height},
                         {"position", {camera.position.x, camera.position.y, camera.position.z}},
                         {"rotation", std::move(rotation)},
                         {"fx", camera.fx},
                         {"fy", camera.fy}};
    if (!camera.is_centred()) {
        const glm::dvec2 point = camera.principal_point();
        json["cx"] = point.x;
        json["cy"] = point.y;
        json["raster_origin"] = {camera.origin.x, camera.origin.y};
    }
    if (!camera.hole.empty()) {
        const PixelBox hole = camera.hole.relative_to(camera.origin.x, camera.origin.y);
        json["hole"] = {hole.x0, hole.y0, hole.width(), hole.height()};
    }
    if (!camera.lens.is_pinhole()) {
        const LensTerms lens = terms_of(camera.lens);
        json["camera_model"] = lens.model;
        json["distortion"] = lens.terms;
    }
    return json;
}

ordered_json changes_json(const FrameChanges& changes) {
    return {{"active_overlap", value_or_null(changes.active_overlap)},
            {"tile_churn", value_or_null(changes.tile_churn)},
            {"p99_tile_candidates", changes.p99_tile_candidates},
            {"footprint_gini", changes.footprint_gini}};
}

ordered_json workload_json(const WorkloadFacts& workload, const SceneFacts& scene) {
    return statistics_json(list_statistics([&](StatsVisitor& visitor) {
               describe_workload(workload, scene, visitor);
           }))
        .front();
}

void describe(const RunResult& result, StatsVisitor& visitor) {
    describe_workload(result.workload, result.scene, visitor);
    result.accelerator.describe(visitor);
    describe_outcome(result, visitor);
    describe_host(result, visitor);
}

ordered_json report(const RunResult& result) {
    ordered_json json;
    json["schema"] = {{"name", "degs-report"}, {"version", kReportVersion}};
    json["tool"] = tool_json();
    json["scene"] = scene_json(result.scene);
    json["camera"] = camera_json(result.camera);
    json["config"] = resolved(result.config);
    json["workload"] = workload_json(result.workload, result.scene);
    json.update(statistics_json(
        list_statistics([&](StatsVisitor& visitor) { result.accelerator.describe(visitor); })));
    json["losses"] = losses_json(result);
    json["conservation"] = laws_json(result.accelerator);
    json.update(statistics_json(
        list_statistics([&](StatsVisitor& visitor) { describe_outcome(result, visitor); })));
    if (result.changes) {
        json["changes"] = changes_json(*result.changes);
    }
    if (!result.views.empty()) {
        json["views"] = views_json(result);
    }
    if (result.foveation) {
        json["foveation"] = foveation_json(result);
    }
    if (result.sampling) {
        json["sampling"] = sampling_json(*result.sampling);
    }
    if (!result.gains.empty()) {
        json["gains"] = gains_json(result);
    }
    if (!result.what_if.empty()) {
        json["what_if"] = what_if_json(result.what_if);
    }
    json["warnings"] = result.warnings;
    json.update(statistics_json(
        list_statistics([&](StatsVisitor& visitor) { describe_host(result, visitor); })));
    return json;
}

} // namespace degs::sim
