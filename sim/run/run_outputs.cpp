// SPDX-License-Identifier: Apache-2.0
#include "sim/run/run_outputs.hpp"

#include <filesystem>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "scene/files/image_io.hpp"
#include "sim/report/report.hpp"
#include "sim/trace/memory_trace.hpp"
#include "sim/trace/tile_maps.hpp"
#include "sim/trace/trace_file.hpp"

namespace degs::sim {
namespace {

std::vector<std::string> result_files(int images) {
    std::vector<std::string> files = image_result_files("report.json");
    for (int v = 1; v < images; ++v) {
        files.push_back(view_file("image", v, ".exr"));
        files.push_back(view_file("image", v, ".png"));
    }
    return files;
}

} // namespace

std::vector<std::string> files_of_earlier_run(const OutputFolder& out,
                                              const std::optional<OutputFolder>& maps, int images) {
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

RunOutputs::RunOutputs(const RunFiles& files, int images)
    : files_(files), images_(images), out_(files.out, result_files(images)) {
    if (!files_.maps.empty()) {
        maps_.emplace(files_.maps, tile_map_files());
    }
}

Recording RunOutputs::recording() {
    Recording recording;
    recording.tiles = maps_.has_value();
    recording.timeline = timeline_of(files_.trace);
    if (files_.block_log.given()) {
        check_block_log(files_.block_log);
        recording.block = files_.block_log.block();
        recording.log = &log_;
    }
    if (!files_.memory_trace.empty()) {
        check_memory_trace(files_.memory_trace);
    }
    return recording;
}

RunResult
RunOutputs::traced(const RunConfig& config,
                   const std::function<RunResult(RequestListener* requests)>& simulate) const {
    if (files_.memory_trace.empty()) {
        return simulate(nullptr);
    }
    std::optional<RunResult> result;
    const AcceleratorConfig& design = config.accelerator();
    write_memory_trace(files_.memory_trace, design.name, design.clock_ghz,
                       [&](RequestListener& listener) { result.emplace(simulate(&listener)); });
    return std::move(*result);
}

void RunOutputs::write(const RunConfig& config, const RunResult& result) const {
    const AcceleratorResult& run = result.accelerator;
    for (std::size_t v = 0; v < images_of(result); ++v) {
        write_exr(image_of(result, v), out_.path(view_file("image", v, ".exr")));
        write_png(image_of(result, v), out_.path(view_file("image", v, ".png")));
    }
    out_.write_json("report.json", report(result));
    if (!files_.trace.file.empty()) {
        write_trace({run.name, run.clock_ghz, run.timeline, spans_of(run),
                     power_of(config.accelerator(), run)},
                    files_.trace.file);
    }
    if (files_.block_log.given()) {
        write_block_log(run.name, files_.block_log, log_);
    }
    if (maps_) {
        write_tile_maps(result, *maps_);
    }
}

RunResult RunOutputs::write(const RunConfig& config,
                            const std::function<RunResult(RequestListener* requests)>& simulate) {
    std::optional<RunResult> result;
    out_.replace(
        [&] {
            result.emplace(traced(config, simulate));
            write(config, *result);
        },
        files_of_earlier_run(out_, maps_, images_));
    return std::move(*result);
}

} // namespace degs::sim
