// SPDX-License-Identifier: Apache-2.0
#include "sim/study/compare_request.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <numeric>
#include <utility>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "scene/scene.hpp"
#include "sim/analytic/analytic_run.hpp"
#include "sim/command_line/combinations.hpp"
#include "sim/study/addressed_overrides.hpp"
#include "sim/text/comma_parts.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

struct Named {
    std::string name, file;
};

/// A '=' may belong to the name of an existing file.
Named named(const std::string& word) {
    const std::size_t at = word.find('=');
    std::error_code ignored;
    if (at == std::string::npos || fs::exists(word, ignored)) {
        return {fs::path(word).stem().string(), word};
    }
    return {word.substr(0, at), word.substr(at + 1)};
}

/// The first key in which the views of two studies differ; empty if there is none.
std::string first_difference(const StudyViews& a, const StudyViews& b) {
    const std::pair<const char*, bool> keys[] = {
        {"scenes", a.scenes == b.scenes},
        {"cameras", a.cameras == b.cameras},
        {"camera_file", a.camera_file == b.camera_file},
        {"resolutions", a.resolutions == b.resolutions},
        {"width", a.width == b.width},
        {"crop", a.crop == b.crop},
        {"eyes", a.path.group.eyes_m == b.path.group.eyes_m},
        {"units_per_metre", a.path.group.units_per_metre == b.path.group.units_per_metre},
        {"views", a.path.group.cameras == b.path.group.cameras},
        {"frames", a.path.frames == b.path.frames},
        {"path_step", a.path.step_degrees == b.path.step_degrees},
        {"fidelity", a.analytic == b.analytic},
        {"array_only", a.array_only == b.array_only},
        {"reference", a.reference == b.reference}};
    for (const auto& [key, same] : keys) {
        if (!same) {
            return key;
        }
    }
    return "";
}

/// Throws InputError if two studies say different things of the views.
void check_same_views(const std::string& first, const StudyViews& a, const std::string& second,
                      const StudyViews& b) {
    const std::string key = first_difference(a, b);
    if (!key.empty()) {
        throw InputError("The studies " + config_words::quote(first) + " and " +
                         config_words::quote(second) + " differ in " + config_words::quote(key) +
                         ", so they cannot be compared on the same views; compare them one by "
                         "one, or give both the same value.");
    }
}

/// Configurations before they are loaded.
struct Drafts {
    std::vector<StudyDesign> designs;
    StudyViews views;
    std::string study; ///< the file that says the views; empty: none

    /// Each design of a study is a configuration of its own.
    void add(const std::string& word, bool quick) {
        const Named file = named(word);
        const ConfigNode tree = ConfigSource::from_file(file.file).tree();
        if (!is_study(tree)) {
            designs.push_back({file.name, tree});
            return;
        }
        check_designs_only(tree);
        for (StudyDesign& design : read_designs(tree)) {
            designs.push_back(std::move(design));
        }
        const StudyViews own = read_study_views(tree, file.file, quick);
        if (!study.empty()) {
            check_same_views(study, views, file.file, own);
        }
        study = file.file;
        views = own;
    }
};

void check_names(const std::vector<StudyDesign>& drafts) {
    for (const StudyDesign& draft : drafts) {
        const auto same = [&draft](const StudyDesign& other) { return other.name == draft.name; };
        if (std::count_if(drafts.begin(), drafts.end(), same) > 1) {
            throw InputError("Two configurations are called " + config_words::quote(draft.name) +
                             "; NAME=FILE keeps them apart.");
        }
    }
}

} // namespace

void check_scenes(const std::vector<std::string>& scenes) {
    for (auto scene = scenes.begin(); scene != scenes.end(); ++scene) {
        if (scene->empty()) {
            throw InputError("The scene has an empty name; a file or synthetic:NAME is needed.");
        }
        if (std::find(scenes.begin(), scene, *scene) != scene) {
            throw InputError("The scene '" + *scene + "' is given twice.");
        }
    }
}

std::optional<SamplingRequest> sampling_for_runs(const std::optional<std::string>& within,
                                                 std::uint64_t seed) {
    return sampling_of("exact", within, seed);
}

LoadedConfigs load_compared(const std::vector<std::string>& words,
                            const std::vector<std::string>& overrides, bool quick,
                            const std::string& memory) {
    Drafts drafts;
    for (const std::string& word : words) {
        if (named(word).name.empty()) {
            throw InputError("The configuration '" + word +
                             "' has an empty name; FILE or NAME=FILE is needed.");
        }
        drafts.add(word, quick);
    }
    if (quick && drafts.study.empty()) {
        throw InputError("--quick needs a study with a section 'quick'.");
    }
    check_names(drafts.designs);
    std::vector<std::string> names;
    names.reserve(drafts.designs.size());
    for (const StudyDesign& draft : drafts.designs) {
        names.push_back(draft.name);
    }
    check_addressees(overrides, names);
    LoadedConfigs loaded;
    loaded.views = drafts.views;
    loaded.study = drafts.study;
    for (StudyDesign& draft : drafts.designs) {
        put_memory(draft.tree, memory);
        loaded.configs.push_back(
            {draft.name, load_run_config(ConfigSource::from_tree(
                             draft.tree, overrides_of(draft.name, overrides)))});
    }
    return loaded;
}

