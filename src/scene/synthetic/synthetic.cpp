// SPDX-License-Identifier: Apache-2.0
#include "scene/synthetic/synthetic.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include "degs/error.hpp"
#include "scene/synthetic/synthetic_build.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMostGaussians = 20000000; // 5 GB at SH degree 3

struct Profile {
    const char* name;
    const char* meaning;
    std::uint64_t default_gaussians;
    std::uint64_t most;
    void (*make)(const SyntheticSpec& spec, SyntheticScene& scene);
};
constexpr std::array<Profile, 11> kProfiles{{
    {"object", "a captured object, surface covered with discs, few floaters, empty background",
     100000, kMostGaussians, make_object},
    {"outdoor", "ground with grass, objects in the middle, haze of big splats around", 150000,
     kMostGaussians, make_outdoor},
    {"landscape", "a whole outdoor capture: an object, ground to the horizon, trees, sky", 3000000,
     kMostGaussians, make_landscape},
    {"lighthouse", "a picture: a lighthouse on a headland, house, fence, trees, sea and sky",
     300000, kMostGaussians, make_lighthouse},
    {"interior", "a capture of a whole flat: a furnished room, and what lies behind its walls",
     3000000, kMostGaussians, make_interior},
    {"garden", "a capture of a courtyard: lawn, trees, a basin, and the houses around", 3400000,
     kMostGaussians, make_garden},
    {"dense", "a volume of faint splats: long lists, late termination", 100000, kMostGaussians,
     make_dense},
    {"uniform", "round blobs spread evenly in a box", 10000, kMostGaussians, make_uniform},
    {"single", "one big splat in the centre of every view", 1, 1, make_single},
    {"needles", "needles of aspect 100 to 100 000 at all angles", 1000, kMostGaussians,
     make_needles},
    {"dynamic", "a table scene that changes: a ball flies, a column sways, steam comes and goes",
     100000, kMostGaussians, make_dynamic},
}};

const Profile& profile_named(const std::string& name) {
    std::string known;
    for (const Profile& profile : kProfiles) {
        if (name == profile.name) {
            return profile;
        }
        known += (known.empty() ? "" : ", ") + std::string(profile.name);
    }
    throw InputError("There is no synthetic scene '" + name + "'; there are " + known + ".");
}

std::uint64_t parse_count(const std::string& key, const std::string& text, std::uint64_t low,
                          std::uint64_t high) {
    std::uint64_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || value < low || value > high) {
        throw InputError("Key '" + key + "' of a synthetic scene is '" + text +
                         "'; allowed are integers from " + std::to_string(low) + " to " +
                         std::to_string(high) + ".");
    }
    return value;
}

double parse_sky(const std::string& text) {
    double share = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, share);
    if (error != std::errc() || stop != end || !(share >= 0 && share <= 0.5)) {
        throw InputError("Key 'sky' of a synthetic scene is '" + text +
                         "'; allowed are numbers from 0 to 0.5.");
    }
    return share;
}

void parse_setting(const std::string& setting, const Profile& profile, SyntheticSpec& spec) {
    const std::size_t equals = std::min(setting.find('='), setting.size());
    const std::string key = setting.substr(0, equals);
    const std::string value = equals < setting.size() ? setting.substr(equals + 1) : "";
    if (key == "gaussians") {
        spec.gaussians = parse_count(key, value, 1, profile.most);
    } else if (key == "seed") {
        spec.seed = parse_count(key, value, 0, UINT64_MAX);
    } else if (key == "time" && spec.profile == "dynamic") {
        spec.time = parse_scene_time(value);
        if (!spec.time) {
            throw InputError("Key 'time' of a synthetic scene is '" + value +
                             "'; allowed are numbers from 0 to 1.");
        }
    } else if (key == "frames" && spec.profile == "dynamic") {
        spec.frames = static_cast<int>(parse_count(key, value, 1, kMostSceneFrames));
    } else if (key == "sky" && (spec.profile == "interior" || spec.profile == "garden")) {
        spec.sky = parse_sky(value);
    } else {
        throw InputError("'" + setting +
                         "' is no setting of a synthetic scene; allowed are "
                         "gaussians=N and seed=N, time=T and frames=N of 'dynamic', and sky=S of "
                         "'interior' and 'garden'.");
    }
}

} // namespace

std::vector<SyntheticProfile> synthetic_profiles() {
    std::vector<SyntheticProfile> out;
    out.reserve(kProfiles.size());
    for (const Profile& profile : kProfiles) {
        out.push_back({profile.name, profile.meaning, profile.default_gaussians});
    }
    return out;
}

std::optional<double> parse_scene_time(const std::string& text) {
    double time = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, time);
    const bool good = error == std::errc() && stop == end && time >= 0 && time <= 1;
    return good ? std::optional<double>(time) : std::nullopt;
}

std::optional<int> parse_scene_frames(const std::string& text) {
    int frames = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, frames);
    const bool good =
        error == std::errc() && stop == end && frames >= 1 && frames <= kMostSceneFrames;
    return good ? std::optional<int>(frames) : std::nullopt;
}

SyntheticSpec parse_synthetic(const std::string& text) {
    std::size_t end = std::min(text.find(','), text.size());
    const Profile& profile = profile_named(text.substr(0, end));
    SyntheticSpec spec{profile.name, profile.default_gaussians, 1};
    std::set<std::string> keys;
    while (end < text.size()) {
        const std::size_t begin = end + 1;
        end = std::min(text.find(',', begin), text.size());
        const std::string setting = text.substr(begin, end - begin);
        parse_setting(setting, profile, spec);
        const std::string key = setting.substr(0, setting.find('='));
        if (!keys.insert(key).second) {
            std::string message = "The synthetic scene '" + text + "' gives '";
            message.append(key).append("' twice; each setting may stand once.");
            throw InputError(message);
        }
    }
    return spec;
}

SyntheticScene make_synthetic(const SyntheticSpec& spec) {
    const Profile& profile = profile_named(spec.profile);
    parse_count("gaussians", std::to_string(spec.gaussians), 1, profile.most);
    SyntheticScene scene;
    profile.make(spec, scene);
    return scene;
}

} // namespace degs
