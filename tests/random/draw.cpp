// SPDX-License-Identifier: Apache-2.0
#include "tests/random/draw.hpp"

#include <algorithm>
#include <filesystem>

#include "sim/design/run_config.hpp"
#include "tests/random/draw_value.hpp"

namespace degs::trials {
namespace {

/// The shipped designs, sorted; every draw starts at one of them.
std::vector<std::string> config_files(const std::string& configs) {
    std::vector<std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(configs)) {
        if (entry.path().extension() == ".yaml") {
            files.push_back(entry.path().filename().string());
        }
    }
    std::sort(files.begin(), files.end());
    return files;
}

/// Sets a key, in place of what the design says of it.
void put(Trial& trial, const std::string& path, const std::string& value) {
    for (Change& change : trial.changes) {
        if (change.path == path) {
            change.value = value;
            return;
        }
    }
    trial.changes.push_back({path, value});
}

void put_if_known(Trial& trial, const std::vector<Key>& keys, const std::string& path,
                  const std::string& value) {
    if (std::any_of(keys.begin(), keys.end(), [&](const Key& key) { return key.path == path; })) {
        put(trial, path, value);
    }
}

void draw_scene(Dice& dice, Trial& trial) {
    static const std::vector<std::string> profiles{"single",  "uniform", "needles", "object",
                                                   "outdoor", "dense",   "dense",   "uniform"};
    const std::string& profile = dice.one_of(profiles);
    const bool large = dice.chance(0.6);
    const std::int64_t gaussians = profile == "single" ? 1
                                   : large             ? dice.log_integer(200, 8000)
                                                       : dice.log_integer(1, 200);
    trial.scene = "synthetic:" + profile + ",gaussians=" + std::to_string(gaussians) +
                  ",seed=" + std::to_string(1 + dice.below(1000));
    constexpr int kCameras = 11; // in cameras.json
    trial.camera = dice.below(kCameras);
    const auto side = [&dice] {
        return static_cast<int>(dice.chance(0.6) ? dice.log_integer(32, 160)
                                                 : dice.log_integer(1, 32));
    };
    trial.width = side();
    trial.height = side();
    if (dice.chance(0.4)) {
        trial.frames = 2 + dice.below(4);
        trial.step_degrees = dice.chance(0.5) ? 0.5 : 40;
    }
    if (dice.chance(0.25)) {
        const double distances[] = {0, 0.065, 0.5, 20};
        trial.eyes = distances[dice.below(4)];
    }
    if (dice.chance(0.25)) {
        const char* const centres[] = {"0.5,0.5", "0,1", "0.9,0.3"};
        const char* const angles[] = {"5:12", "15:30", "20:20", "1:90", "60:70"};
        trial.foveation = std::string(centres[dice.below(3)]) + ":" + angles[dice.below(5)];
    }
    trial.array_only = dice.chance(0.2);
}

/// Where the image must be the reference's: double precision, exact ends, the reference's stop
/// rule.
void make_exact(Trial& trial, const std::vector<Key>& keys) {
    put(trial, "pipeline.numbers", "fp64");
    put(trial, "pipeline.stop_rule", "refuse");
    put_if_known(trial, keys, "pipeline.span_ends", "exact");
}

void draw_changes(Dice& dice, Trial& trial, const std::vector<Key>& keys) {
    const int sizes[] = {1, 2, 2, 3, 4, 8, 16, 40};
    for (int i = sizes[dice.below(8)]; i > 0; --i) {
        const Key& key = draw_key(dice, keys);
        if (key.path != "accelerator") { // follows from the file
            put(trial, key.path, draw_value(dice, key));
        }
    }
    if (dice.chance(0.4)) {
        put(trial, "memory.model", "lpddr5");
    }
    if (dice.chance(0.35)) {
        make_exact(trial, keys);
    }
    if (dice.chance(0.2)) {
        put_if_known(trial, keys, "memory.layout", "morton");
    }
    if (dice.chance(0.3)) {
        put_if_known(trial, keys, "memory.priority", "blending");
    }
    if (dice.chance(0.3)) {
        put_if_known(trial, keys, "clusters", std::to_string(2 + dice.below(4)));
    }
}

/// Takes back changes until the design can be built, first those that the refusal names.
void repair(Dice& dice, Trial& trial, const std::string& configs, DrawCounts& counts) {
    std::string problem = refusal(configs, trial);
    counts.refused += problem.empty() ? 0 : 1;
    while (!problem.empty()) {
        std::vector<int> named;
        std::vector<int> all;
        for (int i = 0; i < static_cast<int>(trial.changes.size()); ++i) {
            all.push_back(i);
            if (problem.find(trial.changes[i].path) != std::string::npos) {
                named.push_back(i);
            }
        }
        trial.changes.erase(trial.changes.begin() + dice.one_of(named.empty() ? all : named));
        ++counts.dropped;
        problem = refusal(configs, trial);
    }
}

/// The smallest value of a whole-numbered key with which the rest can still be built, if smaller
/// values are refused and larger ones are not.
void tighten(Trial& trial, const std::string& configs, const Key& key) {
    auto low = static_cast<std::int64_t>(key.low) - 1;
    auto good = static_cast<std::int64_t>(key.value);
    const auto buildable = [&](std::int64_t value) {
        Trial probe = trial;
        put(probe, key.path, std::to_string(value));
        return refusal(configs, probe).empty();
    };
    while (good - low > 1) {
        const std::int64_t middle = low + (good - low) / 2;
        (buildable(middle) ? good : low) = middle;
    }
    if (good != static_cast<std::int64_t>(key.value) && buildable(good)) {
        put(trial, key.path, std::to_string(good));
    }
}

} // namespace

std::string refusal(const std::string& configs, const Trial& trial) {
    try {
        sim::load_run_config(configs + "/" + trial.config, trial.overrides());
    } catch (const std::exception& error) {
        return error.what();
    }
    return "";
}

Trial draw_trial(const std::string& configs, std::uint64_t seed, std::uint64_t index,
                 DrawCounts& counts) {
    Dice dice(seed, index);
    Trial trial;
    trial.config = dice.one_of(config_files(configs));
    const auto keys = [&] {
        return keys_of(sim::load_run_config(configs + "/" + trial.config, trial.overrides()));
    };
    draw_scene(dice, trial);
    draw_changes(dice, trial, keys());
    repair(dice, trial, configs, counts);
    for (int i = dice.below(4); i > 0; --i) {
        const std::vector<Key> standing = keys();
        const Key& key = draw_key(dice, standing);
        if (key.kind == Key::Kind::Integer) {
            tighten(trial, configs, key);
        }
    }
    ++counts.drawn;
    counts.changes += trial.changes.size();
    return trial;
}

} // namespace degs::trials
