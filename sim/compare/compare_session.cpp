// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/compare_session.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <tuple>

#include <nlohmann/json.hpp>

#include "scene/camera_path.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/report.hpp"
#include "sim/stopwatch.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

constexpr const char* kSlots = "slots.svg";
constexpr const char* kUtilization = "utilization.svg";

/// Fit for the name of a file on any system.
std::string file_name(const std::string& text) {
    std::string name = text;
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'; },
        '_');
    return name;
}

std::string bytes_of(const RunResult& result) {
    return report(result).dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

/// What frames depend on: format of the projection (empty for fp64, whose frames are the
/// reference's and come first), side of a tile, tile mode.
using FrameKind = std::tuple<std::string, int, TileMode>;

/// Configurations that want the same frames.
std::map<FrameKind, std::vector<std::size_t>> groups_of(const std::vector<NamedConfig>& configs) {
    std::map<FrameKind, std::vector<std::size_t>> groups;
    for (std::size_t c = 0; c < configs.size(); ++c) {
        const AcceleratorConfig& config = configs[c].config.accelerator();
        const NumberFormat projection = config.data_path().projection;
        groups[{projection.is_fp64() ? "" : projection.name(), config.tile_size_px(),
                config.tile_mode()}]
            .push_back(c);
    }
    return groups;
}

} // namespace

struct CompareSession::Shared {
    std::size_t number = 0; ///< of the view
    std::string words;      ///< for people
    std::string folder;     ///< of its reports, below the output folder
    int camera = 0;
    SceneFacts scene;
    const GaussianCloud* cloud = nullptr;
    std::vector<Camera> cameras; ///< of the path, the view's own first
    double load_s = 0, workload_s = 0;
    std::vector<FrameWorkload> frames;  ///< of the present group
    std::optional<Reference> reference; ///< of `reference_tiles`
    std::pair<int, TileMode> reference_tiles;

    /// With exact tiles the image does not depend on their size.
    void render_reference(TileMode mode) {
        const std::pair<int, TileMode> tiles{mode == TileMode::Exact ? 0 : frames.front().tile_size,
                                             mode};
        if (!reference || reference_tiles != tiles) {
            reference = make_reference(*cloud, frames.front(), workload_s);
            reference_tiles = tiles;
        }
    }

    /// In the child: the whole path or its first frame alone, which is compared with the reference.
    std::string run(const RunRequest& request, bool path) const {
        const Stopwatch wall;
        Progress::silence();
        std::vector<const FrameWorkload*> wanted;
        for (const FrameWorkload& frame : frames) {
            if (path || wanted.empty()) {
                wanted.push_back(&frame);
            }
        }
        RunResult result = run_frames(request, wanted);
        result.scene = scene;
        if (request.reference && !path) {
            judge(result, *reference);
        }
        result.host.load_s = load_s;
        result.host.workload_s = workload_s;
        result.host.wall_s = wall.seconds();
        return bytes_of(result);
    }
};

std::vector<std::string> comparison_files() {
    return {"compare.json", "compare.csv", kSlots, kUtilization};
}

Comparison CompareSession::run() {
    for (const std::string& spec : request_.scenes) {
        if (!interrupted_) {
            run_scene(spec);
        }
    }
    return comparison();
}

void CompareSession::run_scene(const std::string& spec) {
    try {
        const Stopwatch clock;
        Scene scene;
        {
            const Progress progress("loading " + spec);
            scene = load_scene(spec);
        }
        const double load_s = clock.seconds();
        std::vector<int> cameras = request_.cameras.value_or(std::vector<int>{});
        for (int c = 0; !request_.cameras && c < static_cast<int>(scene.cameras.size()); ++c) {
            cameras.push_back(c);
        }
        for (int camera : cameras) {
            for (const ImageSize& size : request_.sizes) {
                if (!interrupted_) {
                    run_view(scene, camera, size, load_s);
                }
            }
        }
    } catch (...) {
        fail("", spec, failure_of(std::current_exception()));
    }
}

void CompareSession::run_view(const Scene& scene, int camera, const ImageSize& size,
                              double load_s) {
    std::string words = scene.name + " · camera " + std::to_string(camera);
    try {
        const Camera first = resize(select_camera(scene, camera), size.width, size.height);
        words += " · " + std::to_string(first.width) + "×" + std::to_string(first.height);
        Shared shared;
        shared.number = views_++;
        shared.words = words;
        shared.folder = std::to_string(shared.number + 1) + "-" + file_name(scene.name) +
                        "-camera" + std::to_string(camera) + "-" + std::to_string(first.width) +
                        "x" + std::to_string(first.height);
        shared.camera = camera;
        shared.scene = facts_of(scene);
        shared.cloud = &scene.cloud;
        shared.cameras =
            camera_path(scene.cloud, first, request_.path.frames, request_.path.step_degrees);
        shared.load_s = load_s;
        for (const auto& [kind, configs] : groups_of(request_.configs)) {
            if (!interrupted_) {
                run_group(shared, configs);
            }
        }
    } catch (...) {
        fail("", words, failure_of(std::current_exception()));
    }
}

