// SPDX-License-Identifier: Apache-2.0
#include "sim/study/study_keys.hpp"

#include <algorithm>
#include <cctype>

#include "scene/files/image_io.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

constexpr int kMostFramesOfStudy = 10000; ///< as --frames

/// One item, or several with commas between them.
std::string with_commas(const std::string& item) {
    return "^(" + item + ")(,(" + item + "))*$";
}

/// Widths and heights, and the names of resolutions in capital and small letters.
std::string resolution_pattern() {
    std::string names = "[0-9]+[xX][0-9]+";
    for (const std::string& name : resolution_names()) {
        names += "|";
        for (const char c : name) {
            const auto letter = static_cast<unsigned char>(c);
            const char capital = static_cast<char>(std::toupper(letter));
            names +=
                std::isalpha(letter) != 0 ? std::string{'[', c, capital, ']'} : std::string(1, c);
        }
    }
    return with_commas(names);
}

StudyKey within(double low, double high, StudyKey key) {
    key.low = low;
    key.high = high;
    return key;
}

StudyKey one_of(const std::vector<const char*>& words, StudyKey key) {
    key.words = words;
    return key;
}

StudyKey like(const std::string& pattern, StudyKey key) {
    key.pattern = pattern;
    return key;
}

StudyKey in_quick(StudyKey key) {
    key.in_quick = true;
    return key;
}

StudyKey of_sweep(StudyKey key) {
    key.of_sweep = true;
    return key;
}

std::vector<StudyKey> keys_of_designs() {
    return {
        {"study", StudyKind::kText, "name of the study; by default that of the file"},
        {"points", StudyKind::kDesigns, "another name of designs"},
        {"designs", StudyKind::kDesigns, "list of designs; each needs a name of its own"},
        of_sweep({"axes", StudyKind::kAxes, "what is varied: keys with their values"}),
        of_sweep(one_of({"product", "one_at_a_time"},
                        {"combine", StudyKind::kChoice,
                         "product: every value of an axis with every value of the others; "
                         "one_at_a_time: one axis varies while the others keep the design's own "
                         "values",
                         "product"})),
        of_sweep({"baseline", StudyKind::kText,
                  "name of the design with which all points are compared; by default the first"}),
        of_sweep({"goals", StudyKind::kWords,
                  "what a search makes least or most: measures or expressions"}),
        of_sweep({"limits", StudyKind::kWords, "what a design has to keep, like area_mm2<=2.5"}),
    };
}

std::vector<StudyKey> keys_of_views() {
    return {
        in_quick(
            {"scenes", StudyKind::kWords, "a scene or a list of them: files or synthetic:NAME"}),
        in_quick(like(
            "^all$|" + with_commas("[0-9]+"),
            {"cameras", StudyKind::kWords, "positions in each scene's list from 0, or all", "0"})),
        in_quick(within(1, kMostImageSide,
                        {"width", StudyKind::kInteger, "px; by default the cameras' own size"})),
        in_quick({"crop", StudyKind::kText, "part of the images, X,Y,WxH in pixels of that size"}),
        in_quick(within(
            0, kMostEyeDistance,
            {"eyes", StudyKind::kReal, "distance of two eyes, m: each frame has two views"})),
        within(kLeastUnitsPerMetre, kMostUnitsPerMetre,
               {"units_per_metre", StudyKind::kReal, "scene units for a metre of eyes", "1"}),
        in_quick(like("^[0-9]+(,[0-9]+)*$",
                      {"views", StudyKind::kWords,
                       "positions of cameras that are the views of one frame, in place of "
                       "cameras"})),
        {"camera_file", StudyKind::kText, "a file of cameras in place of the scenes' own"},
        in_quick(
            within(1, kMostFramesOfStudy,
                   {"frames", StudyKind::kInteger, "of a camera path for the throughput", "1"})),
        in_quick(like(resolution_pattern(),
                      {"resolutions", StudyKind::kWords, "image sizes, in place of width"})),
        within(-kMostPathStepDegrees, kMostPathStepDegrees,
               {"path_step", StudyKind::kReal, "degrees between two frames of the camera path"}),
        {"array_only", StudyKind::kBoolean, "the rasterisation arrays alone", "false"},
        {"reference", StudyKind::kBoolean, "image errors against double precision", "true"},
        one_of({"exact", "analytic"}, {"fidelity", StudyKind::kChoice,
                                       "analytic: estimates in place of simulations", "exact"}),
        {"quick", StudyKind::kViews, "other views, which --quick takes"},
    };
}

} // namespace

const std::vector<StudyKey>& study_keys() {
    static const std::vector<StudyKey> keys = [] {
        std::vector<StudyKey> all = keys_of_designs();
        const std::vector<StudyKey> views = keys_of_views();
        all.insert(all.end(), views.begin(), views.end());
        return all;
    }();
    return keys;
}

const StudyKey& study_key(const std::string& name) {
    const std::vector<StudyKey>& keys = study_keys();
    return *std::find_if(keys.begin(), keys.end(),
                         [&name](const StudyKey& key) { return key.name == name; });
}

} // namespace degs::sim
