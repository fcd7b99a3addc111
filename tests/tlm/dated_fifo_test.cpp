// SPDX-License-Identifier: Apache-2.0
#include "tlm/dated_fifo.hpp"

#include <algorithm>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tlm/script.hpp"

namespace degs {
namespace {

using test::Script;

constexpr std::size_t kStages = 4;
constexpr std::size_t kRandomItems = 400;

/// A source, two stages and a sink; three rings between them.
struct Pipeline {
    Cycle depth[kStages - 1], forward[kStages - 1], release[kStages - 1];
    Cycle extra[kStages - 1]; ///< > 0: items are put with put_at(), readable that much later
    std::vector<Cycle> work[kStages];
};

/// Dates of all items at all rings, and what the rings should have counted.
struct Dates {
    std::vector<Cycle> written[kStages - 1], read[kStages - 1];
    Cycle full[kStages - 1] = {}, empty[kStages - 1] = {}, occupied[kStages - 1] = {};
    std::uint64_t hash() const {
        std::uint64_t h = 1;
        for (std::size_t k = 0; k + 1 < kStages; ++k) {
            for (std::size_t i = 0; i < written[k].size(); ++i) {
                h = test::mix(h, written[k][i], read[k].at(i), k);
            }
        }
        return h;
    }
};

Pipeline random_pipeline(std::mt19937& random) {
    const auto upto = [&](unsigned n) { return static_cast<Cycle>(random() % (n + 1)); };
    Pipeline p;
    for (std::size_t k = 0; k + 1 < kStages; ++k) {
        p.depth[k] = 1 + (random() % 3 == 0 ? upto(63) : upto(5));
        p.forward[k] = upto(3);
        p.release[k] = upto(3);
        p.extra[k] = random() % 4 == 0 ? upto(9) : 0;
    }
    for (auto& work : p.work) {
        const unsigned longest = 1 + static_cast<unsigned>(random() % 8);
        const unsigned burst = 1 + static_cast<unsigned>(random() % 40);
        for (std::size_t i = 0; i < kRandomItems; ++i) {
            work.push_back(i / burst % 2 == 0 ? upto(longest) : 0);
        }
    }
    return p;
}

// write(i) = max(a_w, read(i - D) + Lb), read(i) = max(a_r, write(i) + Lf), item by item.
Dates recurrence(const Pipeline& p) {
    Dates d;
    Cycle local[kStages] = {};
    for (std::size_t i = 0; i < kRandomItems; ++i) {
        for (std::size_t k = 0; k < kStages; ++k) {
            if (k > 0) {
                const std::size_t ring = k - 1;
                const Cycle readable = std::max(d.written[ring][i] + p.forward[ring],
                                                d.written[ring][i] + p.extra[ring]);
                const Cycle read = std::max(local[k], readable);
                d.empty[ring] += read - local[k];
                d.occupied[ring] += read - d.written[ring][i];
                d.read[ring].push_back(local[k] = read);
            }
            local[k] += p.work[k][i];
            if (k + 1 < kStages) {
                const Cycle free = i < p.depth[k] ? 0 : d.read[k][i - p.depth[k]] + p.release[k];
                const Cycle write = std::max(local[k], free);
                d.full[k] += write - local[k];
                d.written[k].push_back(local[k] = write);
            }
        }
    }
    return d;
}

/// The pipeline as processes and rings.
class DatedPipeline {
public:
    DatedPipeline(const std::string& name, const Pipeline& p, Fidelity fidelity)
        : time_{ClockDomain(1.0), fidelity}, p_(p) {
        for (std::size_t k = 0; k + 1 < kStages; ++k) {
            rings_.push_back(std::make_unique<DatedFifo<int>>(
                (name + "_ring").c_str(), time_, p.depth[k], p.forward[k], p.release[k]));
        }
        for (std::size_t k = 0; k < kStages; ++k) {
            processes_.push_back(std::make_unique<Process>(time_));
            scripts_.push_back(
                std::make_unique<Script>((name + "_stage").c_str(), [this, k] { run(k); }));
        }
    }
    const Dates& dates() const { return dates_; }
    const DatedFifo<int>& ring(std::size_t k) const { return *rings_[k]; }
    bool ordered() const { return ordered_; }

private:
    void run(std::size_t k) {
        Process& self = *processes_[k];
        for (std::size_t i = 0; i < kRandomItems; ++i) {
            if (k > 0) {
                ordered_ = take(*rings_[k - 1], self, i) == static_cast<int>(i) && ordered_;
                dates_.read[k - 1].push_back(self.local());
            }
            self.advance(p_.work[k][i]);
            if (k + 1 < kStages) {
                DatedFifo<int>& ring = *rings_[k];
                ring.reserve(self); // so that put_at() counts `extra` from the write
                ring.put_at(self, static_cast<int>(i), self.local() + p_.extra[k]);
                dates_.written[k].push_back(self.local());
            }
        }
        self.finish();
    }
    /// The two ways to read, turn about.
    static int take(DatedFifo<int>& ring, Process& self, std::size_t i) {
        if (i % 2 == 0) {
            return ring.get(self);
        }
        const int value = ring.arrive(self);
        EXPECT_EQ(ring.front(), value);
        ring.drop(self);
        return value;
    }

