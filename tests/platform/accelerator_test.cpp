// SPDX-License-Identifier: Apache-2.0
// degs::Accelerator with DeGS behind it, on a memory that is not ours.
#include <glm/gtc/packing.hpp>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

class SmallRunAccelerator : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    DegsConfig config;

    void run(Platform& platform, const std::function<void(Host&)>& script) {
        platform.host.script = script;
        sc_core::sc_start();
        EXPECT_TRUE(platform.host.finished) << "the platform has stopped before the script's end";
    }
};

TEST_F(SmallRunAccelerator, WritesThePixelsOfAClosedJobAndCountsThem) {
    Platform p("accelerator", config, cloud);
    const Closed closed("closed", config, cloud, camera);
    std::uint64_t fragments = 0;
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Status), kStatusDone);
        EXPECT_EQ(host.error(), AcceleratorError::None);
        EXPECT_EQ(host.read(Register::Frames), 1U);
        EXPECT_EQ(host.read(Register::Dropped), 0U);
        EXPECT_EQ(host.read_pair(Register::LoadCycles), 0U); // by debug transport
        EXPECT_GE(host.read_pair(Register::BytesRead), cloud.size() * kFloatGeometryBytes);
        EXPECT_GE(host.read_pair(Register::BytesWritten), p.frame(camera).size());
        EXPECT_GT(host.read_pair(Register::Cycles), 1000U);
        fragments = host.read_pair(Register::Fragments);
    });
    EXPECT_EQ(p.frame(camera), closed.pixels());
    std::uint64_t expected = 0;
    for (const std::uint32_t updates : closed.job.images.front().fragments) {
        expected += updates;
    }
    EXPECT_EQ(fragments, expected);
    EXPECT_GT(fragments, 0U);
}

TEST_F(SmallRunAccelerator, RendersFramesOfOtherCamerasSizesAndFormatsOneAfterTheOther) {
    Platform p("accelerator", config, cloud);
    Camera second = test_camera(50, 33);
    second.position.x = -1;
    Camera behind = camera;
    behind.position.z = 50; // nothing to see
    const Closed a("a", config, cloud, camera);
    const Closed b("b", config, cloud, second);
    std::vector<unsigned char> first;
    std::vector<unsigned char> other;
    std::vector<unsigned char> nothing;
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        first = p.frame(camera);
        program(host, cloud, second, kFrame + 0x8000);
        EXPECT_TRUE(host.render());
        other = p.frame(second, kFrame + 0x8000);
        program(host, cloud, behind);
        EXPECT_TRUE(host.render());
        nothing = p.frame(behind);
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(p.frame(camera), first);
        host.write(Register::Format, static_cast<std::uint32_t>(FrameFormat::Rgba16F));
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Frames), 5U);
    });
    EXPECT_EQ(first, a.pixels());
    EXPECT_EQ(other, b.pixels());
    EXPECT_EQ(nothing, std::vector<unsigned char>(nothing.size(), 0));
    const std::vector<unsigned char> halves = p.frame(camera, kFrame, 8);
    const Image& image = a.job.images.front();
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        std::uint16_t green = 0;
        std::memcpy(&green, halves.data() + 8 * i + 2, 2);
        ASSERT_EQ(green, glm::packHalf1x16(image.rgb[3 * i + 1])) << i;
    }
}

TEST_F(SmallRunAccelerator, StrictRendersTheSameInTheSameTime) {
    Accelerator::Options strict;
    strict.fidelity = Fidelity::Strict;
    Platform exact("exact", config, cloud);
    Accelerator other("strict", config, strict);
    PlainMemory memory("memory", kMemoryBytes, Timing::Annotated);
    memory.bytes = exact.memory->bytes;
    Host host("host");
    sc_core::sc_signal<bool> irq;
    other.irq.bind(irq);
    host.irq.bind(irq);
    host.out.bind(other.registers);
    BaseProtocolMonitor monitor("monitor");
    other.mem.bind(monitor.in);
    monitor.out.bind(memory.in);
    std::vector<std::uint64_t> cycles;
    const auto script = [&](Host& h) {
        for (int frame = 0; frame < 2; ++frame) {
            program(h, cloud, camera);
            EXPECT_TRUE(h.render());
            cycles.push_back(h.read_pair(Register::Cycles));
        }
    };
    host.script = script;
    run(exact, script);
    EXPECT_TRUE(host.finished);
    ASSERT_EQ(cycles.size(), 4U);
    EXPECT_EQ(cycles[0], cycles[1]);
    EXPECT_EQ(cycles[2], cycles[3]);
    EXPECT_EQ(exact.frame(camera),
              std::vector<unsigned char>(memory.bytes.begin() + kFrame,
                                         memory.bytes.begin() + kFrame + 96 * 72 * 4));
}

