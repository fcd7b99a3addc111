// SPDX-License-Identifier: Apache-2.0
// A host for the platforms of this folder, which lets an accelerator render one
// view, and prints the checksum of its pixels as degs run does (image.crc32 of its report).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>
#include <zlib.h>

#include <degs/accelerator.hpp>
#include <degs/degs_driver.h>
#include <degs/error.hpp>
#include <degs/scene.hpp>

constexpr std::uint64_t kRegisters = 0x10000000, kRegisterBytes = 4096;
constexpr std::uint64_t kMemory = 0x80000000, kMemoryBytes = 0x10000000;
constexpr std::uint64_t kWorkspaceBytes = 0x4000000;

/// Loads the scene of the command line `PROGRAM DESIGN SCENE [WIDTH]`, whose first view is scaled
/// to WIDTH pixels (64), as degs run --width does.
struct Order {
    degs::Design design;
    degs::MemoryScene scene;
    degs::MemoryScene::View view;

    Order(int argc, char* argv[]) {
        if (argc < 3) {
            throw degs::InputError("The command line is PROGRAM DESIGN.yaml SCENE [WIDTH].");
        }
        design = degs::load_design(argv[1]);
        scene = degs::load_memory_scene(argv[2]);
        for (const std::string& note : scene.notes) {
            std::fprintf(stderr, "warning: %s\n", note.c_str());
        }
        view = scene.views.front();
        if (view.lens != degs::LensKind::Pinhole) { // which a table of views would take
            std::fprintf(stderr, "warning: The camera has a lens; this program draws a pinhole.\n");
        }
        const int width = argc > 3 ? std::atoi(argv[3]) : 64;
        const double factor = double(width) / view.width;
        view.height = int(std::lround(view.height * factor));
        view.width = width;
        view.focal_x *= factor;
        view.focal_y *= factor;
    }
};

/// Copies the scene into memory by debug transport, works the registers with the driver, waits for
/// the interrupt, reads the frame and stops the simulation. `memory` sends addresses from kMemory
/// on; `registers` adds `registers_base`, which is 0 without a bus, to the offsets of registers.
struct Host : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Host> memory{"memory"};
    tlm_utils::simple_initiator_socket<Host> registers{"registers"};
    sc_core::sc_in<bool> irq{"irq"};
    bool rendered = false;

    SC_HAS_PROCESS(Host);
    Host(const sc_core::sc_module_name& name, const Order& what, std::uint64_t registers_base)
        : sc_module(name), order(what), base(registers_base) {
        SC_THREAD(run);
    }

private:
    using Payload = tlm::tlm_generic_payload;
    const Order& order;
    std::uint64_t base;
    std::uint64_t free = kMemory;

    static void fill(Payload& payload, tlm::tlm_command command, std::uint64_t address,
                     unsigned char* data, unsigned bytes) {
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(data);
        payload.set_data_length(bytes);
        payload.set_streaming_width(bytes);
    }
    static std::uint32_t access(void* self, tlm::tlm_command command, std::uint32_t offset,
                                std::uint32_t word) {
        Host& host = *static_cast<Host*>(self);
        Payload payload;
        fill(payload, command, host.base + offset, reinterpret_cast<unsigned char*>(&word), 4);
        sc_core::sc_time delay;
        host.registers->b_transport(payload, delay);
        sc_core::wait(delay);
        return word;
    }
    static std::uint32_t read(void* self, std::uint32_t offset) {
        return access(self, tlm::TLM_READ_COMMAND, offset, 0);
    }
    static void write(void* self, std::uint32_t offset, std::uint32_t word) {
        access(self, tlm::TLM_WRITE_COMMAND, offset, word);
    }
    /// In pieces of 64 B, so that a memory may spread them over channels. What the target returns
    /// is not asked: some interconnects return 0 although they pass the bytes on.
    void move(tlm::tlm_command command, std::uint64_t address, std::vector<unsigned char>& bytes) {
        for (std::size_t at = 0; at < bytes.size(); at += 64) {
            Payload payload;
            fill(payload, command, address + at, &bytes[at],
                 unsigned(std::min<std::size_t>(64, bytes.size() - at)));
            memory->transport_dbg(payload);
        }
    }
    std::uint64_t reserve(std::uint64_t bytes) {
        const std::uint64_t at = free;
        free += (bytes + 4095) / 4096 * 4096;
        return at;
    }
    std::uint64_t add(std::vector<unsigned char> bytes) {
        const std::uint64_t at = reserve(bytes.size());
        move(tlm::TLM_WRITE_COMMAND, at, bytes);
        return at;
    }

    void run() {
        const degs::MemoryScene::View& view = order.view;
        const degs_device device{this, &read, &write};
        degs_scene scene{add(order.scene.geometry), add(order.scene.sh), order.scene.gaussians,
                         order.scene.sh_degree};
        degs_camera camera{};
        camera.width = std::uint32_t(view.width);
        camera.height = std::uint32_t(view.height);
        camera.focal_x = view.focal_x;
        camera.focal_y = view.focal_y;
        const degs_window window{view.shift_x, view.shift_y, std::uint32_t(view.origin_x),
                                 std::uint32_t(view.origin_y)};
        std::copy_n(view.axes, 9, camera.axes);
        std::copy_n(view.position, 3, camera.position);
        std::vector<unsigned char> pixels(std::size_t(view.width) * std::size_t(view.height) * 4);
        const std::uint64_t frame = reserve(pixels.size());

        degs_set_scene(&device, &scene);
        degs_set_camera(&device, &camera);
        degs_set_window(&device, &window);
        degs_set_frame_buffer(&device, frame, DEGS_FORMAT_RGBA8);
        degs_set_workspace(&device, reserve(kWorkspaceBytes), kWorkspaceBytes);
        degs_start(&device, DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR);
        wait(irq.posedge_event());
        degs_acknowledge(&device);
        if (const std::uint32_t error = degs_error(&device)) {
            std::printf("The frame ended with error %u.\n", error);
            sc_core::sc_stop();
            return;
        }
        degs_counters counters{};
        degs_read_counters(&device, &counters);
        move(tlm::TLM_READ_COMMAND, frame, pixels);
        uLong checksum = crc32(0, nullptr, 0); // of red, green and blue
        for (std::size_t at = 0; at < pixels.size(); at += 4) {
            checksum = crc32(checksum, &pixels[at], 3);
        }
        std::printf("%s: %dx%d, %llu cycles, image %08lx\n", order.design.name().c_str(),
                    view.width, view.height, static_cast<unsigned long long>(counters.cycles),
                    checksum);
        rendered = true;
        sc_core::sc_stop();
    }
};