    Timebase time_; // processes keep a pointer to its clock
    Pipeline p_;
    Dates dates_;
    bool ordered_ = true;
    std::vector<std::unique_ptr<DatedFifo<int>>> rings_;
    std::vector<std::unique_ptr<Process>> processes_;
    std::vector<std::unique_ptr<Script>> scripts_;
};

/// Most items inside just after a write; an item read at that very date has left.
std::size_t most_inside(const std::vector<Cycle>& written, const std::vector<Cycle>& read) {
    std::size_t most = 0;
    for (std::size_t i = 0; i < written.size(); ++i) {
        std::size_t inside = 1;
        for (std::size_t j = 0; j < i; ++j) {
            inside += read[j] > written[i] ? 1U : 0U;
        }
        most = std::max(most, inside);
    }
    return most;
}

void expect_rule(const DatedPipeline& run, const Dates& expected, const Pipeline& p) {
    EXPECT_TRUE(run.ordered());
    EXPECT_EQ(run.dates().hash(), expected.hash());
    for (std::size_t k = 0; k + 1 < kStages; ++k) {
        EXPECT_EQ(run.dates().written[k], expected.written[k]);
        EXPECT_EQ(run.dates().read[k], expected.read[k]);
        const auto& stats = run.ring(k).stats();
        EXPECT_EQ(stats.items, kRandomItems);
        EXPECT_EQ(stats.full_cycles, expected.full[k]);
        EXPECT_EQ(stats.empty_cycles, expected.empty[k]);
        EXPECT_EQ(stats.occupied_cycles, expected.occupied[k]);
        EXPECT_LE(stats.high_water, p.depth[k]);
        EXPECT_EQ(stats.high_water, most_inside(expected.written[k], expected.read[k]));
    }
}

class SmallRunTimingRule : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunTimingRule, HoldsInBothFidelities) {
    std::mt19937 random(GetParam());
    std::vector<Pipeline> pipelines(40);
    std::vector<std::unique_ptr<DatedPipeline>> exact;
    std::vector<std::unique_ptr<DatedPipeline>> strict;
    for (Pipeline& p : pipelines) {
        p = random_pipeline(random);
        const std::string index = std::to_string(exact.size());
        exact.push_back(std::make_unique<DatedPipeline>("exact_" + index, p, Fidelity::Exact));
        strict.push_back(std::make_unique<DatedPipeline>("strict_" + index, p, Fidelity::Strict));
    }
    sc_core::sc_start();
    for (std::size_t i = 0; i < pipelines.size(); ++i) {
        SCOPED_TRACE(i);
        const Dates expected = recurrence(pipelines[i]);
        expect_rule(*exact[i], expected, pipelines[i]);
        expect_rule(*strict[i], expected, pipelines[i]);
    }
}

INSTANTIATE_TEST_SUITE_P(Random, SmallRunTimingRule, ::testing::Range(1U, 6U));

// A fast writer and a reader that needs 3 cycles per item: everything follows from n, D, Lf and Lb.
TEST(DatedFifo, StatisticsOfAFullRing) {
    constexpr Cycle n = 100;
    constexpr Cycle depth = 8;
    const Timebase time;
    DatedFifo<int> ring("ring", time, depth, 2, 1);
    Process writer(time);
    Process reader(time);
    const Script write("write", [&] {
        for (Cycle i = 0; i < n; ++i) {
            ring.put(writer, 0);
            writer.advance();
        }
    });
    const Script read("read", [&] {
        for (Cycle i = 0; i < n; ++i) {
            ring.get(reader);
            reader.advance(3);
        }
    });
    sc_core::sc_start();
    // read(i) = 2 + 3i; write(i) = max(i, read(i - D) + 1) = max(i, 3 (i - D) + 3). The writer is
    // ready one cycle after its last write, so its waiting telescopes.
    Cycle occupied = 0;
    for (Cycle i = 0; i < n; ++i) {
        occupied += 2 + 3 * i - (i < depth ? i : std::max(i, 3 * (i - depth) + 3));
    }
    const auto& stats = ring.stats();
    EXPECT_EQ(stats.items, n);
    EXPECT_EQ(reader.local(), 2 + 3 * n);
    EXPECT_EQ(stats.empty_cycles, 2U);
    EXPECT_EQ(stats.full_cycles, 3 * (n - 1 - depth) + 3 - (n - 1));
    EXPECT_EQ(stats.occupied_cycles, occupied);
    EXPECT_EQ(stats.high_water, depth);
}

// A writer that is done long before its reader starts, and a reader that is done before the writer
// goes on: a wire moves neither, however far they are apart.
TEST(DatedFifo, WireNeverPushesBack) {
    constexpr Cycle n = 1000;
    const Timebase time;
    DatedFifo<int> wire("wire", time, FifoBase::kWire, 3);
    Process writer(time);
    Process reader(time);
    const Script write("write", [&] {
        for (int i = 0; i < static_cast<int>(n); ++i) {
            wire.put(writer, i);
            writer.advance();
        }
    });
    bool ordered = true;
    const Script read("read", [&] {
        reader.advance(5000);
        for (int i = 0; i < static_cast<int>(n); ++i) {
            ordered = ordered && wire.get(reader) == i;
            reader.advance(2);
        }
    });
    sc_core::sc_start();
    EXPECT_TRUE(ordered);
    EXPECT_EQ(writer.local(), n);
    EXPECT_EQ(reader.local(), 5000 + 2 * n);
    EXPECT_EQ(wire.stats().full_cycles, 0U);
    EXPECT_EQ(wire.stats().high_water, n);
    EXPECT_FALSE(wire.full());
}

// The reader holds on to an item in its cell while the writer fills all others.
TEST(DatedFifo, ItemStaysWhereItIsWhileTheRingGrows) {
    const Timebase time;
    DatedFifo<int> ring("ring", time, 1000);
    Process writer(time);
    Process reader(time);
    int seen = 0;
    const Script run("run", [&] {
        ring.put(writer, 7);
        const int& item = ring.arrive(reader);
        for (int i = 0; i < 999; ++i) {
            ring.put(writer, i);
        }
        seen = item;
        ring.drop(reader);
        EXPECT_EQ(ring.get(reader), 0);
    });
    sc_core::sc_start();
    EXPECT_EQ(seen, 7);
}

// Between bursts of items, when it is empty, a ring changes its depth: each burst has the dates of
// a ring that has had that depth from the start.
TEST(DatedFifo, AnEmptyRingMayChangeItsDepth) {
    constexpr std::size_t kDepths[] = {3, 8, 40, 2, 2, 100, 1, 17};
    constexpr Cycle kBurst = 120, kApart = 10'000;
    const Timebase time;
    struct Side {
        Side(const std::string& name, const Timebase& time, std::size_t depth)
            : ring(name.c_str(), time, depth, 2, 1), writer(time), reader(time) {}
        DatedFifo<Cycle> ring;
        Process writer, reader;
        std::vector<Cycle> dates; // of writes and reads, from the start of their burst
    };
    Side changing("changing", time, 5);
    std::vector<std::unique_ptr<Side>> fixed;
    std::vector<std::unique_ptr<Script>> scripts;
    const auto add = [&scripts](std::function<void()> body) {
        scripts.push_back(std::make_unique<Script>(
            ("script_" + std::to_string(scripts.size())).c_str(), std::move(body)));
    };
    const auto write = [](Side& side, std::size_t burst) {
        side.writer.advance_to(kApart * burst);
        for (Cycle i = 0; i < kBurst; ++i) {
            side.writer.advance(test::mix(burst, i, 1, 1) % 3);
            side.ring.put(side.writer, i);
            side.dates.push_back(side.writer.local() - kApart * burst);
        }
    };
    const auto read = [](Side& side, std::size_t burst) {
        side.reader.advance_to(kApart * burst);
        for (Cycle i = 0; i < kBurst; ++i) {
            EXPECT_EQ(side.ring.get(side.reader), i);
            side.reader.advance(test::mix(burst, i, 2, 2) % (i < kBurst / 2 ? 9 : 2));
            side.dates.push_back(side.reader.local() - kApart * burst);
        }
    };
    for (std::size_t burst = 0; burst < std::size(kDepths); ++burst) {
        fixed.push_back(
            std::make_unique<Side>("fixed_" + std::to_string(burst), time, kDepths[burst]));
        Side& side = *fixed.back();
        add([&side, write, burst] { write(side, burst); });
        add([&side, read, burst] { read(side, burst); });
    }
    sc_core::sc_event read_out;
    add([&] {
        for (std::size_t burst = 0; burst < std::size(kDepths); ++burst) {
            changing.ring.set_depth(kDepths[burst]);
            EXPECT_EQ(changing.ring.depth(), kDepths[burst]);
            write(changing, burst);
            sc_core::wait(read_out);
        }
    });
    add([&] {
        for (std::size_t burst = 0; burst < std::size(kDepths); ++burst) {
            read(changing, burst);
            read_out.notify(sc_core::SC_ZERO_TIME);
        }
    });
    sc_core::sc_start();
    std::vector<Cycle> expected;
    std::size_t most = 0;
    Cycle full = 0;
    for (const auto& side : fixed) {
        expected.insert(expected.end(), side->dates.begin(), side->dates.end());
        most = std::max(most, side->ring.stats().high_water);
        full += side->ring.stats().full_cycles;
    }
    std::sort(expected.begin(), expected.end());
    std::sort(changing.dates.begin(), changing.dates.end());
    EXPECT_EQ(changing.dates, expected);
    EXPECT_EQ(changing.ring.stats().high_water, most);
    EXPECT_EQ(changing.ring.stats().full_cycles, full);
}

// A ring of depth 0 would deadlock; it has one cell.
TEST(DatedFifo, HasAtLeastOneCell) {
    const Timebase time;
    const DatedFifo<int> ring("ring", time, 0);
    EXPECT_EQ(ring.depth(), 1U);
    EXPECT_TRUE(ring.empty());
    EXPECT_FALSE(ring.full());
}

} // namespace
} // namespace degs
