// SPDX-License-Identifier: Apache-2.0
// Runs of many configurations on many views, with everything shared that runs have in common.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "sim/process/child_process.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/study/compare_request.hpp"

namespace degs::sim {

struct SharedView;

/// One configuration on one view: its place in the request, and what it is called.
struct ViewRun {
    std::size_t scene = 0, size = 0, config = 0; ///< positions in the request
    int camera = 0;                              ///< position in the scene's list
    /// All frames are run, else the first one alone, which is the view before of consecutive ones.
    bool path = false;
    bool dynamic = false;      ///< the frames are those of a scene that changes
    std::size_t view = 0;      ///< number of the view, in the order in which they were begun
    std::string words, folder; ///< of the view: for people, and of its reports
    std::string name;          ///< of the run
    Stopwatch clock{};
};

/// What the owner of the runs is told and asked, during the calls of ViewRuns.
struct ViewRunsHooks {
    /// Whether a configuration is to run on a view; `words` and what follows are not known yet.
    /// Empty: all of them.
    std::function<bool(const ViewRun&)> wanted;
    /// The cameras of a scene are known, if they were not before.
    std::function<void(std::size_t cameras)> cameras_found;
    /// A run is over; its output is a message of RunSummary.
    std::function<void(const ViewRun& run, ChildOutcome&& outcome)> ended;
    /// A scene could not be loaded, or (the rest of) a view not be prepared. `lost` is the number
    /// of runs that are not made because of it.
    std::function<void(std::size_t scene, const Failure& failure, std::size_t lost)> scene_failed;
    std::function<void(const ViewRun& view, const Failure& failure, std::size_t lost)> view_failed;
    /// Called four times a second with the names of the runs that are running.
    std::function<void(const std::vector<std::string>& running)> tick;
};

/// Each run is a process of its own, as many at a time as the request allows; what this process
/// makes for them counts as one. Scenes, frames and reference images are made once and shared by
/// all runs that want them.
class ViewRuns {
public:
    /// `request` outlives this object.
    ViewRuns(const CompareRequest& request, ViewRunsHooks hooks);
    ~ViewRuns();
    ViewRuns(const ViewRuns&) = delete;
    ViewRuns& operator=(const ViewRuns&) = delete;

    /// Starts the runs of one scene of the request on these cameras, or on all that it has. False
    /// if Ctrl-C has come, and then no more runs are made.
    bool run_scene(std::size_t scene, const std::optional<std::vector<int>>& cameras);
    /// Waits for all runs; false after Ctrl-C.
    bool finish();
    /// Makes no more runs, as after Ctrl-C. For hooks.
    void stop() { pool_.stop(); }
    /// Runs of a view on which every configuration is wanted.
    std::size_t per_view() const;
    /// What a scene of the request is called beside the others.
    const std::string& label_of(std::size_t scene) const { return labels_[scene]; }
    /// A view of consecutive ones is a run of the view before alone, and one of both.
    static bool follows(const CompareRequest& request, std::size_t config, int camera);

private:
    using Configs = std::vector<std::size_t>;

    Scene load(const std::string& spec, double& seconds) const;
    Configs wanted_configs(const ViewRun& place) const;
    std::size_t runs_of(const ViewRun& place, const Configs& configs) const;
    Camera camera_at(const Scene& scene, const ImageSize& size, int position) const;
    std::vector<Camera> cameras_of(const Scene& scene, const ViewRun& place, bool stands_still,
                                   bool follows) const;
    void run_view(const Scene& scene, ViewRun place, double load_s);
    void run_group(SharedView& shared, const ViewRun& place, const Configs& configs);
    void start(const SharedView& shared, ViewRun run);
    void show(const std::vector<std::size_t>& running) const;

    const CompareRequest& request_;
    ViewRunsHooks hooks_;
    std::vector<std::string> labels_; ///< of the scenes
    std::size_t views_ = 0;           ///< begun
    std::vector<ViewRun> started_;
    bool interrupted_ = false;
    ChildPool pool_; ///< the last, because it calls back
};

/// A file name that any system accepts, for what users call things.
std::string file_name(const std::string& text);

} // namespace degs::sim
