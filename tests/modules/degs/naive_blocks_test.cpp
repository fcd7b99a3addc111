// SPDX-License-Identifier: Apache-2.0
// Slicing Units, Span Units and slices of the array of random accelerators take and send what naive
// blocks do that follow their logs.
#include "tests/modules/degs/naive_blocks.hpp"
#include "tests/modules/degs/random_design.hpp"

namespace degs {
namespace {

using test::DegsRun;

/// The logs of all blocks of a kind.
class Logs {
public:
    template <class Block>
    explicit Logs(const std::vector<std::unique_ptr<Block>>& blocks) : logs_(blocks.size()) {
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            blocks[i]->log_to(logs_[i]);
        }
    }
    /// After the simulation.
    void expect_naive(const std::string& kind) const {
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            const std::string block = kind + ":" + std::to_string(i);
            const auto& facts = logs_[i].facts();
            EXPECT_EQ(test::naive_difference(block, {facts.begin(), facts.end()},
                                             test::events_of(logs_[i])),
                      "")
                << block;
        }
    }

private:
    std::vector<EventLog> logs_;
};

/// The sanitizers have the blocks of three designs (tests/sim/trace/block_log_test.cpp).
class NaiveBlocks : public ::testing::TestWithParam<unsigned> {};

TEST_P(NaiveBlocks, TakeAndSendTheSame) {
    test::Draw draw(GetParam());
    const DegsConfig config = draw.config(GetParam());
    SCOPED_TRACE(test::describe(config));
    const std::vector<FrameWorkload> frames = test::draw_frames(GetParam(), draw, config);
    const std::vector<const FrameWorkload*> list = test::pointers_to(frames);
    const DegsRun run("strict", config, list, Fidelity::Strict);
    const Logs slicing(run.degs().slicing()), spans(run.degs().spans());
    const Logs slices(run.degs().slices());
    sc_core::sc_start();
    spans.expect_naive("span");
    slices.expect_naive("slice");
    slicing.expect_naive("slicing");
}

INSTANTIATE_TEST_SUITE_P(Random, NaiveBlocks, ::testing::Range(3000U, 3060U));

} // namespace
} // namespace degs
