// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/platform_keys.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>

#include "config/config_document.hpp"
#include "degs/error.hpp"

namespace degs::sim {
namespace {

/// A key or a section, and why it does nothing.
struct Unfollowed {
    std::string path;
    const char* reason;
};

constexpr const char* kOwnMemory = "the platform has a memory of its own, --memory";
constexpr const char* kOneFrame = "the platform starts a frame when the one before has ended";
constexpr const char* kFloatScene = "the scene lies in the platform's memory as floats";
constexpr const char* kByRegister = "the register FORMAT says it";
constexpr const char* kNoBill = "nothing is billed on a platform";

std::map<std::string, std::string> values_of(const std::vector<KeyDoc>& document) {
    std::map<std::string, std::string> values;
    for (const KeyDoc& key : document) {
        values[key.path] = key.default_value;
    }
    return values;
}

/// The accelerator itself says which of its values a scene of floats replaces.
std::vector<Unfollowed> unfollowed_by(const RunConfig& config, bool has_views) {
    std::vector<Unfollowed> all{
        {"memory.model", kOwnMemory},         {"memory.bandwidth_gb_per_s", kOwnMemory},
        {"memory.latency_ns", kOwnMemory},    {"memory.access_bytes", kOwnMemory},
        {"memory.urgent_share", kOwnMemory},  {"memory.lpddr5", kOwnMemory},
        {"traffic.pixel_bytes", kByRegister}, {"cost", kNoBill}};
    if (!has_views || config.accelerator().view_sharing() != ViewSharing::Nothing) {
        all.push_back({"frames_in_flight", kOneFrame}); // else each view is a frame
    }
    const std::unique_ptr<AcceleratorConfig> floats = config.accelerator().clone();
    floats->read_floats();
    const auto replaced =
        values_of(document_keys([&floats](ConfigVisitor& visitor) { floats->describe(visitor); }));
    for (const auto& [path, value] : values_of(document(config))) {
        const auto by = replaced.find(path);
        if (by != replaced.end() && by->second != value) {
            all.push_back({path, kFloatScene});
        }
    }
    return all;
}

bool lies_in(const std::string& path, const std::string& section) {
    return path == section || path.rfind(section + ".", 0) == 0;
}

} // namespace

std::vector<std::string> check_platform_keys(const ConfigSource& source, const RunConfig& config,
                                             bool has_views) {
    const auto defaults = values_of(document(default_run_config(config.kind(), {})));
    const std::vector<KeyDoc> keys = document(config);
    std::vector<std::string> warnings;
    // What a key of the memory has no effect with may be the memory that the platform has not.
    std::copy_if(config.warnings.begin(), config.warnings.end(), std::back_inserter(warnings),
                 [](const std::string& warning) {
                     return warning.find("key 'memory.") == std::string::npos;
                 });
    for (const Unfollowed& unfollowed : unfollowed_by(config, has_views)) {
        for (const KeyDoc& key : keys) {
            const std::string place = source.place(key.path);
            if (!lies_in(key.path, unfollowed.path) || key.type == "section" ||
                place == "default") {
                continue;
            }
            const std::string sentence = place + ": key '" + key.path +
                                         "' has no effect on a platform, because " +
                                         unfollowed.reason + ".";
            if (place.rfind("--set", 0) == 0) {
                throw InputError(sentence);
            }
            const auto usual = defaults.find(key.path);
            if (usual == defaults.end() || usual->second != key.default_value) {
                warnings.push_back(sentence);
                break; // of a section, the first
            }
        }
    }
    return warnings;
}

} // namespace degs::sim
