// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/compare_session.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <tuple>

#include <nlohmann/json.hpp>

#include "scene/camera_path.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/compare/shared_view.hpp"
#include "sim/process/interruption.hpp"
#include "sim/stopwatch.hpp"

namespace degs::sim {
namespace {

constexpr const char* kSlots = "slots.svg";
constexpr const char* kUtilization = "utilization.svg";

/// A file name that any system accepts; the numbers in front of the names keep them apart.
std::string file_name(const std::string& text) {
    constexpr std::size_t kLongest = 80; // systems hold 255 bytes, and files get endings
    std::string name = text.substr(0, kLongest);
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'; },
        '_');
    return name;
}

/// Frames depend on these: the format of the projection (empty for fp64, whose frames are the
/// reference's and come first), the side of a tile and the tile mode.
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

/// A run whose child has been started.
struct CompareSession::Started {
    std::size_t view = 0;
    std::size_t config = 0; ///< position in the request
    bool path = false;
    int camera = 0;
    std::string words, folder; ///< of the view
    std::string name;          ///< of the run
    Stopwatch clock{};
};

std::vector<std::string> comparison_files() {
    return {"compare.json", "compare.csv", kSlots, kUtilization};
}

CompareSession::CompareSession(const CompareRequest& request, const OutputFolder& out)
    : request_(request), out_(out),
      pool_(request.jobs,
            {[this](std::size_t run, ChildOutcome&& outcome) { end(run, std::move(outcome)); },
             [this](std::size_t, const std::vector<std::size_t>& running) { show(running); }}) {}

CompareSession::~CompareSession() = default;

Comparison CompareSession::run() {
    const std::size_t scenes = request_.scenes.size();
    if (request_.cameras) {
        progress_.plan(scenes * request_.cameras->size() * runs_per_camera());
    }
    for (std::size_t s = 0; s < scenes && !interrupted_; ++s) {
        progress_.set_unknown_scenes(request_.cameras ? 0 : scenes - s - 1);
        run_scene(request_.scenes[s]);
    }
    interrupted_ = interrupted_ || !pool_.finish();
    if (!found_.empty()) {
        write(); // with failures that came after the last run
    }
    return comparison();
}

std::size_t CompareSession::runs_per_view() const {
    return request_.configs.size() * (request_.path.frames > 1 ? 2 : 1);
}

std::size_t CompareSession::runs_per_camera() const {
    return request_.sizes.size() * runs_per_view();
}

Scene CompareSession::load(const std::string& spec, double& seconds) const {
    const Progress progress("loading " + spec);
    const Stopwatch clock;
    Scene scene = load_scene(spec, request_.camera_file);
    seconds = clock.seconds();
    return scene;
}

void CompareSession::run_scene(const std::string& spec) {
    if (!pool_.make_room()) {
        interrupted_ = true;
        return;
    }
    Scene scene;
    double load_s = 0;
    try {
        scene = load(spec, load_s);
    } catch (...) {
        fail("", spec, failure_of(std::current_exception()));
        progress_.drop(request_.cameras ? request_.cameras->size() * runs_per_camera() : 0);
        return;
    }
    std::vector<int> cameras = request_.cameras.value_or(std::vector<int>{});
    for (int c = 0; !request_.cameras && c < int(scene.cameras.size()); ++c) {
        cameras.push_back(c);
        progress_.plan(runs_per_camera());
    }
    for (int camera : cameras) {
        for (const ImageSize& size : request_.sizes) {
            if (!interrupted_) {
                run_view(scene, camera, size, load_s);
            }
        }
    }
}

void CompareSession::run_view(const Scene& scene, int camera, const ImageSize& size,
                              double load_s) {
    std::string words = scene.name + " · camera " + std::to_string(camera);
    const std::size_t before = started_.size();
    try {
        const Camera first = resize(select_camera(scene, camera), size.width, size.height);
        words += " · " + std::to_string(first.width) + "×" + std::to_string(first.height);
        SharedView shared;
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
        progress_.drop(runs_per_view() - (started_.size() - before));
    }
}

void CompareSession::run_group(SharedView& shared, const Configs& configs) {
    if (!pool_.make_room()) { // making frames is work, too
        interrupted_ = true;
        return;
    }
    const AcceleratorConfig& wish = request_.configs[configs.front()].config.accelerator();
    shared.frames.clear(); // before the next are made; children have copies of their own
    shared.workload_s = 0;
    shared.frames = make_workloads(*shared.cloud, shared.cameras, wish, shared.workload_s);
    if (request_.reference) {
        shared.render_reference(wish.tile_mode());
    }
    for (std::size_t config : configs) {
        start(shared, config, false);
        if (shared.frames.size() > 1) {
            start(shared, config, true);
        }
    }
}

void CompareSession::start(const SharedView& shared, std::size_t config, bool path) {
    if (interrupted_ || !pool_.make_room()) {
        interrupted_ = true;
        return;
    }
    RunRequest request;
    request.config = request_.configs[config].config;
    request.build.array_only = request_.array_only;
    request.reference = request_.reference && !path;
    std::string name = request_.configs[config].name + ", " + shared.words;
    if (path) {
        name += ", " + std::to_string(shared.frames.size()) + " frames";
    }
    started_.push_back(
        {shared.number, config, path, shared.camera, shared.words, shared.folder, name});
    interrupted_ =
        !pool_.start({name, [&request, &shared, path] { return shared.run(request, path); }});
}

void CompareSession::end(std::size_t number, ChildOutcome&& outcome) {
    const Started& run = started_[number];
    const bool good = !outcome.failure;
    try {
        take(run, std::move(outcome));
        if (!found_.empty()) {
            write();
        }
    } catch (...) {
        fail(request_.configs[run.config].name, run.words, failure_of(std::current_exception()));
    }
    progress_.ended(run.name, run.clock.seconds(), good);
    set_interruption_sentence(interruption().sentence);
}

void CompareSession::show(const std::vector<std::size_t>& running) {
    std::vector<std::string> names;
    names.reserve(running.size());
    for (std::size_t run : running) {
        names.push_back(started_[run].name);
    }
    if (!names.empty()) {
        progress_.show(names);
    }
}

void CompareSession::take(const Started& started, ChildOutcome&& outcome) {
    const std::string& name = request_.configs[started.config].name;
    if (outcome.failure) {
        fail(name, started.words, *outcome.failure);
        return;
    }
    RunSummary summary = summary_from(outcome.output);
    const OutputFolder folder(out_.path("reports/" + started.folder), {});
    folder.write_text(std::to_string(started.config + 1) + "-" + file_name(name) +
                          (started.path ? "-path.json" : ".json"),
                      summary.report);
    summary.report.clear();
    for (const std::string& sentence : summary.warnings) {
        std::string warning = name;
        warning.append(": ").append(sentence);
        if (std::find(warnings_.begin(), warnings_.end(), warning) == warnings_.end()) {
            warnings_.push_back(warning);
        }
    }
    Found& found = found_[{started.view, started.config}];
    (started.path ? found.path : found.frame) = std::move(summary);
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
    for (const auto& [place, found] : found_) {
        if (found.frame) { // a path alone has no latency to compare
            runs.push_back({names[place.second], *found.frame, found.path});
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

Failure CompareSession::interruption() const {
    return {kInterrupted,
            "Interrupted after " + progress_.words() +
                (found_.empty() ? "." : "; what they found is in '" + out_.path("") + "'.")};
}

std::optional<Failure> CompareSession::failure() const {
    if (interrupted_) {
        return interruption();
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
