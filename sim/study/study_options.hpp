// SPDX-License-Identifier: Apache-2.0
// The options of commands that take a study. Not in study_file.hpp, because CLI11 costs seconds in
// every source that sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "sim/study/study_file.hpp"

namespace degs::sim {

/// What replaces the views that a study states.
struct ViewOptions {
    std::vector<std::string> scenes;
    std::string cameras, camera_file, resolutions;
    std::optional<int> width;
    std::string crop;
    PathRequest path;
    bool has_frames = false, has_step = false, has_units = false;
    std::string fidelity; ///< empty: the study's own
    std::optional<std::string> within;
    std::uint64_t seed = 1;
    bool quick = false, array_only = false, no_reference = false;
};

/// A study's file, and what replaces the values of its designs and its views.
struct StudyOptions : ViewOptions {
    std::string file;
    std::vector<std::string> overrides;
    std::string memory; ///< file of --memory; empty: the designs' own
};

void add_study_options(CLI::App& command, StudyOptions& options);

/// The options of ViewOptions.
void add_study_view_options(CLI::App& command, ViewOptions& options);

/// Puts what the options say in the place of what the study says.
void replace_views(const ViewOptions& options, StudyViews& views);

/// Reads the study. Throws InputError.
Study study_of(const StudyOptions& options);

} // namespace degs::sim
