// SPDX-License-Identifier: Apache-2.0
#include "sim/runs/view_runs.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

#include "sim/runs/shared_view.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/simulation/simulation.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/frame_kind.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"
#include "sim/view/workloads.hpp"

namespace degs::sim {
namespace {

// Bytes that the simulations of a group keep for each other: half of a 4K frame and more.
constexpr std::size_t kMostKept = std::size_t{1} << 30U;

bool shares_colours(const AcceleratorConfig& config, int views) {
    return views > 1 && config.view_sharing() == ViewSharing::Colour;
}

/// What configurations have in common that share frames: their kind, whether views share colours,
/// and whether they follow the frames of the view before.
using GroupKind = std::tuple<FrameKind, bool, bool>;

bool follows_in(const GroupKind& kind) {
    return std::get<2>(kind);
}

std::map<GroupKind, std::vector<std::size_t>> groups_of(const CompareRequest& request,
                                                        const std::vector<std::size_t>& configs,
                                                        const SceneTraits& traits, int camera) {
    std::map<GroupKind, std::vector<std::size_t>> groups;
    for (const std::size_t c : configs) {
        const AcceleratorConfig& design = request.configs[c].config.accelerator();
        const bool shared = shares_colours(design, request.path.group.images());
        groups[{frame_kind(design, traits), shared, ViewRuns::follows(request, c, camera)}]
            .push_back(c);
    }
    return groups;
}

} // namespace

std::string file_name(const std::string& text) {
    constexpr std::size_t kLongest = 80; // systems hold 255 bytes, and files get endings
    std::string name = text.substr(0, kLongest);
    std::replace_if(
        name.begin(), name.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_' && c != '.'; },
        '_');
    return name;
}

ViewRuns::ViewRuns(const CompareRequest& request, ViewRunsHooks hooks)
    : request_(request), hooks_(std::move(hooks)), labels_(scene_labels(request.scenes)),
      pool_(request.jobs,
            {[this](std::size_t run, ChildOutcome&& outcome) {
                 hooks_.ended(started_[run], std::move(outcome));
             },
             [this](std::size_t, const std::vector<std::size_t>& running) { show(running); }}) {}

ViewRuns::~ViewRuns() = default;

std::size_t ViewRuns::per_view() const {
    return request_.configs.size() * (request_.path.frames > 1 ? 2 : 1);
}

Scene ViewRuns::load(const std::string& spec, double& seconds) const {
    const Progress progress("loading " + spec);
    const Stopwatch clock;
    Scene scene = load_scene(spec, request_.camera_file);
    if (!request_.views.empty()) {
        scene.cameras = request_.views;
    }
    seconds = clock.seconds();
    return scene;
}

bool ViewRuns::run_scene(std::size_t scene, const std::optional<std::vector<int>>& cameras) {
    if (interrupted_ || !pool_.make_room()) {
        interrupted_ = true;
        return false;
    }
    ViewRun place;
    place.scene = scene;
    Scene loaded;
    double load_s = 0;
    try {
        loaded = load(request_.scenes[scene], load_s);
    } catch (...) {
        hooks_.scene_failed(scene, failure_of(std::current_exception()),
                            cameras ? cameras->size() * request_.sizes.size() * per_view() : 0);
        return true;
    }
    std::vector<int> all = cameras.value_or(std::vector<int>{});
    for (int c = 0; !cameras && c < static_cast<int>(loaded.cameras.size()); ++c) {
        all.push_back(c);
    }
    if (!cameras && hooks_.cameras_found) {
        hooks_.cameras_found(all.size());
    }
    for (int camera : all) {
        for (std::size_t size = 0; size < request_.sizes.size() && !interrupted_; ++size) {
            place.camera = camera;
            place.size = size;
            run_view(loaded, place, load_s);
        }
    }
    return !interrupted_;
}

bool ViewRuns::finish() {
    interrupted_ = interrupted_ || !pool_.finish();
    return !interrupted_;
}

ViewRuns::Configs ViewRuns::wanted_configs(const ViewRun& place) const {
    Configs configs;
    ViewRun asked = place;
    for (asked.config = 0; asked.config < request_.configs.size(); ++asked.config) {
        if (!hooks_.wanted || hooks_.wanted(asked)) {
            configs.push_back(asked.config);
        }
    }
    return configs;
}

bool ViewRuns::follows(const CompareRequest& request, std::size_t config, int camera) {
    return request.consecutive && camera > 0 && !request.analytic &&
           request.configs[config].config.accelerator().keeps_lists();
}

std::size_t ViewRuns::runs_of(const ViewRun& place, const Configs& configs) const {
    std::size_t runs = 0;
    for (const std::size_t config : configs) {
        runs += request_.path.frames > 1 || follows(request_, config, place.camera) ? 2 : 1;
    }
    return runs;
}

Camera ViewRuns::camera_at(const Scene& scene, const ImageSize& size, int position) const {
    return resize_and_crop(select_camera(scene, position), size.width, size.height, request_.crop);
}

std::vector<Camera> ViewRuns::cameras_of(const Scene& scene, const ViewRun& place,
                                         bool stands_still, bool follows) const {
    PathSource source;
    source.camera_at = [this, &scene, &place](int position) {
        return camera_at(scene, request_.sizes[place.size], position);
    };
    source.cloud = [&scene]() -> const GaussianCloud& { return scene.cloud; };
    source.stands_still = stands_still;
    PathRequest path = request_.path;
    path.near_plane = nearest_plane(request_.configs);
    std::vector<Camera> cameras;
    for (int camera = follows ? place.camera - 1 : place.camera; camera <= place.camera; ++camera) {
        source.camera = camera;
        const std::vector<Camera> frames = cameras_of_frames(path, source);
        cameras.insert(cameras.end(), frames.begin(), frames.end());
    }
    return cameras;
}

void ViewRuns::run_view(const Scene& scene, ViewRun place, double load_s) {
    const Configs configs = wanted_configs(place);
    if (configs.empty()) {
        return;
    }
    place.words = labels_[place.scene] + " · camera " + std::to_string(place.camera);
    const std::size_t before = started_.size();
    try {
        const ImageSize& size = request_.sizes[place.size];
        const Camera first = camera_at(scene, size, place.camera);
        const int views = request_.path.group.images();
        place.words += " · " + (views > 1 ? std::to_string(views) + " × " : std::string()) +
                       std::to_string(first.width) + "×" + std::to_string(first.height);
        place.view = views_++;
        place.folder = std::to_string(place.view + 1) + "-" + file_name(scene.name) + "-camera" +
                       std::to_string(place.camera) + "-" + std::to_string(first.width) + "x" +
                       std::to_string(first.height);
        SharedView shared;
        shared.camera = place.camera;
        shared.scene = facts_of(scene);
        shared.cloud = &scene.cloud;
        if (request_.path.frames > 1) {
            shared.dynamic = open_dynamic_scene(request_.scenes[place.scene]);
        }
        shared.views = views;
        place.dynamic = shared.dynamic != nullptr;
        shared.load_s = load_s;
        for (const auto& [kind, members] :
             groups_of(request_, configs, scene.traits, place.camera)) {
            if (!interrupted_) {
                shared.cameras = cameras_of(scene, place, place.dynamic, follows_in(kind));
                run_group(shared, place, members);
            }
        }
    } catch (...) {
        hooks_.view_failed(place, failure_of(std::current_exception()),
                           runs_of(place, configs) - (started_.size() - before));
    }
}

void ViewRuns::run_group(SharedView& shared, const ViewRun& place, const Configs& configs) {
    if (!pool_.make_room()) { // making frames is work, too
        interrupted_ = true;
        return;
    }
    const AcceleratorConfig& wish = request_.configs[configs.front()].config.accelerator();
    shared.frames.clear(); // before the next are made; children have copies of their own
    shared.kept = nullptr;
    shared.workload_s = 0;
    shared.frames = shared.dynamic
                        ? make_workloads(*shared.dynamic, shared.scene.traits, shared.cameras, wish,
                                         shared.workload_s, shared.views)
                        : make_workloads(*shared.cloud, shared.scene.traits, shared.cameras, wish,
                                         shared.workload_s);
    if (request_.reference && !request_.sampling) {
        shared.render_references();
    }
    if (shares_colours(wish, shared.views)) { // the references have the colours of each view
        shared.share_colours();
    }
    if (configs.size() > 1 && !request_.analytic) {
        shared.kept = std::make_unique<SharedBytes>(kMostKept);
    }
    for (std::size_t config : configs) {
        ViewRun run = place;
        run.config = config;
        start(shared, run);
        if (shared.frames_of_path() > 1) {
            run.path = true;
            start(shared, run);
        }
    }
}

void ViewRuns::start(const SharedView& shared, ViewRun run) {
    if (interrupted_ || !pool_.make_room()) {
        interrupted_ = true;
        return;
    }
    RunRequest request;
    request.config = request_.configs[run.config].config;
    request.build.array_only = request_.array_only;
    request.build.kept = shared.kept.get();
    request.reference = request_.reference && !run.path && !request_.sampling;
    request.sampling = request_.sampling;
    request.views = shared.views;
    run.name = request_.configs[run.config].name + ", " + run.words;
    if (run.path) {
        run.name += ", " + std::to_string(shared.frames_of_path()) + " frames";
    }
    const bool path = run.path;
    run.clock = Stopwatch();
    started_.push_back(std::move(run));
    const bool analytic = request_.analytic;
    interrupted_ = !pool_.start({started_.back().name, [&request, &shared, path, analytic] {
                                     return analytic ? shared.estimate(request.config)
                                                     : shared.run(request, path);
                                 }});
}

void ViewRuns::show(const std::vector<std::size_t>& running) const {
    std::vector<std::string> names;
    names.reserve(running.size());
    for (std::size_t run : running) {
        names.push_back(started_[run].name);
    }
    if (!names.empty() && hooks_.tick) {
        hooks_.tick(names);
    }
}

} // namespace degs::sim
