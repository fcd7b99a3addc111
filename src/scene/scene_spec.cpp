// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_spec.hpp"

#include <charconv>
#include <filesystem>
#include <functional>
#include <set>
#include <utility>
#include <vector>

#include "degs/error.hpp"
#include "scene/scene_formats.hpp"
#include "scene/synthetic/synthetic.hpp"

namespace degs {
namespace {

constexpr const char* kSyntheticPrefix = "synthetic:";
constexpr const char* kEitherDetail = "lod and budget exclude each other; allowed is one of them.";

[[noreturn]] void fail_spec(const std::string& text, const std::string& sentence) {
    throw InputError("Scene '" + text + "': " + sentence);
}

struct SpecKey {
    const char* name;
    /// Stores the value; a sentence that says what is allowed if it cannot be.
    std::function<std::string(SceneSpec& spec, const std::string& value)> take;
};

std::string take_axes(SceneSpec& spec, const std::string& value) {
    spec.axes = parse_axes(value);
    return spec.axes ? ""
                     : "axes is '" + value +
                           "', but must be three letters: R or L, D or U, F or B, for the "
                           "directions of +X, +Y and +Z (right or left, down or up, forward or "
                           "back), e.g. rdf.";
}

std::string take_time(SceneSpec& spec, const std::string& value) {
    spec.time = parse_scene_time(value);
    return spec.time ? "" : "time is '" + value + "', but must be a number from 0 to 1.";
}

std::string take_frames(SceneSpec& spec, const std::string& value) {
    spec.frames = parse_scene_frames(value);
    return spec.frames ? ""
                       : "frames is '" + value + "', but must be an integer from 1 to " +
                             std::to_string(kMostSceneFrames) + ".";
}

std::optional<std::uint64_t> whole_number(const std::string& text, std::uint64_t most) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool good = error == std::errc() && stop == end && value <= most;
    return good ? std::optional<std::uint64_t>(value) : std::nullopt;
}

std::string take_level(SceneSpec& spec, const std::string& value) {
    constexpr std::uint64_t kMostLevel = 99;
    const std::optional<std::uint64_t> level = whole_number(value, kMostLevel);
    if (!level) {
        return "lod is '" + value + "', but must be an integer from 0, the finest, to " +
               std::to_string(kMostLevel) + ".";
    }
    spec.detail.level = static_cast<int>(*level);
    return spec.detail.budget ? kEitherDetail : "";
}

std::string take_budget(SceneSpec& spec, const std::string& value) {
    constexpr std::uint64_t kMostGaussians = 0xFFFFFFFF;
    spec.detail.budget = whole_number(value, kMostGaussians);
    if (!spec.detail.budget || *spec.detail.budget == 0) {
        return "budget is '" + value + "', but must be a number of Gaussians from 1 to " +
               std::to_string(kMostGaussians) + ".";
    }
    return spec.detail.level ? kEitherDetail : "";
}

const std::vector<SpecKey>& spec_keys() {
    static const std::vector<SpecKey> keys{{"axes", take_axes},
                                           {"time", take_time},
                                           {"frames", take_frames},
                                           {"lod", take_level},
                                           {"budget", take_budget}};
    return keys;
}

void take_option(const std::string& text, const std::string& option, SceneSpec& spec) {
    const std::size_t equals = option.find('=');
    const std::string name = option.substr(0, equals);
    std::string allowed;
    for (const SpecKey& key : spec_keys()) {
        if (name == key.name && equals != std::string::npos) {
            const std::string mistake = key.take(spec, option.substr(equals + 1));
            if (!mistake.empty()) {
                fail_spec(text, mistake);
            }
            return;
        }
        allowed += (allowed.empty() ? "" : ", ") + std::string(key.name) + "=VALUE";
    }
    fail_spec(text,
              "'" + option + "' is not an option of a scene file; allowed are " + allowed + ".");
}

SceneSpec spec_of(const std::string& text) {
    SceneSpec spec;
    spec.path = text;
    spec.synthetic = text.rfind(kSyntheticPrefix, 0) == 0;
    const std::size_t mark = text.rfind('?');
    std::error_code ignored;
    if (spec.synthetic || mark == std::string::npos || text.find('=', mark) == std::string::npos ||
        std::filesystem::exists(text, ignored)) {
        return spec;
    }
    spec.path = text.substr(0, mark);
    std::set<std::string> seen;
    for (std::size_t begin = mark + 1; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const std::string option = text.substr(begin, end - begin);
        if (!seen.insert(option.substr(0, option.find('='))).second) {
            fail_spec(text, "'" + option + "' repeats an option.");
        }
        take_option(text, option, spec);
        begin = end + 1;
    }
    return spec;
}

/// The index of the scene in a folder; `path` itself if it is none, or holds frames of a sequence.
std::string index_in(const std::string& path) {
    namespace fs = std::filesystem;
    std::error_code error;
    if (!fs::is_directory(path, error)) {
        return path;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
        if (has_scene_extension(entry.path().string())) {
            return path;
        }
    }
    for (const char* const name : {"lod-meta.json", "meta.json"}) {
        if (fs::is_regular_file(fs::path(path) / name, error)) {
            return (fs::path(path) / name).string();
        }
    }
    return path;
}

} // namespace

SceneSpec parse_scene_spec(const std::string& text) {
    SceneSpec spec = spec_of(text);
    if (!spec.synthetic) {
        spec.path = index_in(spec.path);
    }
    return spec;
}

} // namespace degs
