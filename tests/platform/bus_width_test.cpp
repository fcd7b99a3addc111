// SPDX-License-Identifier: Apache-2.0
// Accelerators on memories whose sockets have another width.
#include "degs/bus_width.hpp"

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

/// An accelerator behind sockets of BITS, for its registers and its memory, LT or AT.
template <unsigned int BITS>
struct WidePlatform {
    WidePlatform(const std::string& name, const GaussianCloud& cloud, bool at)
        : accelerator(name.c_str(), DegsConfig(), options(at)),
          monitor((name + "_monitor").c_str()), to_wide((name + "_to_wide").c_str()),
          to_narrow((name + "_to_narrow").c_str()), registers((name + "_registers").c_str()),
          host_side((name + "_host_side").c_str()), host((name + "_host").c_str()),
          irq((name + "_irq").c_str()) {
        accelerator.irq.bind(irq);
        host.irq.bind(irq);
        host.out.bind(host_side.in);
        host_side.out.bind(registers.in);
        registers.out.bind(accelerator.registers);
        accelerator.mem.bind(monitor.in);
        monitor.out.bind(to_wide.in);
        to_wide.out.bind(to_narrow.in);
        if (at) {
            phases = std::make_unique<AtMemory>((name + "_memory").c_str(), kMemoryBytes);
            to_narrow.out.bind(phases->in);
        } else {
            plain = std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes,
                                                  Timing::Annotated);
            to_narrow.out.bind(plain->in);
        }
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bytes().begin());
        std::copy(sh.begin(), sh.end(), bytes().begin() + kSh);
    }
    static Accelerator::Options options(bool at) {
        Accelerator::Options options;
        if (at) {
            options.memory.transport = Transport::At;
        }
        return options;
    }
    std::vector<unsigned char>& bytes() { return phases ? phases->bytes : plain->bytes; }

    ~WidePlatform() { EXPECT_TRUE(monitor.violations(false).empty()); }

    Accelerator accelerator;
    BaseProtocolMonitor monitor;
    BusWidth<32, BITS> to_wide;
    BusWidth<BITS, 32> to_narrow, registers;
    BusWidth<32, BITS> host_side;
    std::unique_ptr<PlainMemory> plain; // one of these
    std::unique_ptr<AtMemory> phases;
    Host host;
    sc_core::sc_signal<bool> irq;
    std::uint64_t cycles = 0;
};

template <unsigned int BITS>
std::vector<std::unique_ptr<WidePlatform<BITS>>> platforms(const GaussianCloud& cloud,
                                                           const Camera& camera) {
    std::vector<std::unique_ptr<WidePlatform<BITS>>> all;
    for (const bool at : {false, true}) {
        all.push_back(std::make_unique<WidePlatform<BITS>>(
            "w" + std::to_string(BITS) + (at ? "at" : "lt"), cloud, at));
        WidePlatform<BITS>& platform = *all.back();
        platform.host.script = [&platform, cloud, camera](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            platform.cycles = host.read_pair(Register::Cycles);
        };
    }
    return all;
}

TEST(SmallRunBusWidths, ChangeNeitherPixelsNorTime) {
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    const auto narrow = platforms<32>(cloud, camera);
    const auto wide64 = platforms<64>(cloud, camera);
    const auto wide128 = platforms<128>(cloud, camera);
    const auto wide256 = platforms<256>(cloud, camera);
    Platform direct("direct", DegsConfig(), cloud);
    std::uint64_t cycles = 0;
    direct.host.script = [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        cycles = host.read_pair(Register::Cycles);
    };
    sc_core::sc_start();
    EXPECT_GT(cycles, 0U);
    EXPECT_EQ(narrow[0]->cycles, cycles);
    EXPECT_EQ(narrow[0]->bytes(), direct.memory->bytes);
    for (const std::size_t at : {0U, 1U}) {
        for (const std::uint64_t other :
             {wide64[at]->cycles, wide128[at]->cycles, wide256[at]->cycles}) {
            EXPECT_EQ(other, narrow[at]->cycles) << at;
        }
        EXPECT_EQ(wide64[at]->bytes(), narrow[at]->bytes()) << at;
        EXPECT_EQ(wide128[at]->bytes(), narrow[at]->bytes()) << at;
        EXPECT_EQ(wide256[at]->bytes(), narrow[at]->bytes()) << at;
    }
    EXPECT_EQ(wide256[0]->plain->accesses, direct.memory->accesses);
    EXPECT_EQ(wide256[0]->to_wide.out.get_bus_width(), 256U);
}

} // namespace
} // namespace degs::test
