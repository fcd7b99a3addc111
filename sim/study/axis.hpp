// SPDX-License-Identifier: Apache-2.0
// What a study varies. docs/studies.md is the manual of the grammar.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "config/config_document.hpp"
#include "config/config_tree.hpp"
#include "config/quantity.hpp"

namespace degs::sim {

/// A drawn position between two bounds, for a key whose type decides which values lie there.
struct Draw {
    Quantity low, high;
    bool logarithmic = false;
    double position = 0; ///< [0, 1)
};

/// One value of one key, as written or computed from a range.
struct AxisValue {
    std::string place; ///< "study.yaml:7"
    std::string text;  ///< as written, or the path of a file; empty if it comes from a range
    std::optional<Quantity> quantity;
    std::optional<Draw> draw;
};

/// One or several keys that change together.
struct Axis {
    std::string name;
    std::string place;
    std::vector<std::string> keys;
    std::vector<std::vector<AxisValue>> positions; ///< a value for each key
    bool random = false;                           ///< positions that coincide count once
};

/// Reads one entry of the section `axes` of a study in this folder. Throws InputError.
Axis read_axis(const ConfigNode& node, const std::filesystem::path& folder = {});

/// The section whose file an axis varies: "cost" of the key "cost.include"; empty for other keys.
std::optional<std::string> including_section(const std::string& key);

/// As results name the file of such a key: "7nm" for "cost/7nm.yaml".
std::string file_word(const AxisValue& value);

/// Most positions of one axis; a typing error in a step should not fill the memory.
constexpr std::size_t kMostAxisPositions = 4096;

/// The value as text for a configuration file, in the unit of `key`, which has the design's own
/// value. Throws InputError for a unit that does not fit, for a word in place of a number, and for
/// a choice that the key does not have; ranges are left to the configuration.
std::string value_text(const AxisValue& value, const KeyDoc& key);

} // namespace degs::sim
