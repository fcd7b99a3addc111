// SPDX-License-Identifier: Apache-2.0
// What a blocked process proves about its next date, through those that it waits for.
#include "tlm/process.hpp"

#include <gtest/gtest.h>

#include "tests/tlm/arbitration_reference.hpp"
#include "tests/tlm/process_bench.hpp"

namespace degs {
namespace {

using test::ProcessBench;
using test::Script;

/// Layers of processes, of which each waits for an item from every process of the layer before it.
/// Those of the first layer have gone on to `date`. Latency of every ring: 2.
struct Layers {
    Layers(const Timebase& time, std::size_t layers, std::size_t width, Cycle date) {
        for (std::size_t i = 0; i < layers * width; ++i) {
            processes.push_back(std::make_unique<Process>(time));
            inputs.emplace_back();
            for (std::size_t w = 0; i >= width && w < width; ++w) {
                const std::string name = "ring" + std::to_string(rings.size());
                rings.push_back(std::make_unique<DatedFifo<int>>(name.c_str(), time, 1, 2));
                rings.back()->connect_writer(*processes[i / width * width - width + w]);
                inputs[i].push_back(rings.back().get());
            }
        }
        for (std::size_t i = 0; i < processes.size(); ++i) {
            const std::string name = "process" + std::to_string(i);
            scripts.push_back(std::make_unique<Script>(name.c_str(), [this, i, width, date] {
                if (i < width) {
                    processes[i]->advance(date);
                    processes[i]->sync();
                } else {
                    processes[i]->next_arrival(inputs[i].data(), width, 0, kNever);
                }
            }));
        }
    }
    const Process& last() const { return *processes.back(); }

    std::vector<std::unique_ptr<Process>> processes;
    std::vector<std::unique_ptr<DatedFifo<int>>> rings;
    std::vector<std::vector<FifoBase*>> inputs;
    std::vector<std::unique_ptr<Script>> scripts;
};

TEST(ProcessBound, GoesAsManyPredecessorsFarAsItMay) {
    ProcessBench bench;
    const Layers chain(bench.time, 6, 1, 100);
    sc_core::sc_start(1, sc_core::SC_NS);
    for (int depth = 0; depth < 5; ++depth) {
        EXPECT_EQ(chain.last().bound(depth), 2U * depth) << depth;
    }
    EXPECT_EQ(chain.last().bound(5), 110U);
    EXPECT_EQ(chain.last().bound(6), 110U);
}

// 3 ^ 29 ways lead to the first layer.
TEST(ProcessBound, LooksAtEachProcessOnce) {
    ProcessBench bench;
    const Layers layers(bench.time, 30, 3, 100);
    sc_core::sc_start(1, sc_core::SC_NS);
    EXPECT_EQ(layers.last().bound(29), 158U);
    EXPECT_EQ(layers.last().bound(29), 158U); // and says so again
}

// Each may act 1 cycle after the other has written, which may be at its own date, 0.
TEST(ProcessBound, EndsInACircle) {
    ProcessBench bench;
    const auto there = bench.ring("there", 1);
    const auto back = bench.ring("back", 1);
    Process a(bench.time), b(bench.time);
    there->connect_writer(a);
    back->connect_writer(b);
    const Script run_a("a", [&] { back->get(a); });
    const Script run_b("b", [&] { there->get(b); });
    sc_core::sc_start(1, sc_core::SC_NS);
    EXPECT_EQ(a.bound(1000), 2U);
    EXPECT_EQ(b.bound(1000), 2U);
}

// What is not beyond the date that the caller wants may be less than the whole truth, and what is
// may not.
TEST(ProcessBound, IsExactBeyondTheDateThatIsWanted) {
    ProcessBench bench;
    const auto near = bench.ring("near", 1);
    const auto far = bench.ring("far", 1);
    Process slow(bench.time), quick(bench.time), reader(bench.time);
    near->connect_writer(slow);
    far->connect_writer(quick);
    FifoBase* inputs[] = {near.get(), far.get()};
    const Script run_slow("slow", [&] {
        slow.advance(10);
        slow.sync();
    });
    const Script run_quick("quick", [&] {
        quick.advance(1000);
        quick.sync();
    });
    const Script read("read", [&] { reader.next_arrival(inputs, 2, 0, kNever); });
    sc_core::sc_start(1, sc_core::SC_NS);
    EXPECT_EQ(reader.bound(3), 11U);
    EXPECT_EQ(reader.bound(3, 10), 11U);
    for (const Cycle wanted : {11U, 500U, 2000U}) {
        EXPECT_LE(reader.bound(3, wanted), 11U);
    }
}

} // namespace
} // namespace degs
