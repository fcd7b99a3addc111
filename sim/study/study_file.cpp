// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study_file.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "config/config_scalar.hpp"
#include "config/config_source.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/study/compare_request.hpp"
#include "sim/study/study_keys.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;
using config_words::quote;
using Kind = ConfigNode::Kind;

/// The names of the keys for which `wanted` holds.
template <class Wanted>
std::vector<std::string> names_of(const Wanted& wanted) {
    std::vector<std::string> names;
    for (const StudyKey& key : study_keys()) {
        if (wanted(key)) {
            names.emplace_back(key.name);
        }
    }
    return names;
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

void check_top_keys(const ConfigNode& tree) {
    const std::vector<std::string> known = names_of([](const StudyKey&) { return true; });
    for (const ConfigNode& key : tree.children) {
        if (!is_among(known, key.key)) {
            const std::string near = config_words::nearest(key.key, known);
            throw InputError(key.place + ": unknown key " + quote(key.key) +
                             (near.empty() ? "" : ", did you mean " + quote(near) + "?") +
                             " (a study has the keys " + config_words::list(known) + ").");
        }
    }
}

const ConfigNode* list_of_designs(const ConfigNode& tree) {
    const ConfigNode* points = tree.find("points");
    const ConfigNode* designs = tree.find("designs");
    if (points != nullptr && designs != nullptr) {
        throw InputError(designs->place + ": 'designs' and 'points' mean the same list; give one.");
    }
    return designs != nullptr ? designs : points;
}

template <class Kind, class Value>
void take(const ConfigNode& tree, const char* key, const Kind& kind, Value& value) {
    if (const ConfigNode* node = tree.find(key)) {
        value = config_scalar::value_of(kind, *node, key);
    }
}

std::int64_t taken_integer(const ConfigNode& tree, const char* name, std::int64_t otherwise) {
    const StudyKey& key = study_key(name);
    const auto low = static_cast<std::int64_t>(key.low);
    take(tree, name, config_scalar::Integer{low, static_cast<std::int64_t>(key.high)}, otherwise);
    return otherwise;
}

double taken_real(const ConfigNode& tree, const char* name, double otherwise) {
    const StudyKey& key = study_key(name);
    take(tree, name, config_scalar::Real{key.low, key.high}, otherwise);
    return otherwise;
}

/// Whether a choice between two words is the second.
bool takes_second(const ConfigNode& tree, const char* name) {
    int choice = 0;
    take(tree, name, config_scalar::Choice{study_key(name).words}, choice);
    return choice == 1;
}

/// A scalar or a list of scalars.
std::vector<std::string> words_of(const ConfigNode& node) {
    std::vector<std::string> words;
    if (node.kind == Kind::kScalar) {
        words.push_back(node.text);
    }
    for (const ConfigNode& item : node.children) {
        if (node.kind == Kind::kList && item.kind == Kind::kScalar) {
            words.push_back(item.text);
        }
    }
    if (words.empty() || words.size() < node.children.size()) {
        throw InputError(node.place + ": key " + quote(node.key) +
                         " must be a word or a list of words.");
    }
    return words;
}

std::string joined_words(const ConfigNode& node) {
    std::string text;
    for (const std::string& word : words_of(node)) {
        text += (text.empty() ? "" : ",") + word;
    }
    return text;
}

/// What `check` finds wrong in the value of a key, with the place of the key.
template <class Check>
void check_at(const ConfigNode& node, const Check& check) {
    try {
        check();
    } catch (const InputError& wrong) {
        throw InputError(node.place + ": key " + quote(node.key) + ": " + wrong.what());
    }
}

/// `name` relative to the study, unless it stands on its own.
std::string beside(const fs::path& folder, const std::string& name) {
    const bool own = name.empty() || name.rfind("synthetic:", 0) == 0;
    return own ? name : (folder / name).lexically_normal().string();
}

/// Eyes, or positions of cameras that are the views of one frame.
void read_group(const ConfigNode& tree, GroupRequest& group) {
    const ConfigNode* const views = tree.find("views");
    if (tree.find("cameras") != nullptr || tree.find("eyes") != nullptr) {
        group.cameras.clear(); // those of the study, if this is its section 'quick'
    }
    if (tree.find("eyes") != nullptr) {
        group.eyes_m = taken_real(tree, "eyes", 0);
    }
    if (views != nullptr) {
        for (const char* other : {"cameras", "eyes", "path_step"}) {
            if (tree.find(other) != nullptr) {
                throw InputError(views->place + ": 'views' and " + quote(other) +
                                 " exclude each other; give one.");
            }
        }
        check_at(*views, [&] { group.cameras = group_cameras(joined_words(*views)); });
        group.eyes_m.reset();
    }
    const ConfigNode* const units = tree.find("units_per_metre");
    if (units != nullptr && !group.eyes_m) {
        throw InputError(units->place + ": key 'units_per_metre' is for 'eyes', which is missing.");
    }
    group.units_per_metre = taken_real(tree, "units_per_metre", group.units_per_metre);
}

void read_views(const ConfigNode& tree, const fs::path& folder, StudyViews& study) {
    if (const ConfigNode* scenes = tree.find("scenes")) {
        for (const std::string& scene : words_of(*scenes)) {
            study.scenes.push_back(beside(folder, scene));
        }
    }
    if (const ConfigNode* cameras = tree.find("cameras")) {
        study.cameras = joined_words(*cameras);
        check_at(*cameras, [&] { parse_cameras(study.cameras); });
    }
    read_group(tree, study.path.group);
    if (const ConfigNode* resolutions = tree.find("resolutions")) {
        study.resolutions = joined_words(*resolutions);
        check_at(*resolutions, [&] { parse_resolutions(study.resolutions); });
        if (const ConfigNode* width = tree.find("width")) {
            throw InputError(width->place +
                             ": 'width' and 'resolutions' exclude each other; give one.");
        }
    }
    if (tree.find("camera_file") != nullptr) {
        take(tree, "camera_file", config_scalar::Text{}, study.camera_file);
        study.camera_file = beside(folder, study.camera_file);
    }
    if (tree.find("width") != nullptr) {
        study.width = static_cast<int>(taken_integer(tree, "width", 0));
    }
    if (const ConfigNode* crop = tree.find("crop")) {
        take(tree, "crop", config_scalar::Text{}, study.crop);
        check_at(*crop, [&] { crop_of(study.crop); });
    }
    study.path.frames = static_cast<int>(taken_integer(tree, "frames", study.path.frames));
    study.path.step_degrees = taken_real(tree, "path_step", study.path.step_degrees);
    if (tree.find("fidelity") != nullptr) {
        study.analytic = takes_second(tree, "fidelity");
    }
    take(tree, "array_only", config_scalar::Boolean{}, study.array_only);
    take(tree, "reference", config_scalar::Boolean{}, study.reference);
}

/// The views of the section 'quick', which replace those of the study. False if there is none.
bool read_quick(const ConfigNode& tree, const fs::path& folder, StudyViews& study) {
    const ConfigNode* const quick = tree.find("quick");
    if (quick == nullptr) {
        return false;
    }
    if (quick->kind != Kind::kSection) {
        throw InputError(quick->place + ": key 'quick' must be a section of views.");
    }
    const std::vector<std::string> allowed =
        names_of([](const StudyKey& key) { return key.in_quick; });
    for (const ConfigNode& key : quick->children) {
        if (!is_among(allowed, key.key)) {
            throw InputError(key.place + ": unknown key " + quote(key.key) +
                             " in 'quick'; allowed are " + config_words::list(allowed) + ".");
        }
    }
    if (quick->find("scenes") != nullptr) {
        study.scenes.clear();
    }
    if (quick->find("resolutions") != nullptr || quick->find("width") != nullptr) {
        study.resolutions.clear();
        study.width.reset();
        study.crop.clear(); // it is of images in the other size
    }
    read_views(*quick, folder, study);
    return true;
}

std::vector<Axis> read_axes(const ConfigNode& tree, const fs::path& folder) {
    std::vector<Axis> axes;
    const ConfigNode* section = tree.find("axes");
    if (section == nullptr || section->kind == Kind::kNull) {
        return axes;
    }
    if (section->kind != Kind::kSection) {
        throw InputError(section->place + ": key 'axes' must be a section of keys with values.");
    }
    std::map<std::string, std::string> owners; // axes by key
    for (const ConfigNode& node : section->children) {
        Axis axis = read_axis(node, folder);
        for (const std::string& key : axis.keys) {
            const auto [owner, is_new] = owners.emplace(key, axis.name);
            if (!is_new) {
                throw InputError(node.place + ": key " + quote(key) + " is varied by two axes, " +
                                 quote(owner->second) + " and " + quote(axis.name) + ".");
            }
        }
        axes.push_back(std::move(axis));
    }
    return axes;
}

bool has_included_keys(const ConfigNode& node) {
    return node.layer > 1 ||
           std::any_of(node.children.begin(), node.children.end(), has_included_keys);
}

/// What a design of a study changes in the file that it includes counts like --set: its values were
/// chosen for these runs.
void choose_own_keys(ConfigNode& node) {
    node.layer = node.layer == 1 && node.kind != Kind::kSection ? 0 : node.layer;
    std::for_each(node.children.begin(), node.children.end(), choose_own_keys);
}

} // namespace

