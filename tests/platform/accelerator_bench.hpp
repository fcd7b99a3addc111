// SPDX-License-Identifier: Apache-2.0
// A platform in little for degs::Accelerator: a memory that is not ours, and a host
// that works the registers.
#pragma once

#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>
#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include "degs/accelerator.hpp"
#include "degs/registers.hpp"
#include "platform/accelerator_core.hpp"
#include "tests/platform/protocol/base_protocol_monitor.hpp"
#include "tlm/has_process.hpp"
#include "tlm/urgent.hpp"

namespace degs::test {

constexpr std::uint64_t kSh = 0x10000, kWorkspace = 0x40000, kFrame = 0x80000;
constexpr std::uint64_t kWorkspaceBytes = 0x40000, kMemoryBytes = 0xC0000;

/// `Annotated`: returns at once with a delay of the latency. `Blocking`: waits for it itself.
enum class Timing { Immediate, Annotated, Blocking };

class PlainMemory : public sc_core::sc_module {
public:
    tlm_utils::simple_target_socket<PlainMemory> in;
    std::vector<unsigned char> bytes;
    std::uint64_t refused_from = ~std::uint64_t{0}; ///< accesses that reach this address fail
    sc_core::sc_time latency{50, sc_core::SC_NS};
    std::uint64_t accesses = 0, urgent = 0;
    std::uint64_t refused = 0;
    std::uint64_t most_debug_bytes = 1U << 30U; ///< debug accesses end at multiples of this
    std::function<void(std::uint64_t access)> on_access;
    std::function<void(std::uint64_t address, std::uint64_t bytes)> on_range; ///< timed accesses

    PlainMemory(const sc_core::sc_module_name& name, std::size_t size, Timing timing,
                bool has_debug = true)
        : sc_core::sc_module(name), in("in"), bytes(size, 0xA5), timing_(timing) {
        in.register_b_transport(this, &PlainMemory::transport);
        if (has_debug) {
            in.register_transport_dbg(this, &PlainMemory::debug);
        }
    }

    /// The geometry of a scene at 0, its SH at kSh.
    void put_scene(const GaussianCloud& cloud) {
        std::vector<unsigned char> geometry;
        std::vector<unsigned char> sh;
        encode_scene(cloud, geometry, sh);
        std::copy(geometry.begin(), geometry.end(), bytes.begin());
        std::copy(sh.begin(), sh.end(), bytes.begin() + kSh);
    }

private:
    bool move(tlm::tlm_generic_payload& payload) {
        const std::uint64_t end = payload.get_address() + payload.get_data_length();
        if (payload.get_address() >= bytes.size() || end > bytes.size() || end > refused_from) {
            payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
            return false;
        }
        unsigned char* const here = bytes.data() + payload.get_address();
        if (payload.is_read()) {
            std::memcpy(payload.get_data_ptr(), here, payload.get_data_length());
        } else {
            const unsigned char* const enables = payload.get_byte_enable_ptr();
            for (unsigned int i = 0; i < payload.get_data_length(); ++i) {
                const bool enabled =
                    enables == nullptr || enables[i % payload.get_byte_enable_length()] != 0;
                here[i] = enabled ? payload.get_data_ptr()[i] : here[i];
            }
        }
        payload.set_response_status(tlm::TLM_OK_RESPONSE);
        payload.set_dmi_allowed(true); // which initiators take back before the next request
        return true;
    }
    void transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& delay) {
        ++accesses;
        urgent += payload.get_extension<Urgent>() != nullptr ? 1 : 0;
        if (on_access) {
            on_access(accesses);
        }
        if (on_range) {
            on_range(payload.get_address(), payload.get_data_length());
        }
        if (timing_ == Timing::Blocking) {
            sc_core::wait(delay + latency);
            delay = sc_core::SC_ZERO_TIME;
        } else if (timing_ == Timing::Annotated) {
            delay += latency;
        }
        refused += move(payload) ? 0 : 1;
    }
    unsigned int debug(tlm::tlm_generic_payload& payload) {
        if (const std::uint64_t left = most_debug_bytes - payload.get_address() % most_debug_bytes;
            left < payload.get_data_length()) {
            payload.set_data_length(static_cast<unsigned int>(left));
        }
        return move(payload) ? payload.get_data_length() : 0;
    }
    Timing timing_;
};

/// Runs a script against the registers of one accelerator.
class Host : public sc_core::sc_module {
public:
    tlm_utils::simple_initiator_socket<Host> out;
    sc_core::sc_in<bool> irq;
    std::function<void(Host&)> script;
    bool finished = false;
    sc_core::sc_time ahead; ///< of the kernel's time, for the next access
    bool decoupled = false; ///< accesses take time of the host, not of the kernel

