// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic_scene.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "scene/dynamic/spacetime_ply.hpp"
#include "scene/dynamic/synthetic_dynamic.hpp"
#include "scene/files/input_file.hpp"
#include "scene/scene.hpp"
#include "scene/scene_formats.hpp"
#include "scene/scene_spec.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

class FileSequence : public DynamicScene {
public:
    /// `options` are those behind the name, with the '?'.
    FileSequence(std::vector<std::string> files, std::string options)
        : files_(std::move(files)), options_(std::move(options)) {}

    int frames() const override { return static_cast<int>(files_.size()); }
    GaussianCloud frame(int k) const override {
        return std::move(load_scene(files_[k] + options_).cloud);
    }

private:
    std::vector<std::string> files_;
    std::string options_;
};

class SpacetimeScene : public DynamicScene {
public:
    SpacetimeScene(SpacetimeCloud cloud, std::optional<int> frames)
        : cloud_(std::move(cloud)), frames_(frames.value_or(kFramesOfScene)) {
        sanitize(cloud_);
    }

    int frames() const override { return frames_; }
    GaussianCloud frame(int k) const override {
        GaussianCloud cloud = at_time(cloud_, static_cast<double>(k) / frames_);
        degs::sanitize(cloud);
        return cloud;
    }

private:
    SpacetimeCloud cloud_;
    int frames_;
};

bool is_digit(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0;
}

/// Numbers by value, everything else by character.
bool natural_less(const std::string& a, const std::string& b) {
    std::size_t i = 0;
    std::size_t j = 0;
    while (i < a.size() && j < b.size()) {
        if (!is_digit(a[i]) || !is_digit(b[j])) {
            if (a[i] != b[j]) {
                return a[i] < b[j];
            }
            ++i;
            ++j;
            continue;
        }
        const auto number_at = [](const std::string& text, std::size_t& at) {
            while (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1])) {
                ++at;
            }
            const std::size_t begin = at;
            while (at < text.size() && is_digit(text[at])) {
                ++at;
            }
            return text.substr(begin, at - begin);
        };
        const std::string x = number_at(a, i);
        const std::string y = number_at(b, j);
        if (x.size() != y.size() || x != y) {
            return x.size() != y.size() ? x.size() < y.size() : x < y;
        }
    }
    return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

/// '*' stands for any characters; every other character for itself.
bool matches_pattern(std::string_view name, std::string_view pattern) {
    constexpr std::size_t kNone = std::string_view::npos;
    std::size_t at = 0, in = 0, star = kNone, after_star = 0;
    while (at < name.size()) {
        if (in < pattern.size() && pattern[in] == '*') {
            star = in++;
            after_star = at;
        } else if (in < pattern.size() && pattern[in] == name[at]) {
            ++in;
            ++at;
        } else if (star != kNone) { // only the last star has to take more: those before are settled
            in = star + 1;
            at = ++after_star;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', in) == kNone;
}

} // namespace

std::vector<std::string> sequence_files(const std::string& path) {
    std::error_code error;
    const bool folder = fs::is_directory(path, error);
    const std::string pattern = folder ? "" : fs::path(path).filename().string();
    if (!folder && (pattern.find('*') == std::string::npos || fs::exists(path, error))) {
        return {};
    }
    const fs::path home = folder ? fs::path(path) : fs::path(path).parent_path();
    std::vector<std::string> files;
    for (const fs::directory_entry& entry :
         fs::directory_iterator(home.empty() ? fs::path(".") : home, error)) {
        const std::string name = entry.path().filename().string();
        if (folder ? has_scene_extension(name) : matches_pattern(name, pattern)) {
            files.push_back((home / name).string());
            require_regular(files.back()); // no frame is left out in silence
        }
    }
    if (files.empty()) {
        fail_file(path, folder ? "this is a folder without scene files; a file, a folder of frames "
                                 "or a pattern like 'folder/*.ply' is needed."
                               : "no file matches this pattern.");
    }
    std::sort(files.begin(), files.end(), natural_less);
    return files;
}

std::unique_ptr<DynamicScene> open_dynamic_scene(const std::string& spec) {
    const SceneSpec asked = parse_scene_spec(spec);
    if (asked.synthetic) {
        const SyntheticSpec made = parse_synthetic(asked.path.substr(asked.path.find(':') + 1));
        return made.profile == kSyntheticDynamic && !made.time
                   ? std::make_unique<SpacetimeScene>(make_spacetime(made), made.frames)
                   : nullptr;
    }
    std::vector<std::string> files = sequence_files(asked.path);
    if (!files.empty()) {
        return std::make_unique<FileSequence>(std::move(files), spec.substr(asked.path.size()));
    }
    const InputWatch watch;
    std::unique_ptr<DynamicScene> scene =
        !asked.time && is_spacetime_ply(asked.path)
            ? std::make_unique<SpacetimeScene>(read_spacetime_ply(asked.path), asked.frames)
            : nullptr;
    watch.require_unchanged();
    return scene;
}

} // namespace degs
