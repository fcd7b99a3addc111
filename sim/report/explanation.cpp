// SPDX-License-Identifier: Apache-2.0
// --explain: the cost of a run follows its work, and this is the work that was left out. Every
// sentence comes from the part of the model that leaves it out.
#include "sim/report/terminal.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs::sim {

std::string explanation(const RunResult& result) {
    std::vector<std::string> sentences;
    if (result.scene.dropped.total() != 0) {
        sentences.push_back(result.scene.dropped.explain());
    }
    sentences.push_back(result.workload.culled.explain());
    sentences.push_back(explain_sh(result.scene.sh_degree));
    sentences.insert(sentences.end(), result.accelerator.left_out.begin(),
                     result.accelerator.left_out.end());
    std::string text = "left out, and why:\n";
    for (const std::string& sentence : sentences) {
        text += "- " + sentence + "\n";
    }
    return text;
}

} // namespace degs::sim