    explicit Host(const sc_core::sc_module_name& name)
        : sc_core::sc_module(name), out("out"), irq("irq") {
        DEGS_HAS_PROCESS(Host);
        SC_THREAD(run);
    }
    tlm::tlm_response_status access(tlm::tlm_command command, std::uint64_t address, void* data,
                                    unsigned int length) {
        tlm::tlm_generic_payload payload;
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(static_cast<unsigned char*>(data));
        payload.set_data_length(length);
        payload.set_streaming_width(length);
        out->b_transport(payload, ahead);
        if (!decoupled) {
            sc_core::wait(ahead);
            ahead = sc_core::SC_ZERO_TIME;
        }
        return payload.get_response_status();
    }
    void write(Register which, std::uint32_t value, std::uint32_t word = 0) {
        const std::uint32_t offset = AcceleratorRegisters::offset_of(which) + 4 * word;
        EXPECT_EQ(access(tlm::TLM_WRITE_COMMAND, offset, &value, 4), tlm::TLM_OK_RESPONSE);
    }
    void write_pair(Register which, std::uint64_t value, std::uint32_t pair = 0) {
        write(which, static_cast<std::uint32_t>(value), 2 * pair);
        write(which, static_cast<std::uint32_t>(value >> 32U), 2 * pair + 1);
    }
    void write_double(Register which, double value, std::uint32_t pair = 0) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &value, sizeof bits);
        write_pair(which, bits, pair);
    }
    std::uint32_t read(Register which, std::uint32_t word = 0) {
        std::uint32_t value = 0;
        const std::uint32_t offset = AcceleratorRegisters::offset_of(which) + 4 * word;
        EXPECT_EQ(access(tlm::TLM_READ_COMMAND, offset, &value, 4), tlm::TLM_OK_RESPONSE);
        return value;
    }
    std::uint64_t read_pair(Register which) {
        return read(which) | std::uint64_t{read(which, 1)} << 32U;
    }
    AcceleratorError error() { return static_cast<AcceleratorError>(read(Register::ErrorCode)); }

    /// Starts a frame and waits for the interrupt; true if it is done without an error.
    bool render() {
        write(Register::IrqEnable, kIrqDone | kIrqError);
        write(Register::Control, kControlStart);
        return await_irq();
    }
    bool await_irq() {
        while (!irq.read()) {
            sc_core::wait(irq.value_changed_event());
        }
        const std::uint32_t cause = read(Register::IrqStatus);
        write(Register::IrqStatus, cause);
        sc_core::wait(sc_core::SC_ZERO_TIME);
        sc_core::wait(sc_core::SC_ZERO_TIME);
        sc_core::wait(sc_core::SC_ZERO_TIME);
        EXPECT_FALSE(irq.read());
        EXPECT_EQ(read(Register::Status) & kStatusBusy, 0U);
        return cause == kIrqDone;
    }

private:
    void run() {
        script(*this);
        finished = true;
    }
};

/// One accelerator, its host, its memory with a scene at 0.
struct Platform {
    Platform(const char* name, const AcceleratorConfig& config, const GaussianCloud& cloud,
             Timing timing = Timing::Annotated, bool has_debug = true)
        : Platform(name, config, cloud,
                   std::make_unique<PlainMemory>((std::string(name) + "_memory").c_str(),
                                                 kMemoryBytes, timing, has_debug)) {}
    Platform(const char* name, const AcceleratorConfig& config, const GaussianCloud& cloud,
             std::unique_ptr<PlainMemory> with, const Accelerator::Options& options = {})
        : accelerator(name, config, options), memory(std::move(with)),
          monitor((std::string(name) + "_monitor").c_str()),
          host((std::string(name) + "_host").c_str()), irq((std::string(name) + "_irq").c_str()) {
        accelerator.irq.bind(irq);
        host.irq.bind(irq);
        host.out.bind(accelerator.registers);
        accelerator.mem.bind(monitor.in);
        if (memory) {
            mem().bind(memory->in);
            memory->put_scene(cloud);
        }
    }
    Platform(const Platform&) = delete;
    Platform& operator=(const Platform&) = delete;
    ~Platform() {
        EXPECT_EQ(monitor.broken(false), broken)
            << (monitor.violations(false).empty() ? "" : monitor.violations(false).front());
    }
    /// The accelerator's memory socket, behind a monitor of the protocol.
    tlm::tlm_initiator_socket<>& mem() { return monitor.out; }
    std::vector<unsigned char> frame(const Camera& camera, std::uint64_t at = kFrame,
                                     int pixel_bytes = 4) const {
        const auto begin = memory->bytes.begin() + static_cast<std::ptrdiff_t>(at);
        return {begin, begin + camera.width * camera.height * pixel_bytes};
    }
    Accelerator accelerator;
    std::unique_ptr<PlainMemory> memory;
    BaseProtocolMonitor monitor;
    /// Rules that a test breaks on purpose, with a target that is wrong.
    std::set<Rule> broken;
    Host host;
    sc_core::sc_signal<bool> irq;
};

