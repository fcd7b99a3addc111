// SPDX-License-Identifier: Apache-2.0
// Every accelerator keeps to the base protocol, whatever kind of memory it has.
#include <memory>
#include <string>
#include <tuple>

#include "baselines/accelerators.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/busy_memory.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

using Kind = std::string;

std::unique_ptr<AcceleratorConfig> config_of(const Kind& kind) {
    for (const AcceleratorKind& each : accelerator_kinds()) {
        if (each.name == kind) {
            return each.make();
        }
    }
    throw std::invalid_argument(kind);
}

std::vector<Kind> all_kinds() {
    std::vector<Kind> kinds;
    for (const AcceleratorKind& each : accelerator_kinds()) {
        kinds.emplace_back(each.name);
    }
    return kinds;
}

/// The kinds of transactions that a gateway makes of an access.
MemoryGateway::Options cut(std::uint64_t burst_bytes, BurstEnds ends = BurstEnds::Pieces) {
    MemoryGateway::Options options;
    options.burst_bytes = burst_bytes;
    options.burst_ends = ends;
    return options;
}

class MonitoredAccelerators : public ::testing::TestWithParam<Kind> {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    std::unique_ptr<AcceleratorConfig> config = config_of(GetParam());

    Accelerator::Options with(const MemoryGateway::Options& memory) const {
        Accelerator::Options options;
        options.memory = memory;
        return options;
    }
    void put_scene(std::vector<unsigned char>& bytes) const {
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bytes.begin());
        std::copy(sh.begin(), sh.end(), bytes.begin() + kSh);
    }
    std::vector<unsigned char> pixels(const std::vector<unsigned char>& bytes) const {
        const auto begin = bytes.begin() + kFrame;
        return {begin, begin + camera.width * camera.height * 4};
    }
    /// Two frames, so that whatever is used again is.
    void render(Platform& platform) const {
        platform.host.script = [this](Host& host) {
            for (int frame = 0; frame < 2; ++frame) {
                program(host, cloud, camera);
                EXPECT_TRUE(host.render()) << "error " << host.read(Register::ErrorCode);
            }
        };
    }
    static void expect_clean(const Platform& platform) {
        EXPECT_TRUE(platform.host.finished);
        const auto found = platform.monitor.violations();
        EXPECT_TRUE(found.empty())
            << found.size() << " violations, e.g. " << (found.empty() ? "" : found.front());
    }
};

// Early, late and blocking answers, with the hint of direct access in each; a memory that is busy
// annotates dates that grow.
TEST_P(MonitoredAccelerators, KeepsToTheProtocolWithBlockingMemories) {
    std::vector<std::unique_ptr<Platform>> platforms;
    const MemoryGateway::Options ways[] = {cut(0), cut(64), cut(32, BurstEnds::FullBursts)};
    for (const Timing timing : {Timing::Immediate, Timing::Annotated, Timing::Blocking}) {
        for (const MemoryGateway::Options& way : ways) {
            for (const bool debug : {true, false}) {
                const std::string name = "lt_" + std::to_string(platforms.size());
                platforms.push_back(std::make_unique<Platform>(
                    name.c_str(), *config, cloud,
                    std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes, timing,
                                                  debug),
                    with(way)));
                platforms.back()->monitor.hides_extensions = !debug;
                render(*platforms.back());
            }
        }
    }
    BusyMemory busy("busy", kMemoryBytes, 1);
    put_scene(busy.bytes);
    Platform shared("shared", *config, cloud, nullptr, with(cut(64)));
    shared.mem().bind(busy.in[0]);
    render(shared);
    sc_core::sc_start();
    for (const auto& each : platforms) {
        SCOPED_TRACE(each->host.name());
        expect_clean(*each);
        EXPECT_GT(each->monitor.blocking_calls(), 20U);
        EXPECT_EQ(each->monitor.requests(), 0U);
        EXPECT_EQ(each->frame(camera), platforms.front()->frame(camera));
    }
    expect_clean(shared);
    EXPECT_EQ(pixels(busy.bytes), platforms.front()->frame(camera));
}

// Answers in order and out of it, after END_REQ and without, by TLM_UPDATED and by TLM_COMPLETED.
TEST_P(MonitoredAccelerators, KeepsToTheProtocolWithFourPhases) {
    struct At {
        std::unique_ptr<Platform> platform;
        std::unique_ptr<AtMemory> memory;
    };
    std::vector<At> platforms;
    const MemoryGateway::Options ways[] = {cut(0), cut(64), cut(32, BurstEnds::FullBursts)};
    for (const Ending ending : {Ending::Four, Ending::RequestAtOnce, Ending::NoEndReq,
                                Ending::AnswerAtOnce, Ending::Completed, Ending::Mixed}) {
        for (const bool out_of_order : {false, true}) {
            MemoryGateway::Options way = ways[platforms.size() % std::size(ways)];
            way.transport = Transport::At;
            way.outstanding = out_of_order ? 64 : 3;
            const std::string name = "at_" + std::to_string(platforms.size());
            At at;
            at.platform =
                std::make_unique<Platform>(name.c_str(), *config, cloud, nullptr, with(way));
            at.memory = std::make_unique<AtMemory>((name + "_memory").c_str(), kMemoryBytes);
            at.memory->ending = ending;
            at.memory->out_of_order = out_of_order;
            at.memory->accept = sc_core::sc_time(out_of_order ? 0 : 2, sc_core::SC_NS);
            at.memory->has_debug = ending != Ending::Mixed;
            put_scene(at.memory->bytes);
            at.platform->mem().bind(at.memory->in);
            render(*at.platform);
            platforms.push_back(std::move(at));
        }
    }
    Platform plain("plain", *config, cloud);
    render(plain);
    sc_core::sc_start();
    for (const At& each : platforms) {
        SCOPED_TRACE(each.platform->host.name());
        expect_clean(*each.platform);
        EXPECT_GT(each.platform->monitor.requests(), 20U);
        EXPECT_EQ(each.platform->monitor.blocking_calls(), 0U);
        EXPECT_EQ(pixels(each.memory->bytes), plain.frame(camera));
    }
}

INSTANTIATE_TEST_SUITE_P(Families, MonitoredAccelerators, ::testing::ValuesIn(all_kinds()),
                         [](const auto& row) { return row.param; });

} // namespace
} // namespace degs::test
