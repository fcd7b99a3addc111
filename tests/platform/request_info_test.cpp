// SPDX-License-Identifier: Apache-2.0
// Every transaction says which stream it belongs to, and none crosses a boundary.
#include "degs/request_info.hpp"

#include <map>
#include <set>

#include "baselines/accelerators.hpp"
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/transaction_recorder.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

TEST(RequestInfo, NamesAreThoseOfReports) {
    for (std::uint32_t number = 0; number < 14; ++number) {
        const auto stream = static_cast<RequestStream>(number);
        EXPECT_EQ(request_stream(to_string(stream)), stream);
    }
    EXPECT_STREQ(to_string(RequestStream::TileListsSorted), "tile_lists_sorted");
    EXPECT_STREQ(to_string(static_cast<RequestStream>(14)), "other");
    EXPECT_EQ(request_stream("of_my_own"), RequestStream::Other);
}

struct Manager : tlm::tlm_mm_interface {
    void free(tlm::tlm_generic_payload* payload) override { payload->reset(); }
};

TEST(RequestInfo, IsCopiedWithItsPayload) {
    Manager manager;
    tlm::tlm_generic_payload from(&manager);
    tlm::tlm_generic_payload to(&manager);
    auto* const info = new RequestInfo;
    info->stream = RequestStream::Sh;
    info->qos = 9;
    from.set_auto_extension(info);
    from.acquire();
    to.acquire();
    to.deep_copy_from(from); // clones
    ASSERT_NE(to.get_extension<RequestInfo>(), info);
    EXPECT_EQ(to.get_extension<RequestInfo>()->stream, RequestStream::Sh);
    EXPECT_EQ(to.get_extension<RequestInfo>()->qos, 9U);
    info->qos = 3;
    to.deep_copy_from(from); // copies into the one that is there
    EXPECT_EQ(to.get_extension<RequestInfo>()->qos, 3U);
    from.release();
    EXPECT_EQ(to.get_extension<RequestInfo>()->stream, RequestStream::Sh);
    to.release();
}

/// What a frame sends through LT or AT, and what it leaves in the frame buffer.
struct SentFrame {
    std::vector<SeenTransaction> seen;
    std::vector<unsigned char> pixels;
    std::uint64_t cycles = 0;

    std::map<RequestStream, std::uint64_t> bytes() const {
        std::map<RequestStream, std::uint64_t> sums;
        for (const SeenTransaction& each : seen) {
            sums[each.stream] += each.bytes;
        }
        return sums;
    }
};

struct Sending {
    Sending(const std::string& name, const AcceleratorConfig& config,
            const AcceleratorOptions::Memory& memory, bool has_debug = true)
        : platform(name.c_str(), config, cloud, nullptr, options_of(memory)),
          recorder((name + "_recorder").c_str()) {
        platform.mem().bind(recorder.in);
        if (memory.transport == Transport::At) {
            at = std::make_unique<AtMemory>((name + "_memory").c_str(), kMemoryBytes);
            at->has_debug = has_debug;
            recorder.out.bind(at->in);
        } else {
            lt = std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes,
                                               Timing::Annotated, has_debug);
            recorder.out.bind(lt->in);
        }
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bytes().begin());
        std::copy(sh.begin(), sh.end(), bytes().begin() + kSh);
        platform.host.script = [this](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles = host.read_pair(Register::Cycles);
        };
    }
    static AcceleratorOptions options_of(const AcceleratorOptions::Memory& memory) {
        AcceleratorOptions options;
        options.memory = memory;
        return options;
    }
    std::vector<unsigned char>& bytes() { return at ? at->bytes : lt->bytes; }
    SentFrame frame() {
        EXPECT_TRUE(platform.host.finished);
        const auto begin = bytes().begin() + kFrame;
        return {recorder.seen, {begin, begin + camera.width * camera.height * 4}, cycles};
    }
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    std::uint64_t cycles = 0;
    Platform platform;
    TransactionRecorder recorder;
    std::unique_ptr<AtMemory> at;
    std::unique_ptr<PlainMemory> lt;
};

/// The regions of the bench's request.
enum class Region { Geometry, Sh, Workspace, Frame, None };
Region region_of(const SeenTransaction& each, const GaussianCloud& cloud, const Camera& camera) {
    const auto inside = [&each](std::uint64_t begin, std::uint64_t bytes) {
        return each.address >= begin && each.end() <= begin + bytes;
    };
    const std::uint64_t count = cloud.size();
    return inside(0, count * 44)                 ? Region::Geometry
           : inside(kSh, count * 4 * 3 * 4)      ? Region::Sh
           : inside(kWorkspace, kWorkspaceBytes) ? Region::Workspace
           : inside(kFrame, camera.pixels() * 4) ? Region::Frame
                                                 : Region::None;
}

