// SPDX-License-Identifier: Apache-2.0
// The text that a person reads after a run. The commands print it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/simulation/run_result.hpp"
#include "sim/view/frame_facts.hpp"

namespace degs::sim {

/// Lines of a block: a name and its text.
using Block = std::vector<std::pair<std::string, std::string>>;
/// The names padded to one column; what they say is one line each, whatever it contains, unless it
/// is longer than output_columns().
std::string layout(const Block& block);

/// The summary of a run; `image_path` is where the image went.
std::string summary(const RunResult& result, const std::string& image_path);
/// Text of --explain: what the model left out and why, one sentence per line.
std::string explanation(const RunResult& result);
/// "flowers · 210 422 Gaussians, SH 2"
std::string scene_words(const SceneFacts& scene);
/// "1920×1080"
std::string size_words(const Camera& camera);

} // namespace degs::sim
