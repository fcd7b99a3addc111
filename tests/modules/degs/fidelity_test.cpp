// SPDX-License-Identifier: Apache-2.0
// `exact` is bit-identical to `strict`: random accelerators on random frames, the two fidelities
// side by side as two accelerators of one elaboration.
#include "tests/modules/degs/random_design.hpp"
#include "tests/modules/degs/scheduler/naive_log.hpp"

namespace degs {
namespace {

using test::DegsRun;
using test::Draw;

/// What each bank of a run issues.
std::vector<IssueTrace> trace(const DegsRun& run) {
    std::vector<IssueTrace> traces(run.degs().banks().size());
    for (std::size_t b = 0; b < traces.size(); ++b) {
        run.degs().banks()[b]->trace_to(traces[b]);
    }
    return traces;
}

void expect_same_issues(const std::vector<IssueTrace>& a, const std::vector<IssueTrace>& b) {
    for (std::size_t bank = 0; bank < a.size(); ++bank) {
        EXPECT_EQ(a[bank].segments(), b[bank].segments()) << "bank " << bank;
        EXPECT_EQ(a[bank].digest(), b[bank].digest()) << "bank " << bank;
    }
}

/// A bank that is awake in every cycle does what the bank of a strict run does.
void expect_naive_bank(const EventLog& log, const std::string& bank) {
    const std::map<std::string, std::int64_t> facts(log.facts().begin(), log.facts().end());
    if (facts.at("packet_ports") != 0) {
        return; // the naive bank has no SRAM ports
    }
    const std::vector<test::LoggedEvent> events = test::events_of(log);
    test::NaiveBank naive(test::NaiveFacts(facts), events);
    EXPECT_EQ(test::first_difference(test::lines_of(events), naive.run()), "") << bank;
}

void expect_exact_is_strict(unsigned index, Draw& draw, const DegsConfig& config) {
    SCOPED_TRACE(test::describe(config));
    const std::vector<FrameWorkload> frames = test::draw_frames(index, draw, config);
    const std::vector<const FrameWorkload*> list = test::pointers_to(frames);
    const DegsRun exact("exact", config, list, Fidelity::Exact);
    const DegsRun strict("strict", config, list, Fidelity::Strict);
    const std::vector<IssueTrace> exact_issues = trace(exact), strict_issues = trace(strict);
    std::vector<EventLog> logs(strict.degs().banks().size());
    for (std::size_t bank = 0; bank < logs.size(); ++bank) {
        strict.degs().banks()[bank]->log_to(logs[bank]);
    }
    sc_core::sc_start();
    for (std::size_t bank = 0; bank < logs.size(); ++bank) {
        expect_naive_bank(logs[bank], strict.degs().banks()[bank]->name());
    }
    expect_same_issues(exact_issues, strict_issues);
    test::expect_sound(exact);
    EXPECT_EQ(exact.degs().finished(), strict.degs().finished());
    test::expect_same_statistics(exact, strict);
    for (std::size_t f = 0; f < frames.size(); ++f) {
        EXPECT_TRUE(test::same_bytes(exact.image(f), strict.image(f)));
    }
    if (index % 2 == 0 && config.scheduler.scoreboard) {
        test::expect_reference(exact);
    }
}

class SmallRunFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunFidelity, ExactIsStrict) {
    Draw draw(GetParam());
    const DegsConfig config = draw.config(GetParam());
    expect_exact_is_strict(GetParam(), draw, config);
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunFidelity, ::testing::Range(0U, 200U));

class PlainRunFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(PlainRunFidelity, ExactIsStrict) {
    Draw draw(GetParam());
    const DegsConfig config = draw.plain(GetParam());
    expect_exact_is_strict(GetParam(), draw, config);
}

INSTANTIATE_TEST_SUITE_P(Random, PlainRunFidelity, ::testing::Range(1000U, 1100U));

/// Designs whose Span Units work when banks ask. An odd index says that no image is compared with
/// the reference: here only dates are new.
class StreamsRunFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(StreamsRunFidelity, ExactIsStrict) {
    Draw draw(GetParam());
    const DegsConfig config = draw.plain(GetParam(), true);
    expect_exact_is_strict(GetParam() | 1U, draw, config);
}

INSTANTIATE_TEST_SUITE_P(Random, StreamsRunFidelity, ::testing::Range(2000U, 2060U));

void expect_same_tiles(const SlotRecorder& a, const SlotRecorder& b) {
    ASSERT_EQ(a.tiles().size(), b.tiles().size());
    for (std::size_t t = 0; t < a.tiles().size(); ++t) {
        const TileActivity& x = a.tiles()[t];
        const TileActivity& y = b.tiles()[t];
        for (const SlotClass& each : kSlotClasses) {
            EXPECT_EQ(x.slots[each.slot], y.slots[each.slot]) << each.name << " of tile " << t;
        }
        EXPECT_EQ(x.window.first, y.window.first) << "tile " << t;
        EXPECT_EQ(x.window.last, y.window.last) << "tile " << t;
        EXPECT_EQ(x.read_out, y.read_out) << "tile " << t;
    }
}

// Names in timelines begin with those of the two accelerators, so that only what they hold is
// compared.
void expect_same_timelines(const TimelineRecord& a, const TimelineRecord& b) {
    EXPECT_EQ(a.step, b.step);
    EXPECT_EQ(a.end, b.end);
    ASSERT_EQ(a.tracks.size(), b.tracks.size());
    for (std::size_t t = 0; t < a.tracks.size(); ++t) {
        ASSERT_EQ(a.tracks[t].states.size(), b.tracks[t].states.size()) << a.tracks[t].name;
        for (std::size_t i = 0; i < a.tracks[t].states.size(); ++i) {
            EXPECT_EQ(a.tracks[t].states[i].cycles, b.tracks[t].states[i].cycles)
                << a.tracks[t].name << ", " << a.tracks[t].states[i].name;
        }
    }
    ASSERT_EQ(a.rings.size(), b.rings.size());
    for (std::size_t r = 0; r < a.rings.size(); ++r) {
        EXPECT_EQ(a.rings[r].cell_cycles, b.rings[r].cell_cycles) << a.rings[r].name;
    }
    ASSERT_EQ(a.counters.size(), b.counters.size());
    for (std::size_t c = 0; c < a.counters.size(); ++c) {
        EXPECT_EQ(a.counters[c].sums, b.counters[c].sums) << a.counters[c].name;
    }
}

// Replayed tasks are recorded when they are packed, with the dates at which they
// execute.
class RecordedRunFidelity : public ::testing::TestWithParam<unsigned> {};

TEST_P(RecordedRunFidelity, ExactIsStrict) {
    Draw draw(GetParam());
    const DegsConfig config =
        GetParam() % 2 == 0 ? draw.config(GetParam()) : draw.plain(GetParam());
    SCOPED_TRACE(test::describe(config));
    const std::vector<FrameWorkload> frames = test::draw_frames(GetParam(), draw, config);
    const std::vector<const FrameWorkload*> list = test::pointers_to(frames);
    DegsRun exact("exact", config, list, Fidelity::Exact, {}, test::Watch::Timeline);
    DegsRun strict("strict", config, list, Fidelity::Strict, {}, test::Watch::Timeline);
    DegsRun tiles("tiles", config, list, Fidelity::Exact, {}, test::Watch::Tiles);
    DegsRun plain("plain", config, list);
    sc_core::sc_start();
    test::expect_sound(exact);
    for (const DegsRun* run : {&exact, &tiles, &plain}) {
        test::expect_same_statistics(*run, strict);
    }
    for (const DegsRun* run : {&exact, &tiles}) {
        run->job().recorder->close();
    }
    strict.job().recorder->close();
    expect_same_tiles(*exact.job().recorder, *strict.job().recorder);
    expect_same_tiles(*tiles.job().recorder, *strict.job().recorder);
    const Cycle end = strict.degs().finished();
    expect_same_timelines(exact.timeline(end), strict.timeline(end));
}

INSTANTIATE_TEST_SUITE_P(Random, RecordedRunFidelity, ::testing::Range(2000U, 2060U));

} // namespace
} // namespace degs
