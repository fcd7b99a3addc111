// SPDX-License-Identifier: Apache-2.0
// A study as its file states it. docs/studies.md is the manual.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/sampling/sampling_request.hpp"
#include "sim/study/axis.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {

/// A configuration before anything of it is varied.
struct StudyDesign {
    std::string name;
    ConfigNode tree;
};

/// What is run of each design, and on which views.
struct StudyViews {
    std::vector<std::string> scenes; ///< as they are loaded
    std::string cameras = "0";       ///< positions, or "all"
    std::string camera_file;         ///< empty: the scenes' own
    std::string resolutions;         ///< names, separated by commas; empty: `width` decides
    std::optional<int> width;        ///< px; empty: the cameras' own
    std::string crop;                ///< of images in that size, see crop_of(); empty: none
    PathRequest path;
    bool analytic = false; ///< estimates in place of simulations
    bool array_only = false;
    bool reference = true;
};

/// What somebody wrote, and where: "study.yaml:7: key 'goals'", "--goals".
struct StatedText {
    std::string text, place;
};

struct Study : StudyViews {
    std::string name;
    std::vector<StudyDesign> designs;
    std::vector<std::string> overrides; ///< of the designs, see overrides_of(); not of the file
    std::string memory; ///< file that took the place of the designs' own memories; empty: none
    std::vector<Axis> axes;
    bool one_at_a_time = false; ///< an axis varies while the others keep the design's own values
    std::string baseline;       ///< name of a design; empty: the first
    StatedText goals, limits;   ///< see Aims; separated by commas
    std::optional<SamplingRequest> sampling;
};

/// Whether a file is a study, which lists designs, and not a single design.
bool is_study(const ConfigNode& tree);

/// The designs of a study. Throws InputError for one without a name and for an empty list.
std::vector<StudyDesign> read_designs(const ConfigNode& tree);

/// Throws InputError if a study has axes or a baseline, for which `degs sweep` is needed.
void check_designs_only(const ConfigNode& tree);

/// The views of the study in `file`, whose content is `tree`, or with `quick` those of its section
/// 'quick'. Throws InputError for mistakes in either, and if there is no section that is asked for.
StudyViews read_study_views(const ConfigNode& tree, const std::string& file, bool quick);

/// Reads a study; a configuration is a study of one design. Paths in it are relative to the file.
/// Throws InputError for what can be seen without loading designs and scenes.
/// With `quick`, the views are those of its section 'quick'.
Study read_study(const std::string& file, bool quick = false);

} // namespace degs::sim
