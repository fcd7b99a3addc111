// SPDX-License-Identifier: Apache-2.0
#include "sim/results/run_summary.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "modules/kit/accelerator/waiting_causes.hpp"
#include "sim/results/message_fields.hpp"
#include "sim/simulation/what_if.hpp"

namespace degs::sim {
namespace {

std::string heading() {
    return "degs-run-summary " + std::to_string(kSummaryVersion);
}

/// The fields of a message, in its order: writing and reading use this one list.
template <class Fields, class Summary>
void each_field(Fields& fields, Summary& summary) {
    fields("fidelity", summary.fidelity);
    fields("accelerator", summary.accelerator);
    fields("pes", summary.pes);
    fields("tile_size", summary.tile_size);
    fields("view.scene", summary.view.scene);
    fields("view.source", summary.view.source);
    fields("view.camera_name", summary.view.camera_name);
    fields("view.camera", summary.view.camera);
    fields("view.width", summary.view.width);
    fields("view.height", summary.view.height);
    fields("view.views", summary.view.views);
    fields("view.gaussians", summary.view.gaussians);
    fields("view.visible", summary.view.visible);
    fields("view.fragments", summary.view.fragments);
    fields("view.changes", summary.view.changes);
    for_each_measure([&](Measure m) { fields("measure." + name_of(m), summary.measures[m]); });
    fields("first_task_ms", summary.first_task_ms);
    fields("last_task_ms", summary.last_task_ms);
    fields("sampled_share", summary.sampled_share);
    fields("cycles_low", summary.cycles_low);
    fields("cycles_high", summary.cycles_high);
    fields("limited_by", summary.limited_by);
    fields("stages", summary.stages);
    fields("parts", summary.parts);
    fields("notes", summary.notes);
    fields("warnings", summary.warnings);
    fields("report", summary.report);
}

/// `position` is the camera's in the scene's list.
ComparedView view_of(const SceneFacts& scene, const Camera& camera, const WorkloadFacts& workload,
                     int position) {
    return {scene.name,    scene.source,       camera.name,      position,    camera.width,
            camera.height, workload.gaussians, workload.visible, std::nullopt};
}

/// What every design has in other parts: how full its buffers were, and the energy of its blocks.
std::vector<std::pair<std::string, double>> parts_of(const AcceleratorResult& run) {
    std::vector<std::pair<std::string, double>> parts;
    for (const BufferUse& buffer : run.buffers) {
        if (buffer.depth != 0) {
            const std::string name = "buffers." + buffer.name;
            parts.emplace_back(name + ".high_water", real_of(buffer.high_water));
            parts.emplace_back(name + ".high_water_share",
                               ratio_of(buffer.high_water, buffer.depth));
        }
    }
    const double frames = std::max(1.0, real_of(run.frames.size()));
    for (const cost::BlockEnergy& block : run.energy.blocks()) {
        parts.emplace_back("energy.blocks." + block.name + ".nj_per_frame",
                           (block.dynamic_nj + block.leakage_nj) / frames);
    }
    return parts;
}

Statistic part_statistic(const char* path, const char* unit, const char* sentence) {
    Statistic row;
    row.path = path;
    row.unit = unit;
    row.sentence = sentence;
    return row;
}

/// The warnings of a run begin with the notes of its scene.
void set_warnings(const SceneFacts& scene, const std::vector<std::string>& warnings,
                  RunSummary& summary) {
    summary.notes = scene.notes;
    summary.warnings.assign(warnings.begin() + scene.notes.size(), warnings.end());
}

} // namespace

std::optional<std::pair<double, double>> latency_ratio_interval(const RunNumbers& before,
                                                                const RunNumbers& after) {
    if (!before.cycles_low && !after.cycles_low) {
        return {};
    }
    const double ratio = *after.measures[Measure::LatencyMs] / *before.measures[Measure::LatencyMs];
    if (before.fidelity == "analytic" && after.fidelity == "analytic") {
        // A change of many times its size is one of its logarithm.
        const double width = change_half_width(std::log(ratio));
        return std::pair(ratio * std::exp(-width), ratio * std::exp(width));
    }
    const double cycles = *after.measures[Measure::Cycles],
                 other = *before.measures[Measure::Cycles];
    const double clock = ratio * other / cycles; // of `before` over that of `after`
    return std::pair(clock * after.cycles_low.value_or(cycles) / before.cycles_high.value_or(other),
                     clock * after.cycles_high.value_or(cycles) /
                         before.cycles_low.value_or(other));
}

std::vector<Statistic> part_statistics() {
    return {part_statistic("buffers.*.high_water", "cells",
                           "Most cells of one ring filled at once; of buffers with cells."),
            part_statistic("buffers.*.high_water_share", "share", "high_water / depth."),
            part_statistic("energy.blocks.*.nj_per_frame", "nJ",
                           "Dynamic energy and leakage of a block, per frame.")};
}

RunSummary summary_of(const RunResult& result, int camera) {
    RunSummary summary;
    summary.fidelity = result.host.fidelity;
    summary.accelerator = result.config.kind();
    summary.pes = result.accelerator.pes;
    summary.tile_size = result.workload.tile_size;
    summary.view = view_of(result.scene, result.camera, result.workload, camera);
    summary.view.views = std::max<int>(1, static_cast<int>(result.views.size()));
    if (result.workload.reference) {
        summary.view.fragments = result.workload.reference->fragments;
    }
    summary.view.changes = result.changes;
    summary.measures = measures_of(result);
    const AcceleratorResult& run = result.accelerator;
    if (!run.window.empty()) {
        summary.first_task_ms = rate_of(run.window.first, run.clock_ghz) * 1e-6;
        summary.last_task_ms = rate_of(run.window.last + 1, run.clock_ghz) * 1e-6;
    }
    if (result.sampling) {
        summary.sampled_share = ratio_of(result.sampling->measured, result.sampling->tiles);
        if (const ReportInterval* cycles = result.sampling->interval_of("timing.cycles")) {
            summary.cycles_low = cycles->low;
            summary.cycles_high = cycles->high;
        }
    }
    summary.limited_by = limiting_stage(run);
    for (const StageUse& stage : run.stages) {
        summary.stages.emplace_back(stage.name, stage.busy);
    }
    summary.parts = parts_of(run);
    set_warnings(result.scene, result.warnings, summary);
    return summary;
}

RunSummary summary_of(const AnalyticRun& run, int camera) {
    RunSummary summary;
    summary.fidelity = "analytic";
    summary.accelerator = run.config.kind();
    summary.pes = run.config.accelerator().pes();
    summary.tile_size = run.workload.tile_size;
    summary.view = view_of(run.scene, run.camera, run.workload, camera);
    summary.measures = measures_of(run);
    if (run.frame.interval) {
        summary.cycles_low = run.frame.interval->low;
        summary.cycles_high = run.frame.interval->high;
    }
    summary.limited_by = run.frame.limited_by;
    for (const AnalyticFrame::Unit& unit : run.frame.units) {
        const double busy = unit.preparing + unit.rendering;
        summary.stages.emplace_back(unit.name, busy / std::max(run.frame.cycles, busy));
    }
    set_warnings(run.scene, run.warnings, summary);
    return summary;
}

std::string message_of(const RunSummary& summary) {
    MessageWriter writer(heading());
    each_field(writer, summary);
    return std::move(writer.message);
}

RunSummary summary_from(const std::string& message) {
    MessageReader reader(heading(), message);
    RunSummary summary;
    each_field(reader, summary);
    reader.expect_nothing_left();
    return summary;
}

} // namespace degs::sim
