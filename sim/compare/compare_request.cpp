// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/compare_request.hpp"

#include <algorithm>
#include <filesystem>

#include "config/error.hpp"
#include "sim/compare/addressed_overrides.hpp"
#include "sim/sweep/study_file.hpp"

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

/// Each design of a study is a configuration of its own.
void add_drafts(std::vector<StudyDesign>& drafts, const std::string& word) {
    const Named file = named(word);
    const ConfigNode tree = ConfigSource::from_file(file.file).tree();
    if (!is_study(tree)) {
        drafts.push_back({file.name, tree});
        return;
    }
    check_designs_only(tree);
    for (StudyDesign& design : read_designs(tree)) {
        drafts.push_back(std::move(design));
    }
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts;
    std::size_t begin = 0;
    for (std::size_t end = 0; end != std::string::npos; begin = end + 1) {
        end = text.find(',', begin);
        parts.push_back(text.substr(begin, end - begin));
    }
    return parts;
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
                                                 std::uint64_t seed, int frames) {
    std::optional<SamplingRequest> sampling = sampling_of("exact", within, seed);
    if (sampling && frames > 1) {
        throw InputError("--frames asks for a camera path, which needs every tile, so it cannot be "
                         "combined with --within.");
    }
    return sampling;
}

std::vector<NamedConfig> load_configs(const std::vector<std::string>& words,
                                      const std::vector<std::string>& overrides) {
    std::vector<StudyDesign> drafts;
    for (const std::string& word : words) {
        if (named(word).name.empty()) {
            throw InputError("The configuration '" + word +
                             "' has an empty name; FILE or NAME=FILE is needed.");
        }
        add_drafts(drafts, word);
    }
    const auto count = [&drafts](const std::string& name) {
        return std::count_if(drafts.begin(), drafts.end(),
                             [&name](const StudyDesign& draft) { return draft.name == name; });
    };
    for (const StudyDesign& draft : drafts) {
        if (count(draft.name) > 1) {
            throw InputError("Two configurations are called '" + draft.name +
                             "'; NAME=FILE keeps them apart.");
        }
    }
    std::vector<std::string> names;
    names.reserve(drafts.size());
    for (const StudyDesign& draft : drafts) {
        names.push_back(draft.name);
    }
    check_addressees(overrides, names);
    std::vector<NamedConfig> configs;
    configs.reserve(drafts.size());
    for (const StudyDesign& draft : drafts) {
        configs.push_back({draft.name, load_run_config(ConfigSource::from_tree(
                                           draft.tree, overrides_of(draft.name, overrides)))});
    }
    return configs;
}

std::optional<std::vector<int>> parse_cameras(const std::string& text) {
    if (text == "all") {
        return {};
    }
    std::vector<int> cameras;
    for (const std::string& part : split(text)) {
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
    for (const std::string& part : split(text)) {
        const int height = resolution_height(part);
        for (const ImageSize& size : sizes) {
            if (size.height == height) {
                throw InputError("The resolution '" + part + "' is given twice.");
            }
        }
        sizes.push_back({{}, height});
    }
    return sizes;
}

} // namespace degs::sim
