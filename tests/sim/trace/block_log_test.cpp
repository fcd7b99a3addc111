// SPDX-License-Identifier: Apache-2.0
// --block-log: the logs of blocks that face each other agree, and a naive bank follows them on
// trained scenes.
#include "tests/modules/degs/naive_blocks.hpp"
#include "tests/sim/trace/block_log.hpp"

namespace degs::sim_test {
namespace {

const std::vector<std::string> kSmall{"--scene", "synthetic:object,gaussians=1000", "--width",
                                      "160"};

// What one block sends another one takes, in the order in which it was sent. Span Unit 3 is the
// only one that reaches bank 3.
TEST(SmallRunBlockLog, NeighboursAgree) {
    const BlockLog bank = logged(kSmall, "degs-64", "bank:3");
    const BlockLog slice = logged(kSmall, "degs-64", "slice:3");
    const BlockLog span = logged(kSmall, "degs-64", "span:3");
    EXPECT_GT(bank.count("issue"), 100U);
    EXPECT_EQ(bank.count("packet"), slice.count("packet"));
    EXPECT_EQ(bank.count("terminated"), slice.count("terminated"));
    EXPECT_EQ(bank.count("span"), span.count("span"));
    std::vector<std::int64_t> sent, taken;
    for (const auto& event : bank.events) {
        if (event.kind() == "packet" && event["tasks"] != 0) {
            sent.push_back(event["slot"]);
        }
    }
    for (const auto& event : slice.events) {
        if (event.kind() == "packet" && event["tasks"] != 0) {
            taken.push_back(static_cast<std::int64_t>(event.now)); // it executes then
        }
    }
    EXPECT_EQ(sent, taken);
}

// What a slice says is known to its bank when the pixels have been written back.
TEST(SmallRunBlockLog, EndedPixelsAreKnownAfterTheWriteBack) {
    const BlockLog bank = logged(kSmall, "degs-64", "bank:3");
    const BlockLog slice = logged(kSmall, "degs-64", "slice:3");
    std::vector<std::int64_t> said, known;
    for (const auto& event : slice.events) {
        if (event.kind() == "terminated") {
            said.push_back(static_cast<std::int64_t>(event.now) +
                           slice.facts().at("writeback_cycles"));
        }
    }
    for (const auto& event : bank.events) {
        if (event.kind() == "terminated") {
            known.push_back(static_cast<std::int64_t>(event.now) - event["waited"]);
        }
    }
    EXPECT_GT(said.size(), 0U);
    EXPECT_EQ(said, known);
}

// The lanes that Slicing Units feed are those from which Span Units take rows.
TEST(BlockLog, RowsOfTheSlicingUnitsAreThoseOfTheSpanUnits) {
    const BlockLog slicing = logged(kSmall, "degs-64", "slicing:0");
    std::size_t rows = 0;
    for (int unit = 0; unit < 8; ++unit) {
        rows += logged(kSmall, "degs-64", "span:" + std::to_string(unit)).count("row");
    }
    EXPECT_EQ(slicing.count("row"), rows);
    EXPECT_GT(slicing.count("chunk"), 0U);
}

struct Refused {
    const char* name;
    std::vector<std::string> words;
    const char* sentence;
};
std::ostream& operator<<(std::ostream& out, const Refused& refused) {
    return out << refused.name;
}

class HostileBlockLog : public testing::TestWithParam<Refused> {};

TEST_P(HostileBlockLog, IsRefusedInASentence) {
    const Folder folder;
    std::vector<std::string> arguments{"run"};
    const Refused& refused = GetParam();
    arguments.push_back(config(refused.words.front()));
    arguments.insert(arguments.end(), kSmall.begin(), kSmall.end());
    arguments.insert(arguments.end(), {"--out", folder / "out", "--block-log"});
    arguments.insert(arguments.end(), refused.words.begin() + 1, refused.words.end());
    if (refused.words.size() == 2) {
        arguments.push_back(folder / "log");
    }
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find(refused.sentence), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder / "log"));
}

INSTANTIATE_TEST_SUITE_P(
    All, HostileBlockLog,
    testing::Values(
        Refused{"number", {"degs-64", "bank:8"}, "there are slicing:0 to 0, span:0 to 7, bank:0"},
        Refused{"kind", {"degs-64", "blender:0"}, "--block-log blender:0: degs-64 has no such"},
        Refused{"empty", {"degs-64", ""}, "has no such block"},
        Refused{"design", {"gcc-64", "bank:0"}, "gcc-64 has no block that writes a log."},
        Refused{"folder", {"degs-64", "bank:0", "/dev/null/log"}, "/dev/null"},
        Refused{"sample",
                {"degs-64", "bank:0", "log", "--fidelity", "sampled:50%"},
                "--block-log needs every tile"},
        Refused{"estimate",
                {"degs-64", "bank:0", "log", "--fidelity", "analytic"},
                "--block-log needs a simulation"}),
    [](const auto& refused) { return refused.param.name; });

/// A view of a trained scene, a design and one of its banks.
struct Followed {
    const char* scene;
    const char* camera;
    const char* design;
    const char* bank;
    const char* select_cycles = "0";
};
std::ostream& operator<<(std::ostream& out, const Followed& followed) {
    return out << followed.scene << " " << followed.design << " " << followed.select_cycles;
}