std::vector<NamedConfig> load_configs(const std::vector<std::string>& words,
                                      const std::vector<std::string>& overrides,
                                      const std::string& memory) {
    LoadedConfigs loaded = load_compared(words, overrides, false, memory);
    const std::string key = first_difference(StudyViews(), loaded.views);
    if (!key.empty()) {
        throw InputError(loaded.study + ": key " + config_words::quote(key) +
                         " of a study is for 'degs sweep' and 'degs compare'; this command takes "
                         "its views from its options.");
    }
    return std::move(loaded.configs);
}

void put_views(const StudyViews& views, CompareRequest& request) {
    if (views.scenes.empty()) {
        throw InputError(
            "The command names no scene: --scene is needed, or a study with 'scenes'.");
    }
    check_scenes(views.scenes);
    check_positive("--width", views.width);
    if (!views.crop.empty()) {
        crop_of(views.crop);
    }
    request.scenes = views.scenes;
    request.camera_file = views.camera_file;
    request.cameras = parse_cameras(views.cameras);
    if (views.resolutions.empty()) {
        request.sizes = {ImageSize{views.width, {}}};
    } else {
        request.sizes = parse_resolutions(views.resolutions);
    }
    if (!views.crop.empty() && request.sizes.size() > 1) {
        throw InputError("A crop (--crop, or 'crop' of a study) has pixels of images in one size, "
                         "but several resolutions are asked for.");
    }
    request.crop = views.crop;
    request.path = views.path;
    if (!views.path.group.cameras.empty()) { // they are one view of the study
        request.cameras = {views.path.group.cameras.front()};
    }
    request.analytic = views.analytic;
    request.array_only = views.array_only;
    request.reference = views.reference && !views.analytic;
}

bool is_analytic(const std::string& fidelity) {
    if (fidelity != "exact" && fidelity != "analytic") {
        throw InputError("--fidelity is '" + fidelity +
                         "', but must be exact or analytic in commands that run several designs; "
                         "--within asks for samples of the tiles.");
    }
    return fidelity == "analytic";
}

void check_combinations(const CompareRequest& request) {
    const GroupRequest& group = request.path.group;
    const std::map<std::string, OptionState> states{
        {"--frames",
         {request.path.frames > 1, std::to_string(request.path.frames), "or 'frames' of a study"}},
        {"--eyes", {group.eyes_m.has_value(), "", "or 'eyes' of a study"}},
        {"--views", {!group.cameras.empty(), "", "or 'views' of a study"}},
        {"--array-only", {request.array_only, "", "or 'array_only' of a study"}},
        {"--within", {request.sampling.has_value()}},
        {"--fidelity",
         {request.analytic, request.analytic ? "analytic" : "exact", "or 'fidelity' of a study"}}};
    refuse_combinations("degs compare",
                        rules_of("compare", [](const std::string&) { return true; }),
                        [&states](const std::string& option) {
                            const auto found = states.find(option);
                            return found == states.end() ? OptionState() : found->second;
                        });
}

void check_estimates(const CompareRequest& request) {
    check_combinations(request);
    for (const NamedConfig& named : request.configs) {
        if (request.analytic) {
            analytic_model_of(named.config);
        }
    }
}

std::vector<std::vector<int>> cameras_by_scene(const CompareRequest& request) {
    std::vector<std::vector<int>> cameras;
    for (const std::string& scene : request.scenes) {
        const int count = static_cast<int>(camera_count(scene, request.camera_file));
        std::vector<int> all(count);
        std::iota(all.begin(), all.end(), 0);
        cameras.push_back(request.cameras.value_or(all));
        std::vector<int> asked = cameras.back();
        asked.insert(asked.end(), request.path.group.cameras.begin(),
                     request.path.group.cameras.end());
        for (const int camera : asked) {
            if (camera >= count) {
                throw InputError("Camera " + std::to_string(camera) + " does not exist: scene '" +
                                 scene + "' has " + std::to_string(count) +
                                 " camera(s), numbered from 0.");
            }
        }
    }
    return cameras;
}

double nearest_plane(const std::vector<NamedConfig>& configs) {
    double nearest = kFarthestNearPlane;
    for (const NamedConfig& named : configs) {
        nearest = std::min(nearest, named.config.accelerator().data_path().rules.near);
    }
    return nearest;
}

std::optional<std::vector<int>> parse_cameras(const std::string& text) {
    if (text == "all") {
        return {};
    }
    std::vector<int> cameras;
    for (const std::string& part : comma_parts(text)) {
        const std::optional<int> position = camera_position(part);
        if (!position) {
            throw InputError("--camera is '" + text +
                             "', but must be 'all' or positions in the scene's list of cameras, "
                             "from 0 and separated by commas; a file of cameras is named by "
                             "--camera-file.");
        }
        cameras.push_back(*position);
        if (std::count(cameras.begin(), cameras.end(), cameras.back()) > 1) {
            throw InputError("Camera " + part + " is given twice.");
        }
    }
    return cameras;
}

std::vector<ImageSize> parse_resolutions(const std::string& text) {
    std::vector<ImageSize> sizes;
    for (const std::string& part : comma_parts(text)) {
        const ImageSize wanted = image_size(part);
        for (const ImageSize& size : sizes) {
            if (size.width == wanted.width && size.height == wanted.height) {
                throw InputError("The resolution '" + part + "' is given twice.");
            }
        }
        sizes.push_back(wanted);
    }
    return sizes;
}

} // namespace degs::sim
