// SPDX-License-Identifier: Apache-2.0
// A platform whose processor runs firmware from power-on.
//     riscv DESIGN.yaml SCENE FIRMWARE.elf [--lpddr5 | --memory FILE] [--crop X,Y,WxH]
//           [--limit-ms MS] [CAMERA ...]
// The firmware renders a view of each camera (0 without them), or the part of it that --crop names,
// and prints the checksums of their pixels. The memory takes 80 ns for an access, or is LPDDR5-6400
// of 256 bit, or the one of a file. Firmware that has not ended after the limit of simulated time
// (1000 ms) is given up.
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <degs/accelerator.hpp>
#include <degs/lpddr5.hpp>
#include <degs/scene.hpp>

#include "arguments.hpp"
#include "bus.hpp"
#include "cpu.hpp"
#include "flat_memory.hpp"
#include "loader.hpp"

namespace {

using View = degs::MemoryScene::View;

/// A part of a view: the camera stays, and so does the raster of which the image is a part.
View cropped(const View& whole, const Crop& crop) {
    if (crop.x > whole.width - crop.width || crop.y > whole.height - crop.height) {
        throw std::runtime_error("--crop leaves the image of " + std::to_string(whole.width) + "x" +
                                 std::to_string(whole.height) + " pixels.");
    }
    View part = whole;
    part.width = crop.width;
    part.height = crop.height;
    part.origin_x += crop.x;
    part.origin_y += crop.y;
    part.shift_x += 0.5 * (whole.width - crop.width) - crop.x; // from the middle of the part
    part.shift_y += 0.5 * (whole.height - crop.height) - crop.y;
    return part;
}

std::vector<View> chosen_views(const degs::MemoryScene& scene, const Arguments& arguments) {
    std::vector<View> views;
    for (const std::size_t camera : arguments.cameras) {
        if (camera >= scene.views.size()) {
            throw std::runtime_error("The scene has no camera " + std::to_string(camera) + ".");
        }
        const View& whole = scene.views[camera];
        views.push_back(arguments.crop.width > 0 ? cropped(whole, arguments.crop) : whole);
    }
    for (const View& view : views) {
        if (view.lens != degs::LensKind::Pinhole) { // which a table of views would take
            std::fprintf(stderr, "warning: A camera has a lens; the firmware draws a pinhole.\n");
        }
    }
    return views;
}

/// How the firmware has failed, as a sentence; empty: not at all.
std::string failure_of(const Bus& bus, const Cpu& cpu, double limit_ms) {
    if (bus.ended()) {
        return bus.status() == 0
                   ? ""
                   : "The firmware ended with status " + std::to_string(bus.status()) + ".";
    }
    if (!cpu.fault().empty()) {
        return "The firmware has stopped: " + cpu.fault() + ".";
    }
    if (!sc_core::sc_pending_activity()) {
        return "The firmware waits for an interrupt that never comes.";
    }
    char limit[32];
    std::snprintf(limit, sizeof limit, "%g", limit_ms);
    return "The firmware has not ended after " + std::string(limit) +
           " ms of simulated time, the limit; --limit-ms sets another one.";
}

int boot(const Arguments& arguments) {
    enum Initiator : std::size_t { kCpu, kAccelerator, kLoader, kInitiators };
    const degs::MemoryScene scene = degs::load_memory_scene(arguments.scene);
    for (const std::string& note : scene.notes) {
        std::fprintf(stderr, "warning: %s\n", note.c_str());
    }
    degs::AcceleratorOptions options;
    options.antialiased = scene.antialiased;
    if (arguments.lpddr5) { // which sorts accesses by date
        options.memory.pacing = degs::Pacing::Annotated;
    }
    degs::Accelerator accelerator("accelerator", degs::load_design(arguments.design), options);
    Cpu cpu("cpu", load_firmware(arguments.firmware), sc_core::sc_time(1, sc_core::SC_NS));
    Loader loader("loader", scene, chosen_views(scene, arguments));
    Bus bus("bus", kInitiators);
    sc_core::sc_signal<bool> irq("irq");
    cpu.out.bind(bus.in);
    accelerator.mem.bind(bus.in);
    loader.out.bind(bus.in);
    bus.registers.bind(accelerator.registers);
    accelerator.irq.bind(irq);
    cpu.irq.bind(irq);
    std::unique_ptr<FlatMemory> flat;
    std::unique_ptr<degs::Lpddr5> lpddr5;
    if (arguments.lpddr5) {
        lpddr5 = std::make_unique<degs::Lpddr5>("memory", arguments.memory, kInitiators);
    } else {
        flat = std::make_unique<FlatMemory>("memory", loader.bytes());
    }
    for (std::size_t i = 0; i < kInitiators; ++i) {
        if (lpddr5) {
            bus.memory[i].bind(lpddr5->in(i));
        } else {
            bus.memory[i].bind(flat->in);
        }
    }
    sc_core::sc_start(sc_core::sc_time(arguments.limit_ms, sc_core::SC_MS),
                      sc_core::SC_EXIT_ON_STARVATION);
    std::printf("%llu instructions, %s\n", static_cast<unsigned long long>(cpu.instructions()),
                sc_core::sc_time_stamp().to_string().c_str());
    const std::string failure = failure_of(bus, cpu, arguments.limit_ms);
    if (!failure.empty()) {
        throw std::runtime_error(failure);
    }
    return 0;
}

} // namespace

int sc_main(int argc, char* argv[]) {
    try {
        return boot(parse(argc, argv));
    } catch (const std::exception& mistake) {
        std::fprintf(stderr, "%s\n", mistake.what());
        return 1;
    }
}
