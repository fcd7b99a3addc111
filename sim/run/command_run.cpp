// SPDX-License-Identifier: Apache-2.0
// degs run: one frame, or a camera path, on one accelerator.
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include <nlohmann/json.hpp>

#include "degs/error.hpp"
#include "scene/files/image_io.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/cache/cached_view.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/report/report.hpp"
#include "sim/report/terminal.hpp"
#include "sim/report/what_if_words.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/simulation/foveated_run.hpp"
#include "sim/simulation/warnings.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/trace/block_log.hpp"
#include "sim/trace/memory_trace.hpp"
#include "sim/trace/tile_maps.hpp"
#include "sim/trace/trace_file.hpp"
#include "sim/trace/trace_options.hpp"

namespace degs::sim {
namespace {

struct RunOptions {
    std::string config, memory;
    std::vector<std::string> overrides, what_if;
    ViewRequest view;
    PathRequest path;
    std::string fidelity = "exact";
    std::optional<std::string> within;
    std::uint64_t seed = 1;
    std::string out = "out";
    bool no_reference = false;
    bool no_cache = false;
    bool array_only = false;
    bool explain = false;
    TraceRequest trace;
    BlockLogRequest block_log;
    std::string maps;         ///< folder; empty: none
    std::string memory_trace; ///< file; empty: none
};

const std::string kAnalytic = "analytic";

/// Files of an earlier run that tell nothing of this one: maps of tiles, and further images.
std::vector<std::string> old_files(const OutputFolder& out, const std::optional<OutputFolder>& maps,
                                   std::size_t images) {
    std::vector<std::string> paths = old_tile_maps(out, maps);
    const auto there = [](const std::string& path) { return std::filesystem::exists(path); };
    for (std::size_t v = images;; ++v) {
        const std::string exr = out.path(view_file("image", v, ".exr"));
        const std::string png = out.path(view_file("image", v, ".png"));
        if (!there(exr) || !there(png)) {
            return paths;
        }
        paths.push_back(exr);
        paths.push_back(png);
    }
}

void estimate(const RunOptions& options) {
    const RunConfig config = load_run_config(options.config, options.overrides, options.memory);
    CachedView view(options.view, options.path,
                    options.no_cache ? FrameCache() : FrameCache::of_user());
    const OutputFolder out(options.out, image_result_files("analytic.json"));
    const AnalyticRun run = run_analytic(config, view, changed_designs(config, options.what_if));
    out.replace([&] { out.write_json("analytic.json", analytic_json(run)); },
                old_files(out, std::nullopt, 1));
    print_warnings(run.warnings);
    print(analytic_text(run));
}

/// The images that the first frame is compared with.
struct References {
    std::vector<Reference> views;
    std::vector<Reference> full; ///< of foveated images: without foveation
};

References references_of(const std::vector<FrameWorkload>& workloads, const RunRequest& request,
                         CachedView& view) {
    References references;
    references.views.reserve(request.views);
    for (int v = 0; v < request.views; ++v) {
        references.views.push_back(view.reference(workloads[v]));
    }
    if (view.foveated()) {
        for (const FoveatedView& image : view.foveated()->images) {
            references.full.push_back(view.full_reference(image.camera, workloads.front()));
        }
    }
    return references;
}

void judge_views(RunResult& result, const References& references) {
    judge(result, references.views.front());
    for (std::size_t v = 0; v < result.views.size(); ++v) {
        judge_view(result, v, references.views[v]);
    }
    if (result.foveation) {
        judge_foveation(result, references.views, references.full);
    }
}

/// Makes or finds the frames, runs them and compares the first one with its reference.
RunResult simulate(const RunRequest& request, const std::vector<ChangedDesign>& changed,
                   CachedView& view, const Stopwatch& since_start) {
    const Stopwatch wall;
    const std::vector<FrameWorkload> first = view.first_frame(request.config.accelerator());
    if (request.reference && !request.sampling) {
        view.require_reference(first.front());
    }
    std::vector<WhatIf> worth = what_if(request.config, changed, first.front(), view);
    References references; // now if they need Gaussians that are there
    const bool from_scene = request.reference && view.has_cloud() &&
                            (!first.front().projection.numbers.is_reference() || view.foveated());
    if (from_scene && !request.sampling) {
        references = references_of(first, request, view);
    }
    RunResult result = run_frames(request, view.frames(request.config.accelerator(), first));
    put_scene(view.facts(), result);
    result.what_if = std::move(worth);
    if (view.foveated()) {
        put_foveation(*view.foveated(), result);
    }
    if (request.reference && !result.sampling) { // most of a sample's image is missing
        if (references.views.empty()) {
            references = references_of(first, request, view);
        }
        judge_views(result, references);
    }
    result.host.load_s = view.load_s();
    result.host.start_s = since_start.seconds_to(result.accelerator.sim_start);
    result.host.workload_s = view.workload_s();
    result.host.wall_s = view.load_s() + wall.seconds();
    result.host.peak_rss_bytes = peak_rss_bytes();
    view.keep(first, references.views);
    return result;
}

/// Calls simulate(); the requests to memory go to the file `trace` if it has a name.
RunResult simulate_traced(const std::string& trace, RunRequest& request,
                          const std::vector<ChangedDesign>& changed, CachedView& view,
                          const Stopwatch& since_start) {
    if (trace.empty()) {
        return simulate(request, changed, view, since_start);
    }
    std::optional<RunResult> result;
    const AcceleratorConfig& design = request.config.accelerator();
    write_memory_trace(trace, design.name, design.clock_ghz, [&](RequestListener& listener) {
        request.build.requests = &listener;
        result.emplace(simulate(request, changed, view, since_start));
        request.build.requests = nullptr;
    });
    return std::move(*result);
}

std::vector<std::string> result_files(const RunOptions& options) {
    std::vector<std::string> files = image_result_files("report.json");
    for (int v = 1; v < options.path.group.images(); ++v) {
        files.push_back(view_file("image", v, ".exr"));
        files.push_back(view_file("image", v, ".png"));
    }
    return files;
}

void write_results(const RunOptions& options, const RunRequest& request, const RunResult& result,
                   const OutputFolder& out, const std::optional<OutputFolder>& maps) {
    const AcceleratorResult& run = result.accelerator;
    for (std::size_t v = 0; v < images_of(result); ++v) {
        write_exr(image_of(result, v), out.path(view_file("image", v, ".exr")));
        write_png(image_of(result, v), out.path(view_file("image", v, ".png")));
    }
    out.write_json("report.json", report(result));
    if (request.recording.timeline) {
        write_trace({run.name, run.clock_ghz, run.timeline, spans_of(run),
                     power_of(request.config.accelerator(), run)},
                    options.trace.file);
    }
    if (request.recording.log != nullptr) {
        write_block_log(run.name, options.block_log, *request.recording.log);
    }
    if (maps) {
        write_tile_maps(result, *maps);
    }
}

void run(const RunOptions& options) {
    const Stopwatch since_start;
    if (options.fidelity == kAnalytic) {
        return estimate(options);
    }
    const std::optional<SamplingRequest> sampling =
        sampling_of(options.fidelity, options.within, options.seed);
    const RunConfig config = load_run_config(options.config, options.overrides, options.memory);
    const std::vector<ChangedDesign> changed = changed_designs(config, options.what_if);
    PathRequest path = options.path;
    path.near_plane = config.accelerator().data_path().rules.near;
    CachedView view(options.view, path, options.no_cache ? FrameCache() : FrameCache::of_user());
    const OutputFolder out(options.out, result_files(options));
    const bool strict = options.fidelity == "strict" || options.block_log.given();
    RunRequest request;
    request.config = config;
    request.fidelity = strict ? Fidelity::Strict : Fidelity::Exact;
    request.build.array_only = options.array_only;
    request.reference = !options.no_reference;
    request.sampling = sampling;
    request.views = view.views();
    std::optional<OutputFolder> maps;
    if (!options.maps.empty()) {
        maps.emplace(options.maps, tile_map_files());
        request.recording.tiles = true;
    }
    request.recording.timeline = timeline_of(options.trace);
    EventLog log;
    if (options.block_log.given()) {
        check_block_log(options.block_log);
        request.recording.block = options.block_log.block();
        request.recording.log = &log;
    }
    if (!options.memory_trace.empty()) {
        check_memory_trace(options.memory_trace);
    }
    std::optional<RunResult> result;
    out.replace(
        [&] {
            result.emplace(
                simulate_traced(options.memory_trace, request, changed, view, since_start));
            write_results(options, request, *result, out, maps);
        },
        old_files(out, maps, path.group.images()));
    print_warnings(result->warnings);
    print(summary(*result, out.path("image.exr")) + what_if_text(result->what_if) +
          (options.explain ? explanation(*result) : ""));
}

} // namespace

void add_run_command(CLI::App& program) {
    auto options = std::make_shared<RunOptions>();
    CLI::App* command =
        program.add_subcommand("run", "simulate a frame or a camera path on an accelerator");
    add_config_option(*command, options->config)->required();
    add_view_or_workload_options(*command, options->view);
    add_path_options(*command, options->path);
    add_group_options(*command, options->path.group);
    add_foveation_option(*command, options->path.group);
    command
        ->add_option("--fidelity", options->fidelity,
                     "exact; strict: synchronise every cycle, the results are the same; "
                     "sampled:10%: estimate them from that share of the tiles; analytic: estimate "
                     "the time in milliseconds, without a simulation and without an image")
        ->type_name("TEXT:{exact,strict,analytic}") // what can be completed
        ->capture_default_str();
    add_sampling_options(*command, options->within, options->seed);
    add_out_option(*command, options->out, "folder for image.exr, image.png and report.json");
    add_memory_option(*command, options->memory);
    add_overrides_option(*command, options->overrides);
    command
        ->add_option("--what-if", options->what_if,
                     "also estimate the cycles with this key changed, or with several at once: "
                     "path.to.key=value,...; may be repeated")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1);
    command->add_flag("--no-reference", options->no_reference,
                      "do not render the double-precision image to compare with");
    command->add_flag("--no-cache", options->no_cache,
                      "neither read nor keep frames and reference images of earlier runs");
    command->add_flag(
        "--array-only", options->array_only,
        "the rasterisation array alone: sorted lists are there at once, and memory is "
        "unlimited");
    add_trace_options(*command, options->trace);
    add_block_log_option(*command, options->block_log);
    add_memory_trace_option(*command, options->memory_trace);
    command
        ->add_option("--maps", options->maps,
                     "folder for maps of the tiles: list length, fragments, cycles, and PE-cycles "
                     "by slot class, as pictures, over the image, and as layers of tiles.exr")
        ->type_name("FOLDER");
    command->add_flag("--explain", options->explain, "print what the model left out, and why");
    command->callback([options] { run(*options); });
}

} // namespace degs::sim
