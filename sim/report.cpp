// SPDX-License-Identifier: Apache-2.0
#include "sim/report.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// JSON has no infinity: identical images have a PSNR of "inf". What is not a number is null.
ordered_json number_or_null(double value) {
    if (std::isinf(value)) {
        return value > 0 ? "inf" : "-inf";
    }
    return std::isnan(value) ? ordered_json() : ordered_json(value);
}

/// Null where there is nothing to divide by.
ordered_json ratio(double part, double whole) {
    return whole == 0 ? ordered_json() : ordered_json(part / whole);
}

ordered_json unavailable(const char* why) {
    return {{"available", false}, {"why", why}};
}

ordered_json counts_json(const Counts& counts) {
    ordered_json json = ordered_json::object();
    for (const auto& [name, count] : counts) {
        json[name] = count;
    }
    return json;
}

/// The first frame has the accelerator to itself until the next one's preprocessing starts.
ordered_json timing_json(const AcceleratorResult& run) {
    const double frame_ns =
        static_cast<double>(run.frames.empty() ? 0 : run.frames.front().finished) / run.clock_ghz;
    const std::optional<double> steady = steady_fps(run);
    ordered_json finished = ordered_json::array();
    for (const FrameDates& frame : run.frames) {
        finished.push_back(frame.finished);
    }
    return {{"cycles", run.cycles},
            {"latency_ms", frame_ns * 1e-6},
            {"fps", ratio(1e9, frame_ns)},
            {"clock_ghz", run.clock_ghz},
            {"preprocessing_cycles", run.frames.empty() ? 0 : run.frames.front().preprocessed},
            {"blending_cycles", run.window.cycles()},
            {"frames", run.frames.size()},
            {"frame_finished_cycles", std::move(finished)},
            {"throughput_fps", steady ? ordered_json(*steady) : ordered_json()},
            {"array_only", run.array_only}};
}

ordered_json stages_json(const AcceleratorResult& run) {
    ordered_json json = ordered_json::object();
    for (const StageUse& stage : run.stages) {
        ordered_json entry = {
            {"units", stage.units}, {"busy_cycles", stage.busy_cycles}, {"busy", stage.busy}};
        entry.update(counts_json(stage.counts));
        json[stage.name] = std::move(entry);
    }
    json["limited_by"] = limiting_stage(run);
    return json;
}

ordered_json slots_json(const AcceleratorResult& run) {
    const SlotAccount& s = run.slots;
    const double frame_slots = static_cast<double>(run.pes) * static_cast<double>(run.cycles);
    const auto useful = static_cast<double>(s.useful);
    const bool any = !run.window.empty();
    return {{"pes", run.pes},
            {"total", s.total()},
            {"useful", s.useful},
            {"boundary", s.boundary},
            {"terminated", s.terminated},
            {"conflict", s.conflict},
            {"starved", s.starved},
            {"blocked", s.blocked},
            {"drain", s.drain},
            {"utilization", ratio(useful, static_cast<double>(s.total()))},
            {"frame_utilization", ratio(useful, frame_slots)},
            {"window_first", any ? ordered_json(run.window.first) : ordered_json()},
            {"window_last", any ? ordered_json(run.window.last) : ordered_json()},
            {"hazards", run.hazards}};
}

ordered_json energy_json(const dram::Energy& energy) {
    return {{"activate", energy.activate_nj},     {"read", energy.read_nj},
            {"write", energy.write_nj},           {"refresh", energy.refresh_nj},
            {"background", energy.background_nj}, {"total", energy.total_nj()}};
}

ordered_json dram_json(const AcceleratorResult& run) {
    std::uint64_t read = 0;
    std::uint64_t written = 0;
    ordered_json streams = ordered_json::object();
    for (const StreamUse& stream : run.streams) {
        read += stream.bytes_read;
        written += stream.bytes_written;
        streams[stream.name] = {{"bytes_read", stream.bytes_read},
                                {"bytes_written", stream.bytes_written},
                                {"requests", stream.requests}};
        if (stream.read_latency.samples() != 0) {
            streams[stream.name]["read_latency_ns"] = {
                {"mean", stream.read_latency.mean_ns()},
                {"p95", stream.read_latency.percentile_ns(0.95)}};
        }
    }
    return {{"bytes_read", read},
            {"bytes_written", written},
            {"peak_gb_per_s",
             run.memory_gb_per_s > 0 ? ordered_json(run.memory_gb_per_s) : ordered_json()},
            {"utilization",
             run.memory_gb_per_s > 0 ? ordered_json(run.memory_utilization) : ordered_json()},
            {"row_hit_rate", run.row_hit_rate ? ordered_json(*run.row_hit_rate) : ordered_json()},
            {"energy_nj", run.dram_energy ? energy_json(*run.dram_energy) : ordered_json()},
            {"streams", std::move(streams)}};
}

