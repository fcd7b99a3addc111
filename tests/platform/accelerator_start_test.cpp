// SPDX-License-Identifier: Apache-2.0
// What a start takes over, when the processor that writes it runs ahead of the kernel.
#include <algorithm>
#include <array>

#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

/// Writes registers as a temporally decoupled processor does: its own time passes, the kernel's
/// does not.
class Decoupled {
public:
    explicit Decoupled(Host& host, double ns = 0) : host_(host), ahead_(ns, sc_core::SC_NS) {}
    void write(Register which, std::uint32_t value) {
        tlm::tlm_generic_payload payload;
        payload.set_command(tlm::TLM_WRITE_COMMAND);
        payload.set_address(AcceleratorRegisters::offset_of(which));
        payload.set_data_ptr(reinterpret_cast<unsigned char*>(&value));
        payload.set_data_length(4);
        payload.set_streaming_width(4);
        host_.out->b_transport(payload, ahead_);
        EXPECT_TRUE(payload.is_response_ok());
    }
    void sync() {
        sc_core::wait(ahead_);
        ahead_ = sc_core::SC_ZERO_TIME;
    }

private:
    Host& host_;
    sc_core::sc_time ahead_;
};

class SmallRunAcceleratorStart : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    DegsConfig config;
};

TEST_F(SmallRunAcceleratorStart, LaterWritesOfItsQuantumAreForTheNextFrame) {
    Platform p("accelerator", config, cloud);
    std::vector<unsigned char> expected;
    p.host.script = [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        expected = p.frame(camera);
        std::fill(p.memory->bytes.begin() + kFrame, p.memory->bytes.end(), 0xA5);
        Decoupled cpu(host);
        cpu.write(Register::Control, kControlStart);
        cpu.write(Register::Width, static_cast<std::uint32_t>(camera.width / 2));
        cpu.write(Register::FrameBuffer, 3); // not even aligned
        cpu.sync();
        EXPECT_TRUE(host.await_irq());
        EXPECT_EQ(p.frame(camera), expected);
        EXPECT_EQ(host.read(Register::Width), camera.width / 2U);
        host.write(Register::Control, kControlStart); // the next frame has what was written
        EXPECT_FALSE(host.await_irq());
        EXPECT_EQ(host.error(), AcceleratorError::Misaligned);
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

// The values are those of the call; the frame begins at the date of the start, 700 ns later.
TEST_F(SmallRunAcceleratorStart, TheFrameBeginsAtTheAnnotatedDate) {
    Platform p("accelerator", config, cloud);
    p.host.script = [&](Host& host) {
        program(host, cloud, camera);
        host.write(Register::IrqEnable, kIrqDone | kIrqError);
        sc_core::sc_time first_access;
        const std::uint64_t before = p.memory->accesses;
        p.memory->on_access = [&](std::uint64_t access) {
            first_access = access == before + 1 ? sc_core::sc_time_stamp() : first_access;
        };
        const sc_core::sc_time now = sc_core::sc_time_stamp();
        Decoupled cpu(host, 700);
        cpu.write(Register::Control, kControlStart);
        EXPECT_EQ(host.read(Register::Status), kStatusBusy);
        cpu.write(Register::Height, 0);
        EXPECT_TRUE(host.await_irq());
        EXPECT_EQ(host.read(Register::Height), 0U);
        EXPECT_GE(first_access, now + sc_core::sc_time(700, sc_core::SC_NS));
    };
    sc_core::sc_start();
    EXPECT_TRUE(p.host.finished);
}

/// A platform whose parts are constructed in any order.
struct Parts {
    std::unique_ptr<Accelerator> accelerator;
    std::unique_ptr<PlainMemory> memory;
    std::unique_ptr<Host> host;
    sc_core::sc_signal<bool> irq;
    sc_core::sc_time first_access;
    std::uint64_t cycles = 0;

    Parts(const std::string& name, const std::array<int, 3>& order, const AcceleratorConfig& config)
        : irq((name + "_irq").c_str()) {
        for (const int part : order) {
            if (part == 0) {
                accelerator = std::make_unique<Accelerator>((name + "_gpu").c_str(), config);
            } else if (part == 1) {
                memory = std::make_unique<PlainMemory>((name + "_memory").c_str(), kMemoryBytes,
                                                       Timing::Annotated);
            } else {
                host = std::make_unique<Host>((name + "_cpu").c_str());
            }
        }
        accelerator->irq.bind(irq);
        host->irq.bind(irq);
        host->out.bind(accelerator->registers);
        accelerator->mem.bind(memory->in);
        memory->on_access = [this](std::uint64_t access) {
            first_access = access == 1 ? sc_core::sc_time_stamp() : first_access;
        };
    }
};

// All of it in the first activation of the processor, which may be before or after that of the
// accelerator, at kernel time zero.
TEST_F(SmallRunAcceleratorStart, NoDateDependsOnTheOrderOfConstruction) {
    std::vector<std::unique_ptr<Parts>> all;
    std::array<int, 3> order{0, 1, 2};
    do {
        Parts& parts = *all.emplace_back(
            std::make_unique<Parts>("p" + std::to_string(all.size()), order, config));
        parts.memory->put_scene(cloud);
        parts.host->script = [&](Host& host) {
            host.ahead = sc_core::sc_time(500, sc_core::SC_NS);
            host.decoupled = true;
            program(host, cloud, camera);
            host.write(Register::IrqEnable, kIrqDone | kIrqError);
            host.write(Register::Control, kControlStart);
            host.decoupled = false;
            EXPECT_TRUE(host.await_irq());
            parts.cycles = host.read_pair(Register::Cycles);
        };
    } while (std::next_permutation(order.begin(), order.end()));
    sc_core::sc_start();
    for (const auto& parts : all) {
        EXPECT_TRUE(parts->host->finished);
        EXPECT_GE(parts->first_access, sc_core::sc_time(500, sc_core::SC_NS));
        EXPECT_EQ(parts->first_access, all.front()->first_access);
        EXPECT_EQ(parts->cycles, all.front()->cycles);
    }
}

} // namespace
} // namespace degs::test