inline void program(Host& host, const GaussianCloud& cloud, const Camera& camera,
                    std::uint64_t frame = kFrame) {
    host.write_pair(Register::Geometry, 0);
    host.write_pair(Register::Sh, kSh);
    host.write(Register::Count, static_cast<std::uint32_t>(cloud.size()));
    host.write(Register::ShDegree, static_cast<std::uint32_t>(cloud.sh_degree));
    host.write_pair(Register::Workspace, kWorkspace);
    host.write_pair(Register::WorkspaceBytes, kWorkspaceBytes);
    host.write_pair(Register::FrameBuffer, frame);
    host.write(Register::Width, static_cast<std::uint32_t>(camera.width));
    host.write(Register::Height, static_cast<std::uint32_t>(camera.height));
    host.write_double(Register::FocalX, camera.fx);
    host.write_double(Register::FocalY, camera.fy);
    for (std::uint32_t i = 0; i < 9; ++i) {
        host.write_double(Register::Axes,
                          camera.camera_to_world[static_cast<int>(i / 3)][static_cast<int>(i % 3)],
                          i);
    }
    for (std::uint32_t i = 0; i < 3; ++i) {
        host.write_double(Register::Position, camera.position[static_cast<int>(i)], i);
    }
}

/// A cloud in front of the camera of test_camera(), of values that floats hold exactly.
inline GaussianCloud test_cloud(unsigned seed = 1, std::size_t count = 150, int degree = 1) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 1);
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    for (std::size_t i = 0; i < count; ++i) {
        // In braces, for arguments in parentheses have no order.
        cloud.means.push_back(
            {4 * unit(random) - 2, 3 * unit(random) - 1.5F, 3 + 4 * unit(random)});
        cloud.scales.push_back({0.02F + 0.3F * unit(random), 0.02F + 0.1F * unit(random), 0.05F});
        cloud.rotations.push_back({unit(random), unit(random), unit(random), 0.1F});
        cloud.opacities.push_back(0.05F + 0.95F * unit(random));
        for (int v = 0; v < 3 * cloud.sh_coefficients(); ++v) {
            cloud.sh.push_back(unit(random) - 0.3F);
        }
    }
    sanitize(cloud);
    return cloud;
}

inline Camera test_camera(int width = 96, int height = 72) {
    Camera camera;
    camera.width = width;
    camera.height = height;
    camera.fx = camera.fy = 0.8 * width;
    camera.position = {0.25, -0.125, 0.5};
    return camera;
}

/// What a frame buffer of RGBA8 must hold of an image, as its PNG file has it: clamped, rounded
/// half up in single precision; A = 1 - T.
inline std::vector<unsigned char> rgba8(const Image& image) {
    std::vector<unsigned char> bytes;
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
            const float value = c < 3 ? image.rgb[3 * i + c] : 1.0F - image.transmittance[i];
            const float clamped = std::min(std::max(value, 0.0F), 1.0F);
            bytes.push_back(static_cast<unsigned char>(clamped * 255.0F + 0.5F));
        }
    }
    return bytes;
}

/// A closed job of the configuration of an accelerator, which owns its memory, as `degs run` has.
struct Closed {
    Closed(const char* name, const AcceleratorConfig& config, const GaussianCloud& cloud,
           const Camera& camera, bool antialiased = false)
        : workload(make_frame_workload(cloud, camera, config.tile_size_px(), config.tile_mode(),
                                       projection_of(config.data_path(), antialiased))),
          job(make_render_job({&workload}, config)), engine(config.build(name, time, job, {})) {}
    const Image& image() const { return job.images.front(); }
    std::vector<unsigned char> pixels() const { return rgba8(image()); }
    Timebase time{ClockDomain(1.0), Fidelity::Exact};
    FrameWorkload workload;
    RenderJob job;
    std::unique_ptr<RenderEngine> engine;
};

} // namespace degs::test