Region region_of(RequestStream stream) {
    switch (stream) {
    case RequestStream::Geometry:
    case RequestStream::Means:
    case RequestStream::Shapes:
        return Region::Geometry;
    case RequestStream::Sh:
        return Region::Sh;
    case RequestStream::FrameBuffer:
        return Region::Frame;
    case RequestStream::Other:
    case RequestStream::SceneLoad:
        return Region::None;
    default:
        return Region::Workspace;
    }
}

class SmallRunRequestInfo : public ::testing::TestWithParam<std::string> {};

// Whatever a transaction is made of an access, its stream is that of its bytes.
TEST_P(SmallRunRequestInfo, NamesTheStreamOfEveryTransaction) {
    std::unique_ptr<AcceleratorConfig> config;
    for (const AcceleratorKind& each : accelerator_kinds()) {
        config = each.name == GetParam() ? each.make() : std::move(config);
    }
    std::vector<std::unique_ptr<Sending>> runs;
    for (const Transport transport : {Transport::Lt, Transport::At}) {
        for (const std::uint64_t burst : {0, 64}) {
            AcceleratorOptions::Memory memory;
            memory.transport = transport;
            memory.burst_bytes = burst;
            memory.qos = burst == 0 ? 0 : 11;
            const std::string name = "run" + std::to_string(runs.size());
            runs.push_back(std::make_unique<Sending>(name, *config, memory));
        }
    }
    sc_core::sc_start();
    for (const auto& run : runs) {
        const SentFrame frame = run->frame();
        std::set<RequestStream> writes;
        for (const SeenTransaction& each : frame.seen) {
            ASSERT_EQ(region_of(each, run->cloud, run->camera), region_of(each.stream))
                << to_string(each.stream) << " at " << each.address;
            ASSERT_EQ(each.qos, &run == &runs[1] || &run == &runs[3] ? 11U : 0U);
            if (each.write) {
                writes.insert(each.stream);
            }
        }
        EXPECT_EQ(writes.count(RequestStream::FrameBuffer), 1U);
        EXPECT_EQ(writes.count(RequestStream::Geometry) + writes.count(RequestStream::Sh), 0U);
        EXPECT_GE(frame.bytes().size(), 3U);
        EXPECT_EQ(frame.bytes().at(RequestStream::FrameBuffer), run->camera.pixels() * 4);
    }
}

INSTANTIATE_TEST_SUITE_P(Of, SmallRunRequestInfo,
                         ::testing::Values("degs", "gscore", "gbu", "gcc", "orange"),
                         [](const ::testing::TestParamInfo<std::string>& kind) {
                             return kind.param;
                         });

using SmallRunBoundary = ::testing::TestWithParam<Transport>;

// A frame and the reading of its scene. Regions begin beside pages, and rows of tiles end inside.
TEST_P(SmallRunBoundary, NoTransactionCrossesIt) {
    constexpr std::uint64_t kPage = 4096;
    const DegsConfig config;
    std::vector<std::unique_ptr<Sending>> runs;
    const auto crossing = [](const SentFrame& frame) {
        return std::count_if(frame.seen.begin(), frame.seen.end(), [](const SeenTransaction& t) {
            return t.address / kPage != (t.end() - 1) / kPage;
        });
    };
    for (const std::uint64_t boundary : {std::uint64_t{0}, kPage}) {
        AcceleratorOptions::Memory memory;
        memory.transport = GetParam();
        memory.boundary_bytes = boundary;
        const std::string name = "run" + std::to_string(runs.size());
        runs.push_back(std::make_unique<Sending>(name, config, memory, false));
    }
    sc_core::sc_start();
    const SentFrame anywhere = runs[0]->frame();
    const SentFrame bounded = runs[1]->frame();
    EXPECT_GT(crossing(anywhere), 0);
    EXPECT_EQ(crossing(bounded), 0);
    EXPECT_EQ(bounded.pixels, anywhere.pixels);
    EXPECT_EQ(bounded.bytes(), anywhere.bytes());
    EXPECT_GT(bounded.bytes().at(RequestStream::SceneLoad), 0U);
    EXPECT_GT(bounded.seen.size(), anywhere.seen.size());
    EXPECT_LT(bounded.seen.size(), 2 * anywhere.seen.size());
    if (GetParam() == Transport::Lt) {
        EXPECT_EQ(bounded.cycles, anywhere.cycles);
    }
}

INSTANTIATE_TEST_SUITE_P(Both, SmallRunBoundary, ::testing::Values(Transport::Lt, Transport::At),
                         [](const ::testing::TestParamInfo<Transport>& which) {
                             return which.param == Transport::Lt ? "LooselyTimed"
                                                                 : "ApproximatelyTimed";
                         });

} // namespace
} // namespace degs::test
