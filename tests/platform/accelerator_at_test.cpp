// SPDX-License-Identifier: Apache-2.0
// degs::Accelerator on memories that know the four phases only.
#include "dram/lpddr5.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

Accelerator::Options four_phases(unsigned outstanding = 64, std::uint64_t burst_bytes = 0) {
    Accelerator::Options options;
    options.memory.transport = Transport::At;
    options.memory.outstanding = outstanding;
    options.memory.burst_bytes = burst_bytes;
    return options;
}

/// A platform whose memory is an AtMemory with the same contents.
struct AtPlatform : Platform {
    AtPlatform(const char* name, const AcceleratorConfig& config, const GaussianCloud& cloud,
               const Accelerator::Options& options = four_phases())
        : Platform(name, config, cloud, nullptr, options),
          at((std::string(name) + "_memory").c_str(), kMemoryBytes) {
        mem().bind(at.in);
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), at.bytes.begin());
        std::copy(sh.begin(), sh.end(), at.bytes.begin() + kSh);
    }
    std::vector<unsigned char> pixels(const Camera& camera) const {
        const auto begin = at.bytes.begin() + kFrame;
        return {begin, begin + camera.width * camera.height * 4};
    }
    AtMemory at;
};

class SmallRunAtAccelerator : public ::testing::TestWithParam<Ending> {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    DegsConfig config;
    std::uint64_t loaded = 0;

    /// A script that renders one frame and returns its cycles.
    std::function<void(Host&)> frame(std::uint64_t& cycles) {
        return [this, &cycles](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles = host.read_pair(Register::Cycles);
            loaded = std::max(loaded, host.read_pair(Register::LoadCycles));
        };
    }
};

// Bandwidth is unlimited, and as many accesses are in flight as with an annotated memory. A request
// goes out half a cycle after its date and an answer counts from the next cycle on, so the same
// dates come of an annotated latency that is a cycle longer. A memory that needs BEGIN_RESP to end
// a request, or that keeps its response phase for the whole latency, serves one transaction after
// the other.
TEST_P(SmallRunAtAccelerator, TakesTheTimeOfAnAnnotatedMemoryAndWritesItsBytes) {
    AtPlatform p("four_phases", config, cloud, four_phases(100000));
    Platform annotated("annotated", config, cloud, Timing::Annotated);
    annotated.memory->latency = sc_core::sc_time(51, sc_core::SC_NS);
    p.at.ending = GetParam();
    std::uint64_t at_cycles = 0;
    std::uint64_t annotated_cycles = 0;
    p.host.script = frame(at_cycles);
    annotated.host.script = frame(annotated_cycles);
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished && annotated.host.finished);
    EXPECT_EQ(p.pixels(camera), annotated.frame(camera));
    EXPECT_GT(p.at.requests, 20U);
    EXPECT_EQ(p.at.under_way, 0U);
    const Ending ending = GetParam();
    if (ending == Ending::Four || ending == Ending::RequestAtOnce || ending == Ending::Completed) {
        EXPECT_EQ(at_cycles, annotated_cycles);
    } else {
        EXPECT_GT(at_cycles, annotated_cycles);
    }
    if (ending == Ending::Four || ending == Ending::RequestAtOnce) {
        EXPECT_GT(p.at.most_under_way, 1U);
    }
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunAtAccelerator,
                         ::testing::Values(Ending::Four, Ending::RequestAtOnce, Ending::NoEndReq,
                                           Ending::AnswerAtOnce, Ending::Completed, Ending::Mixed),
                         ending_name);

using SmallRunAtPlatform = SmallRunAtAccelerator;

