// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "degs/error.hpp"
#include "scene/files/input_file.hpp"
#include "scene/scene.hpp"
#include "scene/scene_spec.hpp"
#include "sim/shell/scene_list.hpp"
#include "sim/text/comma_parts.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

/// What may tell scenes of one name apart.
struct NamedScene {
    std::string name;
    std::vector<std::string> path;  ///< the file, its folder, the folder of that, ...
    std::size_t named_by = 0;       ///< the part of the path that has the name
    std::set<std::string> settings; ///< "gaussians=300"
};

/// A part of the path, or the settings behind it that some of the scenes lack.
constexpr std::size_t kSettings = static_cast<std::size_t>(-1);
using Parts = std::vector<std::size_t>;

std::set<std::string> pieces_of(const std::string& text) {
    const std::vector<std::string> parts = comma_parts(text);
    std::set<std::string> pieces(parts.begin(), parts.end());
    pieces.erase(""); // the only part of an empty text
    return pieces;
}

NamedScene named(const std::string& scene) {
    NamedScene named{scene_name(scene), {}, 0, {}};
    const SceneSpec spec = parse_scene_spec(scene);
    if (spec.synthetic) { // "synthetic:object,seed=2": as if the profile was a file
        named.path = {named.name, "synthetic"};
        const std::size_t comma = std::min(scene.find(','), scene.size() - 1);
        named.settings = pieces_of(scene.substr(comma + 1));
        return named;
    }
    if (spec.path != scene) {
        const std::size_t mark = scene.rfind('?');
        named.settings = pieces_of(mark == std::string::npos ? "" : scene.substr(mark + 1));
    }
    for (const fs::path& part : absolute_path(spec.path).lexically_normal().relative_path()) {
        if (!part.empty()) {
            named.path.insert(named.path.begin(), part.string());
        }
    }
    const auto at =
        std::find_if(named.path.begin() + 1, named.path.end(),
                     [&named](const std::string& folder) { return folder == named.name; });
    const bool by_file = fs::path(named.path.front()).stem() == named.name;
    named.named_by = by_file || at == named.path.end() ? 0 : at - named.path.begin();
    return named;
}

std::string joined(const std::set<std::string>& words, const std::string& between) {
    std::string text;
    for (const std::string& word : words) {
        text.append(between).append(word);
    }
    return text;
}

std::string part_of(const NamedScene& scene, std::size_t part) {
    if (part == kSettings) {
        return joined(scene.settings, " ");
    }
    return part < scene.path.size() ? scene.path[part] : "";
}

std::size_t told_apart(const std::vector<NamedScene>& scenes, const Parts& parts) {
    std::set<std::vector<std::string>> different;
    for (const NamedScene& scene : scenes) {
        std::vector<std::string> words;
        for (const std::size_t part : parts) {
            words.push_back(part_of(scene, part));
        }
        different.insert(words);
    }
    return different.size();
}

/// One part if that tells all apart, the nearest first; else those that each tell more apart.
Parts telling_parts(const std::vector<NamedScene>& scenes) {
    std::size_t deepest = 0;
    for (const NamedScene& scene : scenes) {
        deepest = std::max(deepest, scene.path.size());
    }
    Parts all{kSettings};
    for (std::size_t part = 1; part < deepest; ++part) {
        all.push_back(part);
    }
    all.push_back(0);
    for (const std::size_t part : all) {
        if (told_apart(scenes, {part}) == scenes.size()) {
            return {part};
        }
    }
    Parts chosen;
    for (const std::size_t part : all) {
        Parts more = chosen;
        more.push_back(part);
        if (told_apart(scenes, more) > told_apart(scenes, chosen)) {
            chosen = more;
        }
    }
    return chosen;
}

/// Settings that all scenes have say nothing.
void forget_common_settings(std::vector<NamedScene>& scenes) {
    std::map<std::string, std::size_t> counts;
    for (const NamedScene& scene : scenes) {
        for (const std::string& setting : scene.settings) {
            ++counts[setting];
        }
    }
    for (NamedScene& scene : scenes) {
        for (const auto& [setting, count] : counts) {
            if (count == scenes.size()) { // also of a scene alone
                scene.settings.erase(setting);
            }
        }
    }
}

/// "folder/name/folder settings".
std::string label(const NamedScene& scene, Parts parts) {
    std::sort(parts.rbegin(), parts.rend()); // the outermost folder first, behind the settings
    std::string above, below, settings;
    for (const std::size_t part : parts) {
        const std::string words = part_of(scene, part);
        if (part == kSettings) {
            settings = words;
        } else if (part > scene.named_by) {
            above += words.empty() ? "" : words + "/";
        } else if (part < scene.named_by) {
            below += words.empty() ? "" : "/" + words;
        }
    }
    const bool whole = scene.named_by == 0 && std::count(parts.begin(), parts.end(), 0U) != 0;
    return above + (whole ? scene.path.front() : scene.name) + below + settings;
}

/// The scenes of each name, by what was written.
std::map<std::string, std::map<std::string, NamedScene>>
scenes_by_name(const std::vector<std::string>& scenes) {
    std::map<std::string, std::map<std::string, NamedScene>> by_name;
    for (const std::string& scene : scenes) {
        try {
            const NamedScene found = named(scene);
            by_name[found.name].emplace(scene, found);
        } catch (const InputError&) {
            continue; // that it cannot be read is said elsewhere
        }
    }
    return by_name;
}

} // namespace

std::vector<std::string> scene_labels(const std::vector<std::string>& scenes) {
    std::map<std::string, std::string> labels; // by what was written
    std::map<std::string, int> uses;
    for (const auto& [name, sharing] : scenes_by_name(scenes)) {
        std::vector<NamedScene> same;
        for (const auto& [scene, found] : sharing) {
            same.push_back(found);
        }
        forget_common_settings(same);
        const Parts parts = same.size() == 1 ? Parts{} : telling_parts(same);
        auto next = same.begin();
        for (const auto& [scene, found] : sharing) {
            labels[scene] = label(*next++, parts);
            ++uses[labels[scene]];
        }
    }
    std::vector<std::string> found;
    for (const std::string& scene : scenes) {
        const auto known = labels.find(scene);
        found.push_back(known == labels.end() || uses[known->second] > 1 ? scene : known->second);
    }
    return found;
}

std::vector<std::string> scene_labels(const std::vector<ViewRequest>& views) {
    std::vector<std::string> scenes;
    scenes.reserve(views.size());
    for (const ViewRequest& view : views) {
        scenes.push_back(view.scene);
    }
    return scene_labels(scenes);
}

} // namespace degs::sim
