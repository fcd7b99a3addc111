// SPDX-License-Identifier: Apache-2.0
#include "tests/random/trial.hpp"

#include <cstdio>

namespace degs::trials {
namespace {

/// A word for a shell, in quotes only if it needs them.
std::string quoted(const std::string& word) {
    const bool plain = !word.empty() &&
                       word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                              "0123456789_-+=.,:/") == std::string::npos;
    return plain ? word : "'" + word + "'";
}

} // namespace

std::vector<std::string> Trial::overrides() const {
    std::vector<std::string> settings;
    for (const Change& change : changes) {
        settings.push_back(change.path + "=" + change.value);
    }
    return settings;
}

std::string Trial::arguments() const {
    std::string line = "run configs/" + config + " --scene " + scene +
                       " --camera-file tests/random/cameras.json --camera " +
                       std::to_string(camera) + " --width " + std::to_string(width) + " --height " +
                       std::to_string(height);
    const auto number = [](double value) {
        char text[32];
        std::snprintf(text, sizeof text, "%g", value);
        return std::string(text);
    };
    if (frames > 1) {
        line += " --frames " + std::to_string(frames) + " --path-step " + number(step_degrees);
    }
    if (eyes) {
        line += " --eyes " + number(*eyes);
    }
    if (!foveation.empty()) {
        line += " --foveation " + foveation;
    }
    if (array_only) {
        line += " --array-only";
    }
    for (const std::string& setting : overrides()) {
        line += " --set " + quoted(setting);
    }
    return line;
}

} // namespace degs::trials
