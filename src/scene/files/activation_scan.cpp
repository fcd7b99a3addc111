// SPDX-License-Identifier: Apache-2.0
#include "scene/files/activation_scan.hpp"

namespace degs {
namespace {

/// "No scale is negative and no opacity outside 0 to 1".
std::string evidence(bool scales, bool opacities) {
    return std::string("No ") + (scales ? "scale is negative" : "") +
           (scales && opacities ? " and no " : "") +
           (opacities ? std::string("opacity") + (scales ? "" : " is") + " outside 0 to 1" : "");
}

} // namespace

std::string activated_note(const ActivationScan& scan, std::size_t count) {
    const bool scales = scan.scales_look_activated();
    const bool opacities = scan.opacities_look_activated();
    if (count < kFewestToJudge || (!scales && !opacities)) {
        return "";
    }
    const bool both = scales && opacities;
    return evidence(scales, opacities) + ", so the file seems to hold " +
           (both     ? "both"
            : scales ? "its scales"
                     : "its opacities") +
           " as they are; they were read as " +
           (both     ? "logarithms and logits"
            : scales ? "logarithms"
                     : "logits") +
           ", as its format says.";
}

std::string activated_note(const std::vector<glm::vec3>& scales) {
    ActivationScan scan;
    scan.add_opacity(-1);
    for (std::size_t i = 0; i < scales.size() && scan.scales_look_activated(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            scan.add_scale(scales[i][axis] < 1 ? -1 : 0); // of the logarithm
        }
    }
    return activated_note(scan, scales.size());
}

std::string taken_as_they_are_note(bool scales, bool opacities) {
    if (!scales && !opacities) {
        return "";
    }
    const bool both = scales && opacities;
    return evidence(scales, opacities) + ", so " +
           (both     ? "both"
            : scales ? "the scales"
                     : "the opacities") +
           " were taken as they are, not as " +
           (both     ? "logarithms and logits"
            : scales ? "logarithms"
                     : "logits") +
           ".";
}

} // namespace degs
