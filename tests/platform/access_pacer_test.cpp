// SPDX-License-Identifier: Apache-2.0
// What others see of an accelerator that shares an ordinary memory with them.
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/busy_memory.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

constexpr double kLineNs = 64 / BusyMemory::kBytesPerNs;

void set_quantum(double ns) {
    tlm::tlm_global_quantum::instance().set(sc_core::sc_time(ns, sc_core::SC_NS));
}

/// A stream that runs ahead of the kernel: at 90, 190, ... ns a read of 4 KiB, which takes 20 ns.
class SmallRunAccessPacer : public ::testing::Test {
protected:
    static constexpr int kReads = 100;
    std::vector<Cycle> answers;
    sc_core::sc_time most_ahead;

    std::vector<double> line_latencies(Pacing pacing) {
        const Timebase time;
        BusyMemory memory("memory", 4096, 2);
        LineReader cpu("cpu", kReads);
        MemoryPort port("port", time);
        MemoryGateway::Options options;
        options.pacing = pacing;
        MemoryGateway gateway("gateway", options);
        gateway.out.bind(memory.in[0]);
        gateway.connect({{&port, {"records", StreamData::Own, ""}}});
        cpu.out.bind(memory.in[1]);
        const Script script("script", [&] {
            Process process(time);
            for (Cycle i = 0; i < kReads; ++i) {
                process.advance_to(90 + 100 * i);
                answers.push_back(port.read(process, 0, 4096).date());
            }
        });
        sc_core::sc_start();
        most_ahead = memory.most_ahead;
        return cpu.latencies;
    }
};

// The line comes at 100 ns, the transfer before it ends at 90.5 + 20 ns.
TEST_F(SmallRunAccessPacer, ExactLetsAProcessorWaitForTheTransferUnderWayOnly) {
    const std::vector<double> latencies = line_latencies(Pacing::Exact);
    ASSERT_EQ(latencies.size(), std::size_t{kReads});
    for (const double latency : latencies) {
        EXPECT_NEAR(latency, 10.5 + kLineNs + BusyMemory::kLatencyNs, 2e-3);
    }
    EXPECT_EQ(most_ahead, sc_core::SC_ZERO_TIME);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        EXPECT_EQ(answers[i], 90 + 100 * i + 20 + 50);
    }
}

TEST_F(SmallRunAccessPacer, AnnotatedLetsItWaitForTheFuture) {
    const std::vector<double> latencies = line_latencies(Pacing::Annotated);
    EXPECT_GT(latencies.front(), 9000);
}

// The first line comes at 100 ns, when the reads of 90, 190, ... 990 ns have been made.
TEST_F(SmallRunAccessPacer, AQuantumBoundsTheWait) {
    set_quantum(1000);
    const std::vector<double> latencies = line_latencies(Pacing::Quantum);
    EXPECT_EQ(most_ahead, sc_core::sc_time(990, sc_core::SC_NS));
    ASSERT_EQ(latencies.size(), std::size_t{kReads});
    EXPECT_NEAR(latencies.front(), 1010 - 100 + kLineNs + BusyMemory::kLatencyNs, 2e-3);
    for (const double latency : latencies) {
        EXPECT_LE(latency, latencies.front() + 2e-3);
    }
}

TEST_F(SmallRunAccessPacer, NoQuantumIsExact) {
    set_quantum(0);
    const std::vector<double> latencies = line_latencies(Pacing::Quantum);
    EXPECT_EQ(most_ahead, sc_core::SC_ZERO_TIME);
    EXPECT_NEAR(latencies.front(), 10.5 + kLineNs + BusyMemory::kLatencyNs, 2e-3);
}

/// An accelerator and a processor at one memory, built in either order.
struct SharedPlatform {
    enum class Order { ProcessorFirst, AcceleratorFirst };
    SharedPlatform(const std::string& name, Order order, Pacing pacing, const GaussianCloud& cloud,
                   const Camera& camera)
        : memory((name + "_memory").c_str(), kMemoryBytes, 2) {
        if (order == Order::ProcessorFirst) {
            add_cpu(name);
        }
        Accelerator::Options options;
        options.memory.pacing = pacing;
        p = std::make_unique<Platform>(name.c_str(), DegsConfig(), cloud, nullptr, options);
        p->mem().bind(memory.in[0]);
        if (order == Order::AcceleratorFirst) {
            add_cpu(name);
        }
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), memory.bytes.begin());
        std::copy(sh.begin(), sh.end(), memory.bytes.begin() + kSh);
        p->host.script = [this, cloud, camera](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles = host.read_pair(Register::Cycles);
        };
    }
    void add_cpu(const std::string& name) {
        cpu = std::make_unique<LineReader>((name + "_cpu").c_str(), 200);
        cpu->out.bind(memory.in[1]);
    }
    BusyMemory memory;
    std::unique_ptr<Platform> p;
    std::unique_ptr<LineReader> cpu;
    std::uint64_t cycles = 0;
};