// Two clusters share records that come late, captured for others and from the cache.
TEST_F(SmallRunAtPlatform, ClustersShareRecordsThatComeLate) {
    config.clusters = 2;
    config.front.fifo_splats = 128;
    config.front.multicast_window = 16;
    config.front.cache_bytes = 4096;
    Accelerator::Options strict_options = four_phases();
    strict_options.fidelity = Fidelity::Strict;
    AtPlatform exact("exact", config, cloud);
    AtPlatform strict("strict", config, cloud, strict_options);
    AtPlatform mixed("mixed", config, cloud);
    Platform annotated("annotated", config, cloud, Timing::Annotated);
    mixed.at.ending = Ending::Mixed;
    std::uint64_t cycles[4] = {};
    exact.host.script = frame(cycles[0]);
    strict.host.script = frame(cycles[1]);
    mixed.host.script = frame(cycles[2]);
    annotated.host.script = frame(cycles[3]);
    sc_core::sc_start();
    EXPECT_TRUE(exact.host.finished && strict.host.finished && mixed.host.finished);
    EXPECT_EQ(cycles[0], cycles[1]);
    for (const AtPlatform* platform : {&exact, &strict, &mixed}) {
        EXPECT_EQ(platform->pixels(camera), annotated.frame(camera));
        EXPECT_EQ(platform->at.under_way, 0U);
    }
    // 50 ns and half a cycle at least lie between a request and its answer.
    EXPECT_GE(cycles[0], cycles[3]);
}

TEST_F(SmallRunAtPlatform, AsManyAccessesAreUrgentAsThroughLt) {
    config.memory.priority = ReadPriority::Blending;
    constexpr std::uint64_t kBurst = 64;
    Accelerator::Options bursts;
    bursts.memory.burst_bytes = kBurst;
    Platform lt("lt", config, cloud,
                std::make_unique<PlainMemory>("lt_memory", kMemoryBytes, Timing::Annotated),
                bursts);
    AtPlatform at("at", config, cloud, four_phases(64, kBurst));
    std::uint64_t cycles = 0;
    lt.host.script = frame(cycles);
    at.host.script = frame(cycles);
    sc_core::sc_start();
    ASSERT_TRUE(lt.host.finished && at.host.finished);
    EXPECT_GT(lt.memory->urgent, 0U);
    EXPECT_LT(lt.memory->urgent, lt.memory->accesses);
    EXPECT_EQ(at.at.urgent, lt.memory->urgent);
    EXPECT_EQ(at.at.requests, lt.memory->accesses);
}

TEST_F(SmallRunAtPlatform, StrictTakesTheSameTime) {
    Accelerator::Options strict_options = four_phases();
    strict_options.fidelity = Fidelity::Strict;
    AtPlatform exact("exact", config, cloud);
    AtPlatform strict("strict", config, cloud, strict_options);
    std::uint64_t exact_cycles = 0;
    std::uint64_t strict_cycles = 1;
    exact.host.script = frame(exact_cycles);
    strict.host.script = frame(strict_cycles);
    sc_core::sc_start();
    EXPECT_EQ(exact_cycles, strict_cycles);
    EXPECT_EQ(exact.pixels(camera), strict.pixels(camera));
}

TEST_F(SmallRunAtPlatform, LoadsTheSceneThroughTheFourPhasesWhereThereIsNoDebugTransport) {
    AtPlatform p("accelerator", config, cloud);
    p.at.has_debug = false;
    std::uint64_t cycles = 0;
    p.host.script = frame(cycles);
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    // Pieces of 4 KiB, 50 ns each: 150 records of 44 B and of 48 B.
    EXPECT_EQ(loaded, 50U * (2 + 2));
}

TEST_F(SmallRunAtPlatform, KeepsToTheBoundOfTransactionsAndToTheSizeOfPieces) {
    AtPlatform one("one", config, cloud, four_phases(1, 256));
    AtPlatform many("many", config, cloud, four_phases(1000, 256));
    std::uint64_t one_cycles = 0;
    std::uint64_t many_cycles = 0;
    one.host.script = frame(one_cycles);
    many.host.script = frame(many_cycles);
    sc_core::sc_start();
    EXPECT_EQ(one.at.most_under_way, 1U);
    EXPECT_GT(many.at.most_under_way, 10U); // a chunk of geometry alone has 11 pieces
    EXPECT_EQ(one.at.longest, 256U);
    EXPECT_EQ(many.at.longest, 256U);
    EXPECT_GT(one_cycles, many_cycles);
    EXPECT_EQ(one.pixels(camera), many.pixels(camera));
}

