// SPDX-License-Identifier: Apache-2.0
// What BYTES_READ and BYTES_WRITTEN count, against a target that counts what it is asked for.
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/platform/transaction_recorder.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

struct Sums {
    std::uint64_t read = 0, written = 0;
    friend bool operator==(const Sums& a, const Sums& b) {
        return a.read == b.read && a.written == b.written;
    }
    friend std::ostream& operator<<(std::ostream& out, const Sums& sums) {
        return out << sums.read << " B read, " << sums.written << " B written";
    }
};

struct Cut {
    const char* name;
    Transport transport;
    std::uint64_t burst_bytes = 0;
    BurstEnds ends = BurstEnds::Pieces;
    std::uint64_t boundary_bytes = 0;
};

AcceleratorOptions options_of(const Cut& cut) {
    AcceleratorOptions options;
    options.memory.transport = cut.transport;
    options.memory.burst_bytes = cut.burst_bytes;
    options.memory.burst_ends = cut.ends;
    options.memory.boundary_bytes = cut.boundary_bytes;
    return options;
}

/// Three frames, of which each register and a target count the bytes. The scene is read by
/// transactions, which are not of the frame.
struct CountedFrames {
    explicit CountedFrames(const Cut& cut)
        : platform(cut.name, DegsConfig(), cloud, nullptr, options_of(cut)),
          recorder((std::string(cut.name) + "_recorder").c_str()) {
        platform.mem().bind(recorder.in);
        const std::string name = std::string(cut.name) + "_memory";
        std::vector<unsigned char>* bytes = nullptr;
        if (cut.transport == Transport::At) {
            at = std::make_unique<AtMemory>(name.c_str(), kMemoryBytes);
            at->has_debug = false;
            recorder.out.bind(at->in);
            bytes = &at->bytes;
        } else {
            lt =
                std::make_unique<PlainMemory>(name.c_str(), kMemoryBytes, Timing::Annotated, false);
            recorder.out.bind(lt->in);
            bytes = &lt->bytes;
        }
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bytes->begin());
        std::copy(sh.begin(), sh.end(), bytes->begin() + kSh);
        platform.host.script = [this](Host& host) {
            Camera camera = test_camera();
            camera.width = 93; // rows of tiles end inside of bursts
            program(host, cloud, camera);
            for (int i = 0; i < 3; ++i) {
                recorder.seen.clear();
                EXPECT_TRUE(host.render());
                sc_core::wait(sc_core::sc_time(10, sc_core::SC_US)); // what is still under way
                registers.push_back(
                    {host.read_pair(Register::BytesRead), host.read_pair(Register::BytesWritten)});
                Sums sums;
                for (const SeenTransaction& each : recorder.seen) {
                    if (each.stream != RequestStream::SceneLoad) {
                        (each.write ? sums.written : sums.read) += each.bytes;
                    }
                }
                seen.push_back(sums);
            }
        };
    }
    GaussianCloud cloud = test_cloud();
    Platform platform;
    TransactionRecorder recorder;
    std::unique_ptr<AtMemory> at;
    std::unique_ptr<PlainMemory> lt;
    std::vector<Sums> registers, seen;
};

TEST(SmallRunBusCounters, CountWhatCrossesTheBus) {
    const Cut cuts[] = {{"lt", Transport::Lt},
                        {"lt_pieces", Transport::Lt, 64},
                        {"lt_full", Transport::Lt, 64, BurstEnds::FullBursts},
                        {"lt_pages", Transport::Lt, 0, BurstEnds::Pieces, 4096},
                        {"at", Transport::At},
                        {"at_pieces", Transport::At, 64},
                        {"at_full", Transport::At, 64, BurstEnds::FullBursts}};
    std::vector<std::unique_ptr<CountedFrames>> runs;
    for (const Cut& cut : cuts) {
        runs.push_back(std::make_unique<CountedFrames>(cut));
    }
    sc_core::sc_start();
    for (const auto& run : runs) {
        SCOPED_TRACE(run->platform.accelerator.name());
        ASSERT_TRUE(run->platform.host.finished);
        EXPECT_EQ(run->registers, run->seen);
        EXPECT_GT(run->seen[0].read, 1000U);
    }
    for (const std::size_t other : {1, 3}) {
        EXPECT_EQ(runs[other]->registers, runs[0]->registers);
    }
    EXPECT_EQ(runs[5]->registers[0].written, runs[4]->registers[0].written);
    for (const std::size_t full : {2, 6}) {
        const Sums& whole = runs[full]->registers[0];
        EXPECT_GT(whole.written, runs[full - 1]->registers[0].written);
        EXPECT_EQ(whole.written % 64, 0U);
        EXPECT_EQ(whole.read % 64, 0U);
    }
}

} // namespace
} // namespace degs::test
