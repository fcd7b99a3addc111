// SPDX-License-Identifier: Apache-2.0
// Every cause and key that an accelerator can name has a situation in which `degs run` names it,
// and in which to follow it lowers the loss.
#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "sim/design/run_config.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/report/advised_keys.hpp"

namespace degs::sim_test {
namespace {

/// Accelerator, cause and keys.
using Entry = std::tuple<std::string, std::string, std::string>;

std::string text_of(const Entry& entry) {
    return std::get<0>(entry) + ", " + std::get<1>(entry) + ": " + std::get<2>(entry);
}

/// degs, gscore, gbu, gcc or orange: the first word of the design.
std::string family_of(const std::string& design) {
    return design.substr(0, design.find('-'));
}

/// Adds the entries of a design; none if the settings are refused.
void add_entries(const std::string& design, const Settings& settings, std::set<Entry>& entries) {
    try {
        const sim::RunConfig run = sim::load_run_config(config(design), settings);
        for (const LossKey& key : run.accelerator().loss_keys()) {
            entries.insert({family_of(design), key.cause, key.name()});
        }
    } catch (const InputError&) {
    }
}

/// Entries of all designs of configs, with settings that decide which entries there are.
std::set<Entry> all_entries() {
    std::set<Entry> entries;
    for (const auto& file : fs::directory_iterator(DEGS_CONFIGS)) {
        const std::string design = file.path().stem().string();
        for (const char* const setting :
             {"memory.model=bus", "memory.model=lpddr5", "scheduler.queue_segments_per_pe=0",
              "span.parsing=false", "span.rows=pool", "scheduler.issue_width=1",
              "scheduler.segments_per_cycle=1", "clusters=2", "sorting.count=1",
              "sorting.count=32"}) {
            if (file.is_regular_file()) {
                add_entries(design, {setting}, entries);
            }
        }
    }
    for (const AdvisedKeys& advised : advised_keys()) {
        add_entries(advised.view.design, advised.view.settings, entries);
    }
    return entries;
}

TEST(AdvisedKeys, AreAllThatAcceleratorsName) {
    std::set<Entry> advised;
    for (const AdvisedKeys& situation : advised_keys()) {
        for (const AdvisedKeys::Entry& entry : situation.entries) {
            advised.insert({family_of(situation.view.design), entry.cause, entry.key});
        }
    }
    const std::set<Entry> all = all_entries();
    EXPECT_GT(all.size(), 100U);
    for (const Entry& entry : all) {
        EXPECT_EQ(advised.count(entry), 1U) << text_of(entry) << " has no situation";
    }
    for (const Entry& entry : advised) {
        EXPECT_EQ(all.count(entry), 1U) << text_of(entry) << " is no entry";
    }
}

/// Whether a loss of this reason can have this cause, see LossKey.
bool can_have(const std::string& reason, const std::string& cause) {
    const std::string late = ", for the latency of memory";
    if (cause == "gaps") {
        return reason == "starved";
    }
    if (cause == "answers" || cause == "acknowledgements") {
        return reason == "starved" + late || (cause != "answers" && reason == "blocked" + late);
    }
    if (cause == "latency") {
        return reason == "before the first task" || reason == "after the last task";
    }
    return reason == cause || (cause == "readout" && reason == "after the last task") ||
           (cause == "memory" && reason == "after the last task") ||
           reason == "starved, for " + cause || reason == "blocked, for " + cause ||
           reason == "before the first task, for " + cause;
}

/// "raise KEY" and "KEY=VALUE" are KEY.
std::string key_of(const std::string& advice) {
    const std::size_t space = advice.find(' ');
    return space == std::string::npos ? advice.substr(0, advice.find('='))
                                      : advice.substr(space + 1);
}

void expect_named_and_lower(const AdvisedKeys& advised) {
    constexpr double kLeast = 0.02; // of the frame
    // The situations are balanced for lists without tiles that no pixel of a splat is in.
    AdvisedView view = advised.view;
    view.settings.insert(view.settings.begin(), "pipeline.tiles=exact");
    const auto before = report_with(view);
    ASSERT_TRUE(before);
    for (const auto& [cause, key] : advised.entries) {
        std::string failures = "not named";
        for (const auto& loss : (*before)["losses"]) {
            if (loss["share"] < kLeast || !can_have(loss["reason"], cause)) {
                continue;
            }
            for (const std::string advice : loss["keys"]) {
                if (key_of(advice) == key && !failures.empty()) {
                    failures = failure_of(advice, loss["reason"], view, *before);
                }
            }
        }
        EXPECT_EQ(failures, "") << cause << ": " << key;
    }
}

/// Every ninth situation, which are of all accelerators, or the others.
std::vector<AdvisedKeys> situations(bool core) {
    constexpr std::size_t kStep = 9;
    const std::vector<AdvisedKeys> all = advised_keys();
    std::vector<AdvisedKeys> chosen;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if ((i % kStep == 0) == core) {
            chosen.push_back(all[i]);
        }
    }
    return chosen;
}

std::string situation_name(const ::testing::TestParamInfo<AdvisedKeys>& situation) {
    std::string name = situation.param.view.design;
    std::replace(name.begin(), name.end(), '-', '_');
    return name + "_" + std::to_string(situation.index);
}

class AdvisedKey : public ::testing::TestWithParam<AdvisedKeys> {};

TEST_P(AdvisedKey, IsNamedAndLowersTheLoss) {
    expect_named_and_lower(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Situations, AdvisedKey, ::testing::ValuesIn(situations(true)),
                         situation_name);

class LongAdvisedKey : public ::testing::TestWithParam<AdvisedKeys> {};

TEST_P(LongAdvisedKey, IsNamedAndLowersTheLoss) {
    expect_named_and_lower(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Situations, LongAdvisedKey, ::testing::ValuesIn(situations(false)),
                         situation_name);

} // namespace
} // namespace degs::sim_test