void CompareSession::run_group(Shared& shared, const Configs& configs) {
    const AcceleratorConfig& wish = request_.configs[configs.front()].config.accelerator();
    shared.frames.clear(); // before the next are made
    shared.workload_s = 0;
    shared.frames = make_workloads(*shared.cloud, shared.cameras, wish, shared.workload_s);
    if (request_.reference) {
        shared.render_reference(wish.tile_mode());
    }
    const std::vector<ChildJob> jobs = jobs_of(shared, configs);
    const std::size_t per_config = jobs.size() / configs.size();
    StatusLine line;
    const Stopwatch clock;
    ChildWatcher watcher;
    watcher.ended = [&](std::size_t job, ChildOutcome&& outcome) {
        take(shared, configs[job / per_config], job % per_config != 0, std::move(outcome));
        ++ended_;
    };
    watcher.tick = [&](std::size_t, const std::vector<std::size_t>& running) {
        if (!running.empty()) {
            line.show(std::to_string(ended_) + " runs done · " +
                      std::to_string(static_cast<long>(clock.seconds())) + " s · running " +
                      jobs[running.front()].name);
        }
    };
    interrupted_ = !run_children(jobs, request_.jobs, watcher);
    write();
}

std::vector<ChildJob> CompareSession::jobs_of(const Shared& shared, const Configs& configs) const {
    std::vector<ChildJob> jobs;
    for (std::size_t c : configs) {
        RunRequest request;
        request.config = request_.configs[c].config;
        request.build.array_only = request_.array_only;
        request.reference = request_.reference;
        const std::string name = request_.configs[c].name + ", " + shared.words;
        jobs.push_back({name, [request, &shared] { return shared.run(request, false); }});
        if (shared.frames.size() > 1) {
            request.reference = false;
            jobs.push_back({name + ", " + std::to_string(shared.frames.size()) + " frames",
                            [request, &shared] { return shared.run(request, true); }});
        }
    }
    return jobs;
}

void CompareSession::take(const Shared& shared, std::size_t config, bool path,
                          ChildOutcome&& outcome) {
    const std::string& name = request_.configs[config].name;
    if (outcome.failure) {
        fail(name, shared.words, *outcome.failure);
        return;
    }
    ordered_json report = ordered_json::parse(outcome.output);
    const OutputFolder folder(out_.path("reports/" + shared.folder), {});
    folder.write_json(std::to_string(config + 1) + "-" + file_name(name) +
                          (path ? "-path.json" : ".json"),
                      report);
    ComparedRun& run = runs_[{shared.number, config}];
    run.config = name;
    run.camera = shared.camera;
    (path ? run.path : run.frame) = std::move(report);
}

void CompareSession::fail(const std::string& config, const std::string& view,
                          const Failure& failure) {
    failed_.push_back({config, view, failure.sentence});
    failures_.push_back(failure);
}

Comparison CompareSession::comparison() const {
    std::vector<std::string> names;
    for (const NamedConfig& config : request_.configs) {
        names.push_back(config.name);
    }
    std::vector<ComparedRun> runs;
    for (const auto& [place, run] : runs_) {
        if (!run.frame.is_null()) { // a path alone has no latency to compare
            runs.push_back(run);
        }
    }
    Comparison result = compare(names, runs);
    result.failed = failed_;
    result.frames = request_.path.frames;
    result.path_step_degrees = request_.path.step_degrees;
    result.array_only = request_.array_only;
    return result;
}

void CompareSession::write() const {
    const Comparison now = comparison();
    out_.write_json("compare.json", comparison_json(now));
    out_.write_text("compare.csv", comparison_csv(now));
    for (const auto& [file, picture] : {std::pair(kSlots, slots_picture(now)),
                                        std::pair(kUtilization, utilization_picture(now))}) {
        std::error_code ignored;
        if (picture.empty()) { // one of an earlier comparison would mislead
            std::filesystem::remove(out_.path(file), ignored);
        } else {
            out_.write_text(file, picture);
        }
    }
}

std::optional<Failure> CompareSession::failure() const {
    if (interrupted_) {
        return Failure{kInterrupted, "Interrupted after " + std::to_string(ended_) +
                                         " runs; what they found is in '" + out_.path("") + "'."};
    }
    if (failures_.empty()) {
        return {};
    }
    Failure worst = failures_.front();
    for (const Failure& failure : failures_) {
        worst = failure.code == kInternalError && worst.code != kInternalError ? failure : worst;
    }
    if (failures_.size() > 1) {
        worst.sentence = std::to_string(failures_.size()) +
                         " parts of the comparison failed, one of them with: " + worst.sentence;
    }
    return worst;
}

} // namespace degs::sim