TEST_F(SmallRunAtPlatform, OurLpddr5GivesTheSameBytesThroughBothInterfaces) {
    Platform plain("plain", config, cloud);
    Platform lt("lt", config, cloud, nullptr);
    Platform at("at", config, cloud, nullptr, four_phases());
    const Timebase time{ClockDomain(1.0), Fidelity::Exact};
    dram::Lpddr5 lt_memory("lt_memory", {}, time, 1);
    dram::Lpddr5 at_memory("at_memory", {}, time, 1);
    lt.mem().bind(lt_memory.in[0]);
    at.mem().bind(at_memory.in[0]);
    std::uint64_t cycles = 0;
    std::vector<unsigned char> lt_bytes(plain.frame(camera).size());
    std::vector<unsigned char> at_bytes = lt_bytes;
    const auto script = [&](Platform& p, std::vector<unsigned char>& pixels) {
        return [&](Host& host) {
            const auto debug = [&](tlm::tlm_command command, std::uint64_t address,
                                   std::vector<unsigned char>& data) {
                tlm::tlm_generic_payload payload;
                payload.set_command(command);
                payload.set_address(address);
                payload.set_data_ptr(data.data());
                payload.set_data_length(static_cast<unsigned>(data.size()));
                EXPECT_EQ(p.accelerator.mem->transport_dbg(payload), data.size());
            };
            std::vector<unsigned char> geometry;
            std::vector<unsigned char> sh;
            encode_scene(cloud, geometry, sh);
            debug(tlm::TLM_WRITE_COMMAND, 0, geometry);
            debug(tlm::TLM_WRITE_COMMAND, kSh, sh);
            frame(cycles)(host);
            debug(tlm::TLM_READ_COMMAND, kFrame, pixels);
            EXPECT_GT(cycles, 0U);
        };
    };
    lt.host.script = script(lt, lt_bytes);
    at.host.script = script(at, at_bytes);
    plain.host.script = frame(cycles);
    sc_core::sc_start();
    ASSERT_TRUE(lt.host.finished && at.host.finished);
    EXPECT_EQ(lt_bytes, plain.frame(camera));
    EXPECT_EQ(at_bytes, plain.frame(camera));
    EXPECT_EQ(at_memory.stats(0).bytes_read, lt_memory.stats(0).bytes_read);
    EXPECT_GT(at_memory.stats(0).reads, 0U);
}

TEST_F(SmallRunAtPlatform, ABusErrorEndsTheFrameWithAnError) {
    AtPlatform p("accelerator", config, cloud);
    p.host.script = [&](Host& host) {
        program(host, cloud, camera);
        p.at.refused_from = kFrame + 4000;
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::BusError);
        EXPECT_EQ(host.read(Register::ErrorDetail), 1U);
        p.at.refused_from = 2000; // in the geometry
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::LoadError);
        p.at.refused_from = ~std::uint64_t{0};
        EXPECT_TRUE(host.render());
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

TEST_F(SmallRunAtPlatform, TwoWorkAtATime) {
    AtPlatform one("one", config, cloud);
    AtPlatform two("two", config, cloud);
    Platform reference("reference", config, cloud);
    std::uint64_t cycles = 0;
    one.host.script = reference.host.script = frame(cycles);
    two.at.ending = Ending::Completed;
    two.host.script = [&](Host& host) {
        sc_core::wait(sc_core::sc_time(1234.5, sc_core::SC_NS));
        frame(cycles)(host);
        frame(cycles)(host);
    };
    sc_core::sc_start();
    ASSERT_TRUE(one.host.finished && two.host.finished);
    EXPECT_EQ(one.pixels(camera), reference.frame(camera));
    EXPECT_EQ(two.pixels(camera), reference.frame(camera));
}

} // namespace
} // namespace degs::test