bool is_study(const ConfigNode& tree) {
    return tree.find("axes") != nullptr || list_of_designs(tree) != nullptr;
}

std::vector<StudyDesign> read_designs(const ConfigNode& tree) {
    if (list_of_designs(tree) == nullptr) {
        throw InputError(tree.find("axes")->place +
                         ": a study with 'axes' needs a list 'designs', each with 'name' and "
                         "'include'.");
    }
    const ConfigNode& list = *list_of_designs(tree);
    std::vector<StudyDesign> designs;
    for (const ConfigNode& point : list.children) {
        const ConfigNode* name = point.find("name");
        if (name == nullptr) {
            throw InputError(point.place + ": a point of a study needs a key 'name'.");
        }
        if (name->kind != Kind::kScalar || name->text.empty()) {
            throw InputError(name->place + ": key 'name' of a design must be a word.");
        }
        designs.push_back({name->text, point});
        if (has_included_keys(point)) {
            choose_own_keys(designs.back().tree);
        }
    }
    if (list.kind != Kind::kList || designs.empty()) {
        throw InputError(list.place + ": key " + quote(list.key) +
                         " must be a list of designs, each with 'name' and 'include'.");
    }
    return designs;
}

void check_designs_only(const ConfigNode& tree) {
    check_top_keys(tree);
    const std::vector<std::string> of_sweep =
        names_of([](const StudyKey& key) { return key.of_sweep; });
    for (const ConfigNode& key : tree.children) {
        if (is_among(of_sweep, key.key)) {
            throw InputError(key.place + ": key " + quote(key.key) +
                             " of a study is for 'degs sweep', which runs all of its points.");
        }
    }
}