void expect_naive_bank(const Followed& f) {
    const fs::path scene = trained_scenes() / f.scene / "scene.ply";
    if (!fs::exists(scene)) {
        GTEST_SKIP() << "the trained scene " << f.scene << " is not in " << trained_scenes()
                     << "; set DEGS_SCENES";
    }
    const BlockLog log =
        logged({"--scene", scene.string(), "--camera", f.camera, "--width", "360", "--set",
                std::string("scheduler.select_cycles=") + f.select_cycles},
               f.design, f.bank);
    EXPECT_GT(log.count("packet"), 10000U);
    degs::test::NaiveBank naive(degs::test::NaiveFacts(log.facts()), log.events);
    EXPECT_EQ(degs::test::first_difference(degs::test::lines_of(log.events), naive.run()), "");
}

class TrainedBlockLog : public testing::TestWithParam<Followed> {};

TEST_P(TrainedBlockLog, IsThatOfANaiveBank) {
    expect_naive_bank(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, TrainedBlockLog,
                         testing::Values(Followed{"flowers", "2", "degs-64", "bank:0"},
                                         Followed{"flowers", "2", "degs-x-64", "bank:1"}));

class LongTrainedBlockLog : public testing::TestWithParam<Followed> {};

TEST_P(LongTrainedBlockLog, IsThatOfANaiveBank) {
    expect_naive_bank(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Scenes, LongTrainedBlockLog,
                         testing::Values(Followed{"flowers", "2", "degs-64", "bank:0", "2"},
                                         Followed{"st-peter", "2", "degs-64", "bank:3"},
                                         Followed{"st-peter", "2", "degs-64-tuned", "bank:6"},
                                         Followed{"guitar", "1", "degs-64", "bank:5"},
                                         Followed{"guitar", "1", "degs-1024", "bank:17"}));

/// A design and one of its Slicing Units, Span Units or slices of the array.
struct Other {
    const char* design;
    const char* block;
    std::vector<std::string> settings;
};
std::ostream& operator<<(std::ostream& out, const Other& other) {
    return out << other.design << " " << other.block << " " << other.settings.size();
}

std::vector<std::string> with_settings(std::vector<std::string> view, const Other& other) {
    for (const std::string& setting : other.settings) {
        view.insert(view.end(), {"--set", setting});
    }
    return view;
}

void expect_naive_block(const Other& other, const std::vector<std::string>& view,
                        std::size_t least) {
    const BlockLog log = logged(with_settings(view, other), other.design, other.block);
    EXPECT_GT(log.events.size(), least);
    EXPECT_EQ(degs::test::naive_difference(other.block, log.facts(), log.events), "");
}

class SmallRunNaiveBlock : public testing::TestWithParam<Other> {};

TEST_P(SmallRunNaiveBlock, TakesAndSendsTheSame) {
    expect_naive_block(GetParam(), kSmall, 100);
}

const Other kOthers[] = {
    {"degs-64", "span:3", {}},        {"degs-64", "slicing:0", {}},
    {"degs-64", "slice:3", {}},       {"degs-x-64", "span:0", {}},
    {"degs-x-64", "slicing:1", {}},   {"degs-x-64", "slice:2", {}},
    {"degs-64-tuned", "span:3", {}},  {"degs-64-tuned", "slicing:1", {}},
    {"degs-64-tuned", "slice:5", {}},
};

INSTANTIATE_TEST_SUITE_P(Designs, SmallRunNaiveBlock, testing::ValuesIn(kOthers));

/// A window that cuts tiles on every side.
class CroppedNaiveBlock : public testing::TestWithParam<Other> {};

TEST_P(CroppedNaiveBlock, TakesAndSendsTheSame) {
    std::vector<std::string> view = kSmall;
    view.insert(view.end(), {"--crop", "19,13,107x83"});
    expect_naive_block(GetParam(), view, 100);
}

INSTANTIATE_TEST_SUITE_P(Designs, CroppedNaiveBlock, testing::ValuesIn(kOthers));

TEST(CroppedBlockLog, OfABankIsThatOfANaiveBank) {
    std::vector<std::string> view = kSmall;
    view.insert(view.end(), {"--crop", "19,13,107x83"});
    const BlockLog log = logged(view, "degs-64", "bank:3");
    EXPECT_GT(log.count("packet"), 100U);
    degs::test::NaiveBank naive(degs::test::NaiveFacts(log.facts()), log.events);
    EXPECT_EQ(degs::test::first_difference(degs::test::lines_of(log.events), naive.run()), "");
}

class LongTrainedNaiveBlock : public testing::TestWithParam<Other> {};

TEST_P(LongTrainedNaiveBlock, TakesAndSendsTheSame) {
    const fs::path scene = trained_scenes() / "flowers" / "scene.ply";
    if (!fs::exists(scene)) {
        GTEST_SKIP() << "the trained scene flowers is not in " << trained_scenes()
                     << "; set DEGS_SCENES";
    }
    expect_naive_block(GetParam(), {"--scene", scene.string(), "--camera", "2", "--width", "200"},
                       3000);
}

INSTANTIATE_TEST_SUITE_P(Flowers, LongTrainedNaiveBlock, testing::ValuesIn(kOthers));

} // namespace
} // namespace degs::sim_test
