// SPDX-License-Identifier: Apache-2.0
// The request of `degs compare`, checked before anything long starts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/design/run_config.hpp"
#include "sim/sampling/sampling_request.hpp"
#include "sim/study/study_file.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {

struct NamedConfig {
    std::string name; ///< what the user calls it
    RunConfig config;
};

struct CompareRequest {
    std::vector<NamedConfig> configs; ///< the others are compared with the first
    std::vector<std::string> scenes;
    std::string camera_file;   ///< empty: the scenes' own
    std::vector<Camera> views; ///< in place of the scenes' cameras; empty: none
    bool consecutive = false;  ///< designs that keep lists render the view before, too
    std::optional<std::vector<int>> cameras; ///< positions in each scene's list; empty: all
    std::vector<ImageSize> sizes{ImageSize{}};
    std::string crop; ///< see crop_of(); empty: all of the images
    PathRequest path;
    bool analytic = false; ///< estimates in place of simulations
    bool array_only = false;
    bool reference = true;                   ///< of simulations of all tiles
    std::optional<SamplingRequest> sampling; ///< of single frames
    int jobs = 1;                            ///< simulations at a time
};

/// Configurations, and what the studies among their files say of views.
struct LoadedConfigs {
    std::vector<NamedConfig> configs;
    StudyViews views;
    std::string study; ///< the file that says the views; empty: none
};

/// Loads configurations, each written as FILE or NAME=FILE; without a name it is called like
/// the file without folder and extension. A file with a list `points` is a study: every
/// point is a configuration, called by its key `name`, and its views count, or with `quick` those
/// of its section 'quick'; several studies must have the same ones. An override is "path=value" for
/// all or "NAME:path=value" for one; `memory` is a file for put_memory() of all. Throws InputError
/// for every mistake, also for a name that is empty, unknown or given twice.
LoadedConfigs load_compared(const std::vector<std::string>& words,
                            const std::vector<std::string>& overrides, bool quick = false,
                            const std::string& memory = "");

/// Loads configurations for commands that have views of their own: InputError for a study that says
/// something of views.
std::vector<NamedConfig> load_configs(const std::vector<std::string>& words,
                                      const std::vector<std::string>& overrides,
                                      const std::string& memory = "");

/// Takes the views into the request. Throws InputError if there is no scene, and for mistakes in
/// what they say.
void put_views(const StudyViews& views, CompareRequest& request);

/// The cameras of each scene of the request, in its order. Throws InputError if one of them cannot
/// be opened or does not have a camera that is asked for.
std::vector<std::vector<int>> cameras_by_scene(const CompareRequest& request);

/// Scene units: all designs see the same camera path, which turns about what the one with the
/// nearest plane sees.
double nearest_plane(const std::vector<NamedConfig>& configs);

/// "0,1,2" or "all", which is empty. Throws InputError for anything else and for a number given
/// twice.
std::optional<std::vector<int>> parse_cameras(const std::string& text);

/// "1080p,2064x2208", see image_size(). Throws InputError for a mistake and a size given twice.
std::vector<ImageSize> parse_resolutions(const std::string& text);

/// What --within asks for in commands that run several designs. Throws InputError for a mistake.
std::optional<SamplingRequest> sampling_for_runs(const std::optional<std::string>& within,
                                                 std::uint64_t seed);

/// Whether --fidelity asks for estimates of the analytic model; else for simulations of all tiles.
/// Throws InputError for any other word.
bool is_analytic(const std::string& fidelity);

/// Throws InputError if what a study and the options ask for breaks a rule of the options.
void check_combinations(const CompareRequest& request);

/// Throws InputError like check_combinations(), and if estimates are asked for of a design whose
/// accelerator has no analytic model.
void check_estimates(const CompareRequest& request);

/// Throws InputError for a scene without a name and for one that is given twice.
void check_scenes(const std::vector<std::string>& scenes);

} // namespace degs::sim
