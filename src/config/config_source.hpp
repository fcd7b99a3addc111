// SPDX-License-Identifier: Apache-2.0
// The source of a configuration: a YAML file, overridden by `--set path.to.key=value`.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "config/config.hpp"
#include "config/config_tree.hpp"

namespace degs {

/// The source is strict: load() throws InputError for every key that the struct does not have and
/// for every value that it cannot take. Keys that the source does not name keep their defaults.
///
/// Values:
/// * Integers are decimal digits (no 1e3, no 0x10, no leading zero).
/// * Reals are finite decimal numbers.
/// * Booleans are true or false, and choices go by name.
/// * A scalar in quotes is always text.
class ConfigSource {
public:
    /// Each override reads `path.to.key=value`; a later one of the same key wins over an earlier
    /// one.
    static ConfigSource from_file(const std::filesystem::path& path,
                                  const std::vector<std::string>& overrides = {});
    /// `name` stands for the file in messages; includes are relative to its folder.
    static ConfigSource from_text(const std::string& name, const std::string& yaml,
                                  const std::vector<std::string>& overrides = {});
    /// Takes a part of another source's tree, e.g. an item of a list.
    static ConfigSource from_tree(ConfigNode tree, const std::vector<std::string>& overrides = {}) {
        return {std::move(tree), overrides};
    }
    /// Defaults and overrides only; messages call them by `option`. load() then also checks a
    /// struct that a program has filled itself.
    static ConfigSource from_overrides(const std::vector<std::string>& overrides = {},
                                       const std::string& option = "--set");

    /// Fills any struct with `void describe(ConfigVisitor&)`; leaves it untouched when it throws.
    /// Returns a sentence for every key of the source that has no effect.
    template <class Config>
    std::vector<std::string> load(Config& config) const {
        Config loaded = config;
        std::vector<std::string> warnings =
            read([&](ConfigVisitor& visitor) { loaded.describe(visitor); });
        config = loaded;
        return warnings;
    }

    /// Reads values into everything that the function visits, and returns sentences like load().
    std::vector<std::string> read(const std::function<void(ConfigVisitor&)>& describe) const;

    /// Returns "file:line" or "--set path=value" of the text that decides a key, "default" if
    /// nothing names it.
    std::string place(const std::string& path) const;
    /// Returns the folder of the file that decides a key; empty if an override or nothing does.
    std::string folder(const std::string& path) const;
    /// The files as one tree, before overrides, for callers that read lists.
    const ConfigNode& tree() const { return root_; }

private:
    friend class ConfigReader;
    struct Override {
        std::string path;
        ConfigNode value;
    };

    ConfigSource(ConfigNode root, const std::vector<std::string>& overrides,
                 const std::string& option = "--set");
    /// The strongest statement of the source about a path, or about keys below it.
    struct Given {
        const ConfigNode* node = nullptr; ///< nullptr: nothing
        std::string path;
    };
    Given strongest(const std::string& path) const;
    const Override* override_of(const std::string& path) const;
    const ConfigNode* node_of(const std::string& path) const; // in the files

    ConfigNode root_;
    std::vector<Override> overrides_;
};

} // namespace degs
