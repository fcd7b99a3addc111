// SPDX-License-Identifier: Apache-2.0
#include "sim/analytic/analytic_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <nlohmann/json.hpp>

#include "config/config_document.hpp"
#include "degs/error.hpp"
#include "modules/kit/analytic/analytic_energy.hpp"
#include "sim/design/run_config.hpp"
#include "sim/process/memory_use.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/report.hpp"
#include "sim/report/what_if_words.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_warnings.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

double milliseconds(const AnalyticRun& run) {
    return run.frame.cycles / (run.config.accelerator().clock_ghz * 1e6);
}

ordered_json units_json(const AnalyticFrame& frame) {
    ordered_json units;
    for (const AnalyticFrame::Unit& unit : frame.units) {
        units[unit.name] = {{"preparing_cycles", unit.preparing},
                            {"rendering_cycles", unit.rendering}};
    }
    return units;
}

/// The sections on energy and area, as a report has them.
ordered_json costs_json(const AnalyticRun& run) {
    return statistics_json(list_statistics([&run](StatsVisitor& visitor) {
        visitor.section("energy", run.energy, "What the frame takes.");
        visitor.section("area", run.config.accelerator().bill(), "What the design costs.");
    }));
}

std::string cycles_words(double cycles) {
    return grouped(static_cast<std::uint64_t>(std::max(cycles, 0.0)));
}

/// How sure the estimate is, and what makes it less so.
std::string interval_words(const AnalyticFrame& frame) {
    constexpr double kFewTiles = 20;
    std::string words = frame.interval
                            ? "On nine views in ten a simulation takes " +
                                  cycles_words(frame.interval->low) + " to " +
                                  cycles_words(frame.interval->high) + " cycles."
                            : "How far simulations lie from estimates of this accelerator has not "
                              "been measured.";
    if (frame.carrying_tiles < kFewTiles) {
        words += " The work lies in few tiles, as if about " +
                 cycles_words(std::ceil(frame.carrying_tiles)) + " of " +
                 std::to_string(frame.tiles) + " shared it, which makes the estimate less sure.";
    }
    return words;
}

} // namespace

std::unique_ptr<AnalyticModel> analytic_model_of(const RunConfig& config) {
    std::unique_ptr<AnalyticModel> model = config.accelerator().analytic();
    if (model == nullptr) {
        throw InputError("The accelerator of " + config.accelerator().name +
                         " has no analytic model; it can be simulated with --fidelity exact.");
    }
    return model;
}

AnalyticRun run_analytic(const RunConfig& config, const SceneFacts& scene,
                         const FrameWorkload& frame) {
    AnalyticRun run;
    run.config = config;
    const std::unique_ptr<AnalyticModel> model = analytic_model_of(config);
    const Stopwatch clock;
    run.frame = estimate_frame(*model, frame, config.accelerator().tile_order);
    run.energy = estimated_energy(config.accelerator(), *model, run.frame,
                                  std::uint64_t{1} * frame.camera.width * frame.camera.height);
    run.estimate_s = clock.seconds();
    run.memory_gb_per_s = model->main_memory().peak_gb_per_s();
    run.scene = scene;
    run.camera = frame.camera;
    run.workload = facts_of(frame);
    run.warnings = scene.notes;
    run.warnings.insert(run.warnings.end(), config.warnings.begin(), config.warnings.end());
    for (std::string& sentence : lens_warnings(frame.camera, frame.projection)) {
        run.warnings.push_back(std::move(sentence));
    }
    for (std::string& sentence : near_plane_warnings(frame)) {
        run.warnings.push_back(std::move(sentence));
    }
    return run;
}

AnalyticRun run_analytic(const RunConfig& config, CachedView& view,
                         const std::vector<ChangedDesign>& changed) {
    analytic_model_of(config); // a mistake is found before the frame is made
    const std::vector<FramePointer> frames = view.first_frame(config.accelerator());
    AnalyticRun run = run_analytic(config, view.facts(), *frames.front());
    run.what_if = what_if(config, changed, *frames.front(), view);
    run.load_s = view.load_s();
    run.workload_s = view.workload_s();
    view.keep(frames, {});
    return run;
}

bool is_estimated(Measure measure) {
    constexpr std::array<Measure, 16> kEstimated{
        Measure::Cycles,        Measure::PreprocessingCycles, Measure::LatencyMs,
        Measure::Fps,           Measure::Utilization,         Measure::AreaMm2,
        Measure::SramBytes,     Measure::NjPerFrame,          Measure::NjPerPixel,
        Measure::AveragePowerW, Measure::LatencyRatio,        Measure::LatencyRatioPerArea,
        Measure::EnergyRatio,   Measure::EnergyRatioPerArea,  Measure::SimS,
        Measure::DramPeak};
    return std::find(kEstimated.begin(), kEstimated.end(), measure) != kEstimated.end();
}