ordered_json buffers_json(const AcceleratorResult& run) {
    ordered_json json = ordered_json::object();
    for (const BufferUse& buffer : run.buffers) {
        ordered_json entry = ordered_json::object();
        if (buffer.bytes != 0) {
            entry["bytes"] = buffer.bytes;
        }
        if (buffer.depth != 0) {
            entry["rings"] = buffer.rings;
            entry["depth"] = buffer.depth;
            entry["high_water"] = buffer.high_water;
            entry["mean_fill"] = buffer.mean_fill;
            entry["full_cycles"] = buffer.full_cycles;
            entry["empty_cycles"] = buffer.empty_cycles;
        }
        entry.update(counts_json(buffer.counts));
        json[buffer.name] = std::move(entry);
    }
    return json;
}

ordered_json laws_json(const AcceleratorResult& run) {
    ordered_json json = ordered_json::array();
    for (const Conservation& c : run.conservation) {
        json.push_back({{"law", c.law}, {"left", c.left}, {"right", c.right}});
    }
    return json;
}

ordered_json area_json(const AreaConfig& area) {
    if (area.total() <= 0) {
        return unavailable("the configuration says nothing of area");
    }
    return {{"mm2", area.total()}, {"fixed_mm2", area.fixed_mm2}, {"array_mm2", area.array_mm2}};
}

ordered_json image_json(const RunResult& result) {
    ordered_json json = {{"psnr_db", nullptr}, {"ssim", nullptr}, {"max_abs_error", nullptr}};
    if (result.error) {
        json["psnr_db"] = number_or_null(result.error->psnr_db);
        json["ssim"] = number_or_null(result.error->ssim);
        json["max_abs_error"] = number_or_null(result.error->max_abs_error);
    } else {
        json["why"] = "the run was asked not to render the reference (--no-reference)";
    }
    return json;
}

ordered_json host_json(const RunResult& result) {
    const HostFacts& host = result.host;
    const auto blended = static_cast<double>(result.accelerator.slots.useful);
    return {{"fidelity", host.fidelity},
            {"load_s", host.load_s},
            {"workload_s", host.workload_s},
            {"elaborate_s", host.elaborate_s},
            {"sim_s", host.sim_s},
            {"render_s", host.render_s ? ordered_json(*host.render_s) : ordered_json()},
            {"sim_over_render", host.render_s ? ratio(host.sim_s, *host.render_s) : ordered_json()},
            {"wall_s", host.wall_s},
            {"fragments_per_s", ratio(blended, host.sim_s)},
            {"peak_rss_bytes", host.peak_rss_bytes}};
}

} // namespace

ordered_json tool_json() {
    return {{"name", "degs"}, {"version", DEGS_VERSION}};
}

ordered_json scene_json(const SceneFacts& scene) {
    return {{"name", scene.name},
            {"source", scene.source},
            {"gaussians", scene.gaussians},
            {"sh_degree", scene.sh_degree},
            {"dropped",
             {{"non_finite", scene.dropped.non_finite},
              {"zero_rotation", scene.dropped.zero_rotation},
              {"bad_scale", scene.dropped.bad_scale},
              {"bad_opacity", scene.dropped.bad_opacity}}}};
}

ordered_json camera_json(const Camera& camera) {
    ordered_json rotation = ordered_json::array();
    for (int row = 0; row < 3; ++row) {
        rotation.push_back({camera.camera_to_world[0][row], camera.camera_to_world[1][row],
                            camera.camera_to_world[2][row]});
    }
    return {{"id", camera.id},
            {"img_name", camera.name},
            {"width", camera.width},
            {"height", camera.height},
            {"position", {camera.position.x, camera.position.y, camera.position.z}},
            {"rotation", std::move(rotation)},
            {"fx", camera.fx},
            {"fy", camera.fy}};
}

ordered_json workload_json(const WorkloadFacts& workload, const SceneFacts& scene) {
    const auto& reference = workload.reference;
    return {
        {"gaussians", workload.gaussians},
        {"dropped", scene.dropped.total()},
        {"visible", workload.visible},
        {"culled",
         {{"near", workload.culled.near},
          {"transparent", workload.culled.transparent},
          {"degenerate", workload.culled.degenerate},
          {"off_screen", workload.culled.off_screen}}},
        {"projection", workload.projection},
        {"tile_size", workload.tile_size},
        {"tiles", workload.tiles},
        {"empty_tiles", workload.empty_tiles},
        {"tile_pairs", workload.tile_pairs},
        {"fragments", reference ? ordered_json(reference->fragments) : ordered_json()},
        {"terminated_pixels", reference ? ordered_json(reference->terminated) : ordered_json()}};
}

ordered_json report(const RunResult& result) {
    const AcceleratorResult& run = result.accelerator;
    ordered_json json;
    json["schema"] = {{"name", "degs-report"}, {"version", kReportVersion}};
    json["tool"] = tool_json();
    json["scene"] = scene_json(result.scene);
    json["camera"] = camera_json(result.camera);
    json["config"] = resolved(result.config);
    json["workload"] = workload_json(result.workload, result.scene);
    json["timing"] = timing_json(run);
    json["stages"] = stages_json(run);
    json["slots"] = slots_json(run);
    json["dram"] = dram_json(run);
    json["buffers"] = buffers_json(run);
    json["conservation"] = laws_json(run);
    json["energy"] = unavailable("this version has no energy model");
    json["area"] = area_json(result.config.accelerator().area);
    json["image"] = image_json(result);
    json["warnings"] = result.warnings;
    json["host"] = host_json(result);
    return json;
}

} // namespace degs::sim