StudyViews read_study_views(const ConfigNode& tree, const std::string& file, bool quick) {
    const fs::path folder = fs::path(file).parent_path();
    StudyViews views;
    read_views(tree, folder, views);
    StudyViews few = views;
    const bool has_few = read_quick(tree, folder, few);
    if (quick && !has_few) {
        throw InputError(file + ": --quick needs a section 'quick' in the study.");
    }
    return quick ? few : views;
}

Study read_study(const std::string& file, bool quick) {
    const ConfigNode tree = ConfigSource::from_file(file).tree();
    Study study;
    study.name = fs::path(file).stem().string();
    if (!is_study(tree)) {
        if (quick) {
            throw InputError(file + ": --quick needs a study with a section 'quick'.");
        }
        study.designs = {{study.name, tree}};
        return study;
    }
    check_top_keys(tree);
    take(tree, "study", config_scalar::Text{}, study.name);
    study.designs = read_designs(tree);
    study.axes = read_axes(tree, fs::path(file).parent_path());
    study.one_at_a_time = takes_second(tree, "combine");
    take(tree, "baseline", config_scalar::Text{}, study.baseline);
    for (const auto& [key, stated] :
         {std::pair("goals", &study.goals), std::pair("limits", &study.limits)}) {
        if (const ConfigNode* node = tree.find(key)) {
            *stated = {joined_words(*node), node->place + ": key " + quote(key)};
        }
    }
    static_cast<StudyViews&>(study) = read_study_views(tree, file, quick);
    return study;
}

} // namespace degs::sim
