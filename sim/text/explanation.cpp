// SPDX-License-Identifier: Apache-2.0
// --explain: cost follows the work, and this says which work there was none of.
#include "sim/text/terminal.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

std::string sh_sentence(int degree) {
    if (degree == 3) {
        return "The scene has all SH bands (degree 3): nothing of the colour is left out.";
    }
    const int left_out = 3 * (16 - (degree + 1) * (degree + 1));
    return "The scene has SH degree " + std::to_string(degree) + ": the " +
           std::to_string(left_out) +
           " coefficients of higher bands are neither read nor evaluated.";
}

std::string culled_sentence(const WorkloadFacts& workload) {
    const CullCounts& c = workload.culled;
    return grouped(workload.gaussians - workload.visible) +
           " Gaussians were culled after their geometry was read, so that their colours were "
           "not: " +
           grouped(c.off_screen) + " touch no pixel, " + grouped(c.near) +
           " are nearer than the near plane, " + grouped(c.transparent) +
           " are fainter than 1/255, " + grouped(c.degenerate) + " have no finite projection.";
}

std::string dropped_sentence(const SanitizeReport& dropped) {
    return grouped(dropped.total()) + " Gaussians of the file cannot be drawn and were dropped: " +
           grouped(dropped.non_finite) + " hold NaN or infinity, " +
           grouped(dropped.zero_rotation) + " a rotation of length zero, " +
           grouped(dropped.bad_scale) + " a negative scale, " + grouped(dropped.bad_opacity) +
           " an opacity outside 0 to 1.";
}

} // namespace

std::string explanation(const RunResult& result) {
    std::vector<std::string> sentences;
    if (result.scene.dropped.total() != 0) {
        sentences.push_back(dropped_sentence(result.scene.dropped));
    }
    sentences.push_back(culled_sentence(result.workload));
    sentences.push_back(sh_sentence(result.scene.sh_degree));
    sentences.insert(sentences.end(), result.accelerator.left_out.begin(),
                     result.accelerator.left_out.end());
    sentences.emplace_back("Energy is not reported: this version has no energy model.");
    std::string text = "left out, and why:\n";
    for (const std::string& sentence : sentences) {
        text += "- " + sentence + "\n";
    }
    return text;
}

} // namespace degs::sim