Measures measures_of(const AnalyticRun& run) {
    const double latency_ms = milliseconds(run);
    Measures measures;
    measures[Measure::Cycles] = run.frame.cycles;
    measures[Measure::PreprocessingCycles] = run.frame.preparation;
    measures[Measure::LatencyMs] = latency_ms;
    measures[Measure::Fps] = 1000 / latency_ms;
    measures[Measure::Utilization] = run.frame.utilization;
    measures[Measure::AreaMm2] = run.config.accelerator().bill().area_mm2();
    measures[Measure::SramBytes] =
        static_cast<double>(run.config.accelerator().bill().sram_bytes());
    measures[Measure::NjPerFrame] = run.energy.nj_per_frame();
    measures[Measure::NjPerPixel] = run.energy.nj_per_pixel();
    measures[Measure::AveragePowerW] = run.energy.average_power_w();
    measures[Measure::DramPeak] = run.memory_gb_per_s;
    measures[Measure::SimS] = run.estimate_s;
    return measures;
}

ordered_json analytic_json(const AnalyticRun& run) {
    ordered_json json;
    json["schema"] = {{"name", "degs-analytic"}, {"version", kAnalyticVersion}};
    json["tool"] = tool_json();
    json["scene"] = scene_json(run.scene);
    json["camera"] = camera_json(run.camera);
    json["config"] = resolved(run.config);
    json["workload"] = workload_json(run.workload, run.scene);
    const AnalyticFrame& frame = run.frame;
    json["timing"] = {
        {"cycles", frame.cycles},          {"lower_cycles", frame.lower},
        {"upper_cycles", frame.upper},     {"preprocessing_cycles", frame.preparation},
        {"latency_ms", milliseconds(run)}, {"clock_ghz", run.config.accelerator().clock_ghz}};
    if (frame.interval) {
        json["timing"]["cycles_interval"] = {frame.interval->low, frame.interval->high};
        json["timing"]["confidence"] = kEstimateConfidence;
    }
    json["units"] = units_json(frame);
    json["limited_by"] = frame.limited_by;
    json["limited_share"] = frame.busiest;
    json["slots"] = {{"pes", run.config.accelerator().pes()}, {"utilization", frame.utilization}};
    json["dram"] = {{"bytes", frame.bytes}, {"peak_gb_per_s", run.memory_gb_per_s}};
    json.update(costs_json(run));
    json["sample"] = {{"tiles", frame.tiles},
                      {"tiles_drawn", frame.drawn},
                      {"rows_apart", frame.rows_apart},
                      {"carrying_tiles", frame.carrying_tiles},
                      {"standard_error", frame.drawing_error}};
    if (!run.what_if.empty()) {
        json["what_if"] = what_if_json(run.what_if);
    }
    json["warnings"] = run.warnings;
    json["host"] = {{"fidelity", "analytic"},
                    {"load_s", run.load_s},
                    {"workload_s", run.workload_s},
                    {"estimate_s", run.estimate_s},
                    {"peak_rss_bytes", peak_rss_bytes()}};
    return json;
}

std::string analytic_text(const AnalyticRun& run) {
    const AnalyticFrame& frame = run.frame;
    TextTable table({"unit", "preparing, cycles", "rendering, cycles", "of the estimate %"});
    for (const AnalyticFrame::Unit& unit : frame.units) {
        table.add({unit.name, cycles_words(unit.preparing), cycles_words(unit.rendering),
                   percent((unit.preparing + unit.rendering) / frame.cycles)});
    }
    std::string text = table.text();
    const auto say = [&text](const std::string& sentence) {
        text += folded(sentence, output_columns(), 0) + "\n";
    };
    text += "\n";
    say(run.config.accelerator().name + " takes about " + cycles_words(frame.cycles) + " cycles, " +
        three_digits(milliseconds(run)) + " ms, of which " + cycles_words(frame.preparation) +
        " before the first tile.");
    say(interval_words(frame));
    say("At least " + cycles_words(frame.lower) + " if all units overlapped perfectly, at most " +
        cycles_words(frame.upper) + " if none did; rendering is limited by " + frame.limited_by +
        ".");
    say("PEs are used to " + percent(frame.utilization) + " %; " +
        scaled_bytes(static_cast<std::uint64_t>(frame.bytes)) + " move to and from memory.");
    constexpr double kMjPerNj = 1e-6;
    say("It takes about " + three_digits(run.energy.total_nj() * kMjPerNj) +
        " mJ: " + percent(run.energy.dynamic_nj() / run.energy.total_nj()) +
        " % for the work of its blocks, " +
        percent(run.energy.leakage_nj() / run.energy.total_nj()) + " % for leakage, and " +
        percent(run.energy.dram_nj().value_or(0) / run.energy.total_nj()) + " % in memory.");
    say("The estimate rests on " + std::to_string(frame.drawn) + " of " +
        std::to_string(frame.tiles) + " tiles and took " + three_digits(1e3 * run.estimate_s) +
        " ms; there is no image.");
    return text + what_if_text(run.what_if);
}

} // namespace degs::sim
