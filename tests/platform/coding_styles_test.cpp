// SPDX-License-Identifier: Apache-2.0
// The same frame under every coding style of TLM-2.0: prints the table of docs/accelerator.md.
#include <chrono>
#include <cstdio>
#include <deque>
#include <string>

#include "modules/degs/config.hpp"
#include "scene/scene.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/busy_memory.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

constexpr std::uint64_t kStyleSh = 4U << 20U, kStyleWorkspace = 8U << 20U;
constexpr std::uint64_t kStyleFrame = 56U << 20U, kStyleMemory = 64U << 20U;
constexpr int kStyleLines = 1500; // of a processor, during the first 150 us of a frame

/// An accelerator whose frame begins when its turn has come, so that the host's time is its own.
struct StylePlatform {
    StylePlatform(const char* name, const Scene& scene, const Camera& camera,
                  const MemoryGateway::Options& memory)
        : p(name, DegsConfig(), scene.cloud, nullptr, with(memory)) {
        p.host.script = [this, &scene, camera](Host& host) {
            sc_core::wait(turn);
            program(host, scene.cloud, camera, kStyleFrame);
            host.write_pair(Register::Sh, kStyleSh);
            host.write_pair(Register::Workspace, kStyleWorkspace);
            host.write_pair(Register::WorkspaceBytes, kStyleFrame - kStyleWorkspace);
            EXPECT_TRUE(host.render()) << "error " << host.read(Register::ErrorCode);
            cycles = host.read_pair(Register::Cycles);
            sc_core::sc_pause();
        };
    }
    static Accelerator::Options with(const MemoryGateway::Options& memory) {
        Accelerator::Options options;
        options.memory = memory;
        return options;
    }
    /// Renders while nobody else has anything to do; seconds of the host.
    double render() {
        turn.notify(sc_core::SC_ZERO_TIME);
        const auto begin = std::chrono::steady_clock::now();
        sc_core::sc_start();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }
    sc_core::sc_event turn;
    Platform p;
    std::uint64_t cycles = 0;
};

/// An annotated memory that a processor shares.
struct LtStyle {
    LtStyle(const std::string& name, const Scene& scene, const Camera& camera, Pacing pacing,
            double quantum)
        : memory((name + "_memory").c_str(), kStyleMemory, 2),
          platform(name.c_str(), scene, camera, paced(pacing)),
          cpu((name + "_cpu").c_str(), kStyleLines, 100, &platform.turn), quantum_ns(quantum) {
        platform.p.mem().bind(memory.in[0]);
        cpu.out.bind(memory.in[1]);
    }
    static MemoryGateway::Options paced(Pacing pacing) {
        MemoryGateway::Options options;
        options.pacing = pacing;
        return options;
    }
    BusyMemory memory;
    StylePlatform platform;
    LineReader cpu;
    double quantum_ns;
    double seconds = 0; // of the host
};

TEST(LongCodingStyles, CostSpeedAndError) {
    DEGS_NEEDS_SCENE("flowers-small");
    const Scene scene = load_scene((scenes() / "flowers-small" / "scene.ply").string());
    Camera camera = select_camera(scene, 2);
    camera.width = 960;
    camera.height = 540;
    camera.fx /= 2;
    camera.fy /= 2;
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(scene.cloud, geometry, sh);

    const Timebase time;
    Memory::Config bus;
    bus.latency_ns = BusyMemory::kLatencyNs;
    Memory own_memory("own_memory", bus, time, 1);
    StylePlatform own("own", scene, camera, LtStyle::paced(Pacing::Annotated));
    own.p.mem().bind(own_memory.in[0]);
    const auto poke = [&](std::uint64_t address, std::vector<unsigned char>& data) {
        tlm::tlm_generic_payload payload;
        payload.set_command(tlm::TLM_WRITE_COMMAND);
        payload.set_address(address);
        payload.set_data_ptr(data.data());
        payload.set_data_length(static_cast<unsigned>(data.size()));
        EXPECT_EQ(own.p.accelerator.mem->transport_dbg(payload), data.size());
    };

    std::deque<LtStyle> lt;
    lt.emplace_back("exact", scene, camera, Pacing::Exact, 0);
    for (const int quantum : {10, 100, 1000, 10000}) {
        lt.emplace_back("quantum_" + std::to_string(quantum), scene, camera, Pacing::Quantum,
                        quantum);
    }
    lt.emplace_back("annotated", scene, camera, Pacing::Annotated, 0);

    MemoryGateway::Options four_phases;
    four_phases.transport = Transport::At;
    four_phases.outstanding = 1000;
    four_phases.burst_bytes = 64;
    AtMemory at_memory("at_memory", kStyleMemory);
    at_memory.accept = sc_core::sc_time(64 / BusyMemory::kBytesPerNs, sc_core::SC_NS);
    StylePlatform at("at", scene, camera, four_phases);
    at.p.mem().bind(at_memory.in);

    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    poke(0, geometry);
    poke(kStyleSh, sh);
    const auto put = [&](std::vector<unsigned char>& memory) {
        std::copy(geometry.begin(), geometry.end(), memory.begin());
        std::copy(sh.begin(), sh.end(), memory.begin() + kStyleSh);
    };
    const double own_seconds = own.render();
    for (LtStyle& style : lt) {
        put(style.memory.bytes);
        tlm::tlm_global_quantum::instance().set(sc_core::sc_time(style.quantum_ns, sc_core::SC_NS));
        style.seconds = style.platform.render();
    }
    put(at_memory.bytes);
    const double at_seconds = at.render();

    const auto exact = static_cast<double>(lt.front().platform.cycles);
    const auto print = [&](const std::string& name, std::uint64_t cycles, double line,
                           double seconds) {
        std::printf("| %s | %.1f | %+.1f %% | %s | %.2f |\n", name.c_str(),
                    static_cast<double>(cycles) / 1e3,
                    100 * (static_cast<double>(cycles) / exact - 1),
                    line > 0 ? std::to_string(static_cast<int>(line + 0.5)).c_str() : "",
                    seconds / own_seconds);
    };
    print("own bus", own.cycles, 0, own_seconds);
    for (const LtStyle& style : lt) {
        print(style.memory.name(), style.platform.cycles, style.cpu.worst(), style.seconds);
    }
    print("at", at.cycles, 0, at_seconds);

    EXPECT_GT(exact, 100000);
    EXPECT_NEAR(static_cast<double>(lt[2].platform.cycles), exact, 0.02 * exact); // 100 ns
    EXPECT_LT(lt.front().cpu.worst(), lt.back().cpu.worst());
    for (const LtStyle& style : lt) {
        EXPECT_TRUE(std::equal(style.memory.bytes.begin() + kStyleFrame, style.memory.bytes.end(),
                               at_memory.bytes.begin() + kStyleFrame));
    }
}

} // namespace
} // namespace degs::test