/// One frame runs on three platforms.
struct ThreePacings {
    ThreePacings(const std::string& name, const GaussianCloud& cloud, const Camera& camera)
        : exact("exact" + name, kFirst, Pacing::Exact, cloud, camera),
          quantum("quantum" + name, kFirst, Pacing::Quantum, cloud, camera),
          annotated("annotated" + name, kFirst, Pacing::Annotated, cloud, camera) {}
    static constexpr SharedPlatform::Order kFirst = SharedPlatform::Order::ProcessorFirst;
    SharedPlatform exact, quantum, annotated;
};

class SmallRunSharedMemory : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
};

TEST_F(SmallRunSharedMemory, ExactDoesNotDependOnTheOrderOfTheInitiators) {
    using Order = SharedPlatform::Order;
    SharedPlatform a("a", Order::ProcessorFirst, Pacing::Exact, cloud, camera);
    SharedPlatform b("b", Order::AcceleratorFirst, Pacing::Exact, cloud, camera);
    sc_core::sc_start();
    EXPECT_GT(a.cycles, 1000U);
    EXPECT_EQ(a.cycles, b.cycles);
    EXPECT_EQ(a.cpu->latencies, b.cpu->latencies);
    EXPECT_EQ(a.memory.bytes, b.memory.bytes);
    EXPECT_EQ(a.memory.most_ahead, sc_core::SC_ZERO_TIME);
}

// Nobody runs ahead by more than the quantum, so that a frame and a wait change by less than it.
TEST_F(SmallRunSharedMemory, AQuantumOf100NsChangesTimesByLessThanIt) {
    constexpr double kQuantumNs = 100; // the clock is 1 GHz
    set_quantum(kQuantumNs);
    std::vector<std::unique_ptr<ThreePacings>> scenes;
    for (unsigned seed = 1; seed <= 5; ++seed) {
        scenes.push_back(
            std::make_unique<ThreePacings>(std::to_string(seed), test_cloud(seed), camera));
    }
    sc_core::sc_start();
    for (const auto& scene : scenes) {
        // The frame takes as long as the order in which the host runs its blocks makes it.
        EXPECT_NE(scene->annotated.cycles, scene->exact.cycles);
        EXPECT_GT(scene->annotated.cpu->worst(), 5 * scene->exact.cpu->worst());
        EXPECT_GT(scene->annotated.memory.most_ahead, sc_core::sc_time(kQuantumNs, sc_core::SC_NS));
        EXPECT_NEAR(static_cast<double>(scene->quantum.cycles),
                    static_cast<double>(scene->exact.cycles), kQuantumNs);
        EXPECT_LE(scene->quantum.cpu->worst(), scene->exact.cpu->worst() + kQuantumNs);
        EXPECT_LE(scene->quantum.memory.most_ahead, sc_core::sc_time(kQuantumNs, sc_core::SC_NS));
    }
}

// One unit projects a Gaussian per cycle, so the last ones are read well after 100 ns.
TEST_F(SmallRunSharedMemory, AWriterIsSeenAtItsDate) {
    DegsConfig config;
    config.projection.count = 1;
    config.projection.chunk = 8;
    Platform p("accelerator", config, cloud);
    p.host.script = [&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::Control, kControlStart);
        host.write(Register::IrqEnable, kIrqDone | kIrqError);
        sc_core::wait(sc_core::sc_time(100, sc_core::SC_NS));
        p.memory->bytes[(cloud.size() - 1) * kFloatGeometryBytes] ^= 1U;
        EXPECT_FALSE(host.await_irq());
        EXPECT_EQ(host.error(), AcceleratorError::SceneChanged);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

} // namespace
} // namespace degs::test
