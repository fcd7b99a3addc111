// SPDX-License-Identifier: Apache-2.0
// The points of a study, before any of them runs.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "config/input_files.hpp"
#include "sim/goals/goals.hpp"
#include "sim/study/compare_request.hpp"
#include "sim/study/study_file.hpp"

namespace degs::sim {

/// A design with a value for every varied key.
struct StudyVariant {
    std::string name; ///< unique: the design and the keys that differ from its file
    std::string design;
    std::vector<std::string> values; ///< in the order of StudyPlan::keys
    std::string memory_model{};      ///< bus or lpddr5, of studies that vary the memory
    std::string memory_name{};       ///< what reports call it
};

/// A variant that cannot be built.
struct SkippedVariant {
    StudyVariant variant;
    std::string why; ///< a sentence
};

/// A variant on a view.
struct StudyPoint {
    std::size_t variant = 0, scene = 0, size = 0; ///< positions in the plan and its request
    int camera = 0;                               ///< position in the scene's list
    std::string key{}; ///< of everything that decides its results, 32 hexadecimal digits
};

/// Where designs run.
struct StudyView {
    std::size_t scene = 0, size = 0; ///< positions in the request
    int camera = 0;                  ///< position in the scene's list
};

struct StudyPlan {
    std::string name;
    std::vector<std::string> keys; ///< that the axes vary
    struct LinkedAxis {
        std::string name;
        std::vector<std::size_t> keys; ///< positions in `keys`
    };
    std::vector<LinkedAxis> linked; ///< axes of several keys that change together
    std::vector<StudyVariant> variants;
    std::size_t baseline = 0; ///< a variant
    std::vector<SkippedVariant> skipped;
    Aims aims;              ///< goals and limits of the study; neither decides what is run
    CompareRequest request; ///< one configuration for each variant; the points say on which views
    std::vector<StudyView> views;
    std::vector<StudyPoint> points;         ///< views in the outer, variants in the inner loop
    std::vector<std::string> scene_digests; ///< with their cameras
    std::shared_ptr<InputWatch> watch;      ///< since the digests of the scenes
    std::string digest;                     ///< of all points, 32 hexadecimal digits
};

/// The design of a variant and the values of all keys but those at the `along` positions, for
/// people: variants with the same text differ in those keys alone, so that numbers derived from
/// several points may take them together.
std::string text_without(const StudyPlan& plan, const StudyVariant& variant,
                         const std::set<std::size_t>& along);

/// Most points of a study, with those that cannot be built.
constexpr std::size_t kMostPoints = 100000;

/// Expands the designs and axes, checks every variant, and lists the cameras of each scene. The
/// baseline is the design that the study names with the values of its own file; it is added in
/// front if the axes do not have it. Throws InputError if a key, unit, name, scene or camera does
/// not exist, if there are more than kMostPoints points, and if no variant can be built.
StudyPlan plan_study(const Study& study);

/// The plan without a variant and a point, for spaces that are too large to be listed. Throws
/// InputError if a scene or camera does not exist.
StudyPlan plan_views(const Study& study);

/// What is run of a part of a plan: what the plan asks for, or estimates of single frames.
enum class PartRuns { AsPlanned, Estimates };

/// A plan with the same views for some of a plan's variants. The plan's baseline must be among
/// them.
StudyPlan part_of(const StudyPlan& plan, const std::vector<std::size_t>& variants, PartRuns runs);

} // namespace degs::sim
