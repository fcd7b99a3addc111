// SPDX-License-Identifier: Apache-2.0
// Traffic of buffers that energies follow, by hand.
#include <gtest/gtest.h>

#include "baselines/gbu/engine.hpp"
#include "baselines/gcc/engine.hpp"
#include "baselines/gscore/engine.hpp"
#include "baselines/orange/engine.hpp"

namespace degs {
namespace {

double operations_of(const std::vector<cost::Activity>& activity, const std::string& block) {
    for (const cost::Activity& each : activity) {
        if (each.block == block) {
            return each.operations;
        }
    }
    ADD_FAILURE() << "there is no " << block;
    return 0;
}

// Every cycle a splat of 32 B is written and read, and a key of 8 B in both steps of each sorter.
TEST(GscoreBill, BufferMovesASplatAndKeysPerCycle) {
    gscore::Config config;
    config.sorting.count = 3;
    EXPECT_EQ(config.bill().block("gaussian_buffer").full_rate, 2 * (32 + 2 * 3 * 8));
}

// A Gaussian passes two rings as a shape and two with a colour, an entry one; all written and read.
TEST(GccActivity, GroupsAreWrittenAndRead) {
    const gcc::Config config;
    gcc::Work work;
    work.means = 3;
    work.entries = 5;
    work.shapes = 7;
    work.coloured = 11;
    const auto activity = config.activity(work, false);
    EXPECT_EQ(operations_of(activity, "grouping"), 3);
    EXPECT_EQ(operations_of(activity, "group_buffer"),
              2 * (5 * config.traffic.list_entry_bytes + (2 * 7 + 2 * 11) * config.splat_bytes));
    work = {};
    work.records_fetched = 13;
    EXPECT_EQ(operations_of(config.activity(work, true), "group_buffer"),
              2 * 13 * config.splat_bytes);
}

TEST(GbuActivity, BuffersAreWrittenAndRead) {
    const gbu::Config config;
    gbu::Work work;
    work.splats_fetched = 3;
    work.entries_moved = 5;
    work.keys_moved = 7;
    work.lookups = 11;
    const auto activity = config.activity(work);
    EXPECT_EQ(operations_of(activity, "splat_buffer"), 2 * 3 * 32);
    EXPECT_EQ(operations_of(activity, "row_queues"), 5 * config.engines.entry_bytes);
    EXPECT_EQ(operations_of(activity, "list_buffer"), 7 * 8);
    EXPECT_EQ(operations_of(activity, "reuse_cache"), 11 * 32);
}

// Coefficients of every splat that is formed, but 64 pixels only of those that are blended.
TEST(OrangeActivity, EndedTilesAreNotBlended) {
    const orange::Config config;
    orange::Work work;
    work.formed = 5;
    work.blended = 3;
    EXPECT_EQ(operations_of(config.activity(work), "vector_units"),
              5 * config.cores.vector.coefficient_operations +
                  3 * 64 * config.cores.vector.blend_operations);
}

} // namespace
} // namespace degs