TEST_F(SmallRunAccelerator, ImmediateAnnotatedAndBlockingMemoriesGiveTheSameBytes) {
    Platform immediate("immediate", config, cloud, Timing::Immediate);
    Platform annotated("annotated", config, cloud, Timing::Annotated);
    Platform blocking("blocking", config, cloud, Timing::Blocking, false);
    std::vector<std::uint64_t> cycles(3);
    std::uint64_t load = 0;
    const auto script = [&](std::size_t index) {
        return [&, index](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles[index] = host.read_pair(Register::Cycles);
            load = std::max(load, host.read_pair(Register::LoadCycles));
        };
    };
    immediate.host.script = script(0);
    annotated.host.script = script(1);
    run(blocking, script(2));
    EXPECT_EQ(annotated.frame(camera), immediate.frame(camera));
    EXPECT_EQ(blocking.frame(camera), immediate.frame(camera));
    EXPECT_LT(cycles[0], cycles[1]);
    EXPECT_LT(cycles[1], cycles[2]);
    // Pieces of 4 KiB, 50 ns each: 150 records of 44 B and of 48 B.
    EXPECT_EQ(load, 50U * (2 + 2));
}

// The scene has 150 records of 44 B and of 48 B, so that pages of 4096 and of 100 B cut both.
TEST_F(SmallRunAccelerator, AMemoryThatMovesAPartByDebugTransportIsAskedForTheRest) {
    Platform whole("whole", config, cloud);
    Platform pages("pages", config, cloud);
    Platform odd("odd", config, cloud);
    pages.memory->most_debug_bytes = 4096;
    odd.memory->most_debug_bytes = 100;
    const auto script = [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read_pair(Register::LoadCycles), 0U);
    };
    pages.host.script = script;
    odd.host.script = script;
    run(whole, script);
    EXPECT_EQ(pages.frame(camera), whole.frame(camera));
    EXPECT_EQ(odd.frame(camera), whole.frame(camera));
}

// No memory of this platform is there, so that such a frame meets an error of the bus.
TEST_F(SmallRunAccelerator, AFrameBufferMayEndWithTheLastAddress) {
    Platform p("accelerator", config, cloud);
    run(p, [&](Host& host) {
        const std::uint64_t bytes = 4 * camera.pixels();
        program(host, cloud, camera);
        host.write_pair(Register::FrameBuffer, 0 - bytes);
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::BusError);
        host.write_pair(Register::FrameBuffer, 0 - bytes + 64);
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::Overlap);
        host.write_pair(Register::FrameBuffer, kFrame);
        host.write_pair(Register::Workspace, ~std::uint64_t{63} - kWorkspaceBytes + 128);
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::Overlap);
    });
}

TEST_F(SmallRunAccelerator, ASceneThatIsWrittenMeanwhileIsAnError) {
    Platform p("accelerator", config, cloud);
    p.memory->on_access = [&](std::uint64_t access) {
        p.memory->bytes[100] ^= access == 1 ? 1 : 0;
    };
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::SceneChanged);
        EXPECT_TRUE(host.render()); // the scene is what it is now
        bool first = true;
        p.memory->on_access = [&](std::uint64_t) {
            for (std::size_t i = 0; first && i < 4 * cloud.sh.size(); i += 4) {
                p.memory->bytes[kSh + i] ^= 1;
            }
            first = false;
        };
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::SceneChanged);
    });
}

