// SPDX-License-Identifier: Apache-2.0
// Every key that `degs run` names for a loss lowers this loss and does not lengthen the frame, in
// more situations than advised_keys_test.cpp has, which tries every key.
#include <gtest/gtest.h>

#include "tests/sim/report/advice.hpp"

namespace degs::sim_test {
namespace {

struct Situation {
    const char* name;
    const char* design;
    Settings settings;
};

class LongAdvice : public ::testing::TestWithParam<Situation> {};

// All advice for every loss of some size.
TEST_P(LongAdvice, LowersTheLoss) {
    const AdvisedView view{GetParam().design, GetParam().settings};
    const auto before = report_with(view);
    ASSERT_TRUE(before);
    int followed = 0;
    for (const auto& loss : (*before)["losses"]) {
        for (const std::string advice : loss["keys"]) {
            if (loss["share"] >= 0.05) {
                EXPECT_EQ(failure_of(advice, loss["reason"], view, *before), "");
                ++followed;
            }
        }
    }
    EXPECT_GT(followed, 0);
}

INSTANTIATE_TEST_SUITE_P(
    Situations, LongAdvice,
    ::testing::Values(
        Situation{"degs", "degs-64", {}}, Situation{"gscore", "gscore-64", {}},
        Situation{"gbu", "gbu-64", {}}, Situation{"gcc", "gcc-64", {}},
        Situation{"degs_tuned", "degs-64-tuned", {}}, Situation{"orange", "orange-o1", {}},
        Situation{"orange_cores", "orange-o4", {}},
        Situation{"orange_few_lanes", "orange-o1", {"cores.vector.lanes=64"}},
        Situation{"degs_fast_memory", "degs-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gscore_fast_memory", "gscore-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gbu_fast_memory", "gbu-64", {"memory.bandwidth_gb_per_s=2000"}},
        Situation{"gcc_slow_memory", "gcc-64", {"memory.bandwidth_gb_per_s=20"}},
        Situation{"degs_few_slicing_units", "degs-64", {"slicing.count=1", "memory.latency_ns=0"}},
        Situation{"degs_slow_sorting", "degs-64", {"sorting.keys_per_cycle=1", "sorting.count=1"}},
        Situation{"degs_small_pixel_buffer", "degs-64", {"pixel_buffer.readout_pixels=1"}},
        Situation{"degs_few_ports", "degs-64", {"pixel_buffer.ports=1"}},
        Situation{"degs_x", "degs-x-64", {}}, Situation{"degs_clusters", "degs-64", {"clusters=4"}},
        Situation{"degs_one_span_unit", "degs-64", {"span.count=1"}},
        Situation{"degs_narrow_issue", "degs-64", {"scheduler.issue_width=1"}},
        Situation{"degs_narrow_intake",
                  "degs-64",
                  {"scheduler.segments_per_cycle=1", "scheduler.issue_width=4", "span.count=16",
                   "slicing.count=4"}},
        Situation{"degs_slow_projection",
                  "degs-64",
                  {"projection.count=1", "memory.bandwidth_gb_per_s=2000"}},
        Situation{
            "degs_slow_binning",
            "degs-64",
            {"binning.pairs_per_cycle=1", "projection.count=64", "memory.bandwidth_gb_per_s=2000"}},
        Situation{"degs_ended_segments", "degs-64", {"scheduler.termination=task"}},
        Situation{"degs_without_parsing", "degs-64", {"span.parsing=false"}},
        Situation{"degs_slow_memory", "degs-64", {"memory.bandwidth_gb_per_s=10"}},
        Situation{
            "degs_one_channel", "degs-64", {"memory.model=lpddr5", "memory.lpddr5.channels=1"}},
        Situation{"gcc_slow_grouping", "gcc-64", {"grouping.means_per_cycle=1"}},
        Situation{"gcc_slow_entries", "gcc-64", {"grouping.entries_per_cycle=1", "view_size=32"}},
        Situation{"gcc_slow_projection",
                  "gcc-64",
                  {"projection.units=1", "projection.cycles_per_gaussian=32"}},
        Situation{"gcc_slow_colour", "gcc-64", {"colour.units=1", "colour.cycles_per_colour=32"}},
        Situation{"gcc_discovery", "gcc-64", {"array.discovery_cycles=8"}},
        Situation{"gcc_skip", "gcc-64", {"array.skip_cycles=8"}},
        Situation{"gcc_readout", "gcc-64", {"image_buffer.readout_pixels=1"}},
        Situation{"gcc_clusters", "gcc-64", {"clusters=4"}},
        Situation{
            "gscore_slow_sorting", "gscore-64", {"sorting.count=1", "sorting.keys_per_cycle=1"}},
        Situation{"gscore_slow_projection",
                  "gscore-64",
                  {"projection.count=1", "memory.bandwidth_gb_per_s=2000"}},
        Situation{"gscore_readout", "gscore-64", {"pixel_buffer.readout_pixels=1"}},
        Situation{"gscore_clusters", "gscore-64", {"clusters=4"}},
        Situation{"gscore_slow_ends", "gscore-64", {"array.termination_cycles=16"}},
        Situation{"gbu_readout", "gbu-64", {"pixel_buffer.readout_pixels=1"}},
        Situation{"gbu_slow_sorting", "gbu-64", {"sorting.count=1", "sorting.keys_per_cycle=1"}},
        Situation{"degs_late_memory", "degs-64-tuned", {"memory.latency_ns=4000"}},
        Situation{"degs_x_late_memory", "degs-x-64", {"memory.latency_ns=1000"}},
        Situation{"gscore_late_memory", "gscore-64", {"memory.latency_ns=4000"}},
        Situation{"gbu_late_memory", "gbu-64", {"memory.latency_ns=1000"}},
        Situation{"gcc_late_memory", "gcc-64", {"memory.latency_ns=4000"}},
        Situation{"orange_late_memory", "orange-o1", {"memory.latency_ns=4000"}},
        Situation{"orange_cores_late_memory", "orange-o4", {"memory.latency_ns=4000"}},
        Situation{"orange_readout", "orange-o1", {"pixel_buffer.readout_pixels=1"}},
        Situation{
            "orange_slow_sorting", "orange-o4", {"sorting.count=1", "sorting.keys_per_cycle=1"}}),
    [](const auto& situation) { return situation.param.name; });

} // namespace
} // namespace degs::sim_test
