// SPDX-License-Identifier: Apache-2.0
// A platform whose processor runs firmware from power-on.
//     riscv DESIGN.yaml SCENE FIRMWARE.elf [CAMERA CAMERA]
// The firmware renders a view of each camera (0 and 0 without them) and prints the checksums of
// their pixels.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include <degs/accelerator.hpp>
#include <degs/scene.hpp>

#include "bus.hpp"
#include "cpu.hpp"
#include "elf.hpp"
#include "firmware/map.h"

namespace {

/// The program as a ROM from address 0 on.
std::vector<unsigned char> rom(const rv32::Program& program) {
    constexpr std::uint64_t limit = 0x10000;
    std::vector<unsigned char> bytes;
    for (const auto& segment : program.segments) {
        const std::uint64_t end = segment.address + std::uint64_t{segment.bytes.size()};
        if (end > limit || program.entry != 0) {
            throw std::runtime_error("The firmware does not start at 0 and end before 0x10000.");
        }
        bytes.resize(std::max<std::size_t>(bytes.size(), end));
        std::memcpy(&bytes[segment.address], segment.bytes.data(), segment.bytes.size());
    }
    return bytes;
}

view to_view(const degs::MemoryScene& scene, const char* camera) {
    const long position = std::atol(camera);
    if (position < 0 || std::size_t(position) >= scene.views.size()) {
        throw std::runtime_error("The scene has no camera " + std::string(camera) + ".");
    }
    const degs::MemoryScene::View& from = scene.views[std::size_t(position)];
    view to{};
    to.focal_x = from.focal_x;
    to.focal_y = from.focal_y;
    std::memcpy(to.axes, from.axes, sizeof to.axes);
    std::memcpy(to.position, from.position, sizeof to.position);
    to.width = static_cast<std::uint32_t>(from.width);
    to.height = static_cast<std::uint32_t>(from.height);
    return to;
}

/// Puts the scene into memory, and tells the firmware where it is.
void fill(Bus& bus, const degs::MemoryScene& scene, const char* const cameras[FRAMES]) {
    boot_table table{};
    std::uint64_t pixels = 0;
    for (int i = 0; i < FRAMES; ++i) {
        table.views[i] = to_view(scene, cameras[i]);
        pixels = std::max(pixels, std::uint64_t{table.views[i].width} * table.views[i].height);
    }
    const std::uint32_t here = bus.add(std::vector<unsigned char>(sizeof table));
    table.geometry = bus.add(scene.geometry);
    table.sh = bus.add(scene.sh);
    table.count = scene.gaussians;
    table.sh_degree = scene.sh_degree;
    table.frame_buffer = bus.add(std::vector<unsigned char>(pixels * 4));
    table.workspace_bytes = std::uint32_t{64} << 20U;
    table.workspace = bus.add(std::vector<unsigned char>(table.workspace_bytes));
    bus.put(here, &table, sizeof table);
}

int boot(const char* design_file, const char* scene_file, const char* firmware,
         const char* const cameras[FRAMES]) {
    const degs::MemoryScene scene = degs::load_memory_scene(scene_file);
    degs::AcceleratorOptions options;
    options.antialiased = scene.antialiased;
    degs::Accelerator accelerator("accelerator", degs::load_design(design_file), options);
    Cpu cpu("cpu", rom(rv32::load_elf(firmware)), sc_core::sc_time(1, sc_core::SC_NS));
    Bus bus("bus");
    sc_core::sc_signal<bool> irq("irq");
    cpu.out.bind(bus.in);
    accelerator.mem.bind(bus.in);
    bus.registers.bind(accelerator.registers);
    accelerator.irq.bind(irq);
    cpu.irq.bind(irq);
    fill(bus, scene, cameras);
    sc_core::sc_start();
    if (!bus.ended()) {
        std::printf("The firmware sleeps for ever.\n");
        return 1;
    }
    std::printf("%llu instructions, %s\n", static_cast<unsigned long long>(cpu.instructions()),
                sc_core::sc_time_stamp().to_string().c_str());
    return static_cast<int>(bus.status());
}

} // namespace

int sc_main(int argc, char* argv[]) {
    if (argc != 4 && argc != 6) {
        std::printf("usage: riscv DESIGN.yaml SCENE FIRMWARE.elf [CAMERA CAMERA]\n");
        return 2;
    }
    const char* const cameras[FRAMES] = {argc == 6 ? argv[4] : "0", argc == 6 ? argv[5] : "0"};
    try {
        return boot(argv[1], argv[2], argv[3], cameras);
    } catch (const std::exception& mistake) {
        std::printf("%s\n", mistake.what());
        return 1;
    }
}
