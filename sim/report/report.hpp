// SPDX-License-Identifier: Apache-2.0
// Results as JSON; docs/report.md is the schema.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "sim/simulation/run_result.hpp"
#include "sim/view/frame_facts.hpp"

namespace degs::sim {

/// Raised whenever a key changes its meaning, name or unit; new keys do not raise it.
constexpr int kReportVersion = 1;

nlohmann::ordered_json report(const RunResult& result);

/// The numbers of a report, with their units and what they mean: sections workload to buffers, then
/// energy to host.
void describe(const RunResult& result, StatsVisitor& visitor);

// Parts that other commands report too.
nlohmann::ordered_json tool_json();
nlohmann::ordered_json scene_json(const SceneFacts& scene);
nlohmann::ordered_json camera_json(const Camera& camera);
nlohmann::ordered_json changes_json(const FrameChanges& changes);
nlohmann::ordered_json workload_json(const WorkloadFacts& workload, const SceneFacts& scene);

} // namespace degs::sim