TEST_F(SmallRunAccelerator, CountersAreThoseOfTheFrame) {
    Platform p("accelerator", config, cloud);
    run(p, [&](Host& host) {
        std::vector<std::uint64_t> counts[2];
        for (auto& of_frame : counts) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            for (const Register counter : {Register::Cycles, Register::BytesRead,
                                           Register::BytesWritten, Register::Fragments}) {
                of_frame.push_back(host.read_pair(counter));
                EXPECT_GT(of_frame.back(), 0U);
            }
        }
        EXPECT_EQ(counts[0], counts[1]);
    });
}

TEST_F(SmallRunAccelerator, ABusErrorEndsTheFrameWithAnErrorAndNotTheSimulation) {
    Platform p("accelerator", config, cloud);
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        p.memory->refused_from = kFrame + 4000;
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.read(Register::Status), kStatusError);
        EXPECT_EQ(host.error(), AcceleratorError::BusError);
        EXPECT_EQ(host.read(Register::ErrorDetail), 1U);
        EXPECT_GT(p.memory->refused, 0U);
        EXPECT_GT(host.read_pair(Register::Fragments), 0U);
        p.memory->refused_from = 2000; // in the geometry
        EXPECT_FALSE(host.render());
        EXPECT_EQ(host.error(), AcceleratorError::LoadError);
        for (const Register counter :
             {Register::Cycles, Register::BytesRead, Register::BytesWritten, Register::Fragments}) {
            EXPECT_EQ(host.read_pair(counter), 0U); // nothing has been drawn
        }
        p.memory->refused_from = ~std::uint64_t{0};
        host.write(Register::Control, kControlClearError);
        EXPECT_EQ(host.read(Register::Status) & kStatusError, 0U);
        EXPECT_EQ(host.error(), AcceleratorError::None);
        EXPECT_EQ(host.read(Register::ErrorDetail), 0U);
        EXPECT_TRUE(host.render());
    });
}

TEST_F(SmallRunAccelerator, GaussiansThatCannotBeDrawnAreCountedAndLeftOut) {
    GaussianCloud broken = cloud;
    broken.opacities[3] = 2;
    broken.scales[10].x = std::numeric_limits<float>::quiet_NaN();
    broken.rotations[20] = glm::vec4(0);
    Platform p("accelerator", config, broken);
    sanitize(broken);
    ASSERT_EQ(broken.size(), cloud.size() - 3);
    const Closed closed("closed", config, broken, camera);
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        EXPECT_EQ(host.read(Register::Dropped), 3U);
    });
    EXPECT_EQ(p.frame(camera), closed.pixels());
}

TEST_F(SmallRunAccelerator, TwoWorkAtATimeInOneMemoryOfTheirOwn) {
    const GaussianCloud more = test_cloud(2, 120, 0);
    Platform one("one", config, cloud);
    Platform two("two", config, more);
    const Closed a("a", config, cloud, camera);
    const Closed b("b", config, more, camera);
    two.host.script = [&](Host& host) {
        sc_core::wait(sc_core::sc_time(1234.5, sc_core::SC_NS));
        program(host, more, camera);
        EXPECT_TRUE(host.render());
    };
    run(one, [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        EXPECT_TRUE(host.render());
    });
    EXPECT_TRUE(two.host.finished);
    EXPECT_EQ(one.frame(camera), a.pixels());
    EXPECT_EQ(two.frame(camera), b.pixels());
}

TEST_F(SmallRunAccelerator, AStartWhileBusyIsIgnoredAndFlagged) {
    Platform p("accelerator", config, cloud);
    run(p, [&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::Control, kControlStart);
        EXPECT_EQ(host.read(Register::Status), kStatusBusy);
        host.write(Register::Control, kControlStart);
        EXPECT_EQ(host.read(Register::Status), kStatusBusy | kStatusStartIgnored);
        host.write(Register::Width, 0); // for the next frame
        host.write(Register::IrqEnable, kIrqDone);
        EXPECT_TRUE(host.await_irq());
        EXPECT_EQ(host.read(Register::Status), kStatusDone | kStatusStartIgnored);
        EXPECT_EQ(host.read(Register::Frames), 1U);
    });
}

} // namespace
} // namespace degs::test
