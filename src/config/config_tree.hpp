// SPDX-License-Identifier: Apache-2.0
// A YAML file as a tree in which every value holds its place in the file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace degs {

/// One value of a configuration file. The accepted YAML is the plain part of the language:
/// sections, lists and scalars; no anchors, aliases, tags or second documents.
struct ConfigNode {
    enum class Kind { kNull, kScalar, kSection, kList };

    Kind kind = Kind::kNull;
    std::string key;     ///< empty for the root and for items of a list
    std::string text;    ///< of a scalar
    bool quoted = false; ///< a scalar in quotes is text, never a number
    std::string place;   ///< "file:line" of the key, or "--set path=value"
    /// A lower layer overrides a higher one. An override has 0, the file itself 1, a file that it
    /// includes 2, and so on.
    int layer = 1;
    std::vector<ConfigNode> children; ///< in the order of the file

    const ConfigNode* find(const std::string& child) const;
};

/// The folder in which a path in the value is looked up: that of its file; empty for an option.
std::filesystem::path folder_of(const ConfigNode& node);

/// Reads a file. The first key of any section may be `include: other.yaml` (or a list of files),
/// whose keys become part of that section; the section's own keys override them. Paths are relative
/// to the including file. `place` begins the sentence about a file that cannot be read, "my.yaml:7:
/// ". Throws InputError.
ConfigNode read_config_file(const std::filesystem::path& path, const std::string& place = "");
/// Reads text in memory like a file; `name` stands for the file in messages, includes are relative
/// to it.
ConfigNode read_config_text(const std::string& name, const std::string& yaml);

// Limits far above any real configuration. They keep a hostile file from taking all time, memory or
// stack.
constexpr std::size_t kLargestConfigBytes = std::size_t{1} << 20;
constexpr std::size_t kMostConfigKeys = 4096; ///< in one section
constexpr std::size_t kDeepestConfig = 32;    ///< sections and lists inside each other
constexpr int kMostIncludes = 100; ///< in one read; ends chains that double at every step

} // namespace degs
