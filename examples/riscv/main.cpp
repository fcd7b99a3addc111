// SPDX-License-Identifier: Apache-2.0
// A platform whose processor runs firmware from power-on.
//     riscv DESIGN.yaml SCENE FIRMWARE.elf [--lpddr5 | --memory FILE] [CAMERA ...]
// The firmware renders a view of each camera (0 without them) and prints the checksums of their
// pixels. The memory takes 80 ns for an access, or is LPDDR5-6400 of 256 bit, or the one of a file.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include <degs/accelerator.hpp>
#include <degs/lpddr5.hpp>
#include <degs/riscv_cpu.hpp>
#include <degs/scene.hpp>

#include "bus.hpp"
#include "flat_memory.hpp"
#include "loader.hpp"

namespace {

struct Arguments {
    std::vector<std::string> files; ///< design, scene, firmware
    bool lpddr5 = false;
    std::string memory; ///< a file; empty: the default of degs::Lpddr5
    std::vector<std::size_t> cameras;
};

bool parse(int argc, char* argv[], Arguments& to) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "--lpddr5") {
            to.lpddr5 = true;
        } else if (word == "--memory" && i + 1 < argc) {
            to.lpddr5 = true;
            to.memory = argv[++i];
        } else if (word.compare(0, 2, "--") == 0) {
            return false;
        } else if (to.files.size() < 3) {
            to.files.push_back(word);
        } else if (word.find_first_not_of("0123456789") == std::string::npos) {
            to.cameras.push_back(std::strtoul(word.c_str(), nullptr, 10));
        } else {
            return false;
        }
    }
    if (to.cameras.empty()) {
        to.cameras.push_back(0);
    }
    return to.files.size() == 3;
}

int boot(const Arguments& arguments) {
    enum Initiator : std::size_t { kCpu, kAccelerator, kLoader, kInitiators };
    const degs::MemoryScene scene = degs::load_memory_scene(arguments.files[1]);
    for (const std::string& note : scene.notes) {
        std::fprintf(stderr, "warning: %s\n", note.c_str());
    }
    degs::AcceleratorOptions options;
    options.antialiased = scene.antialiased;
    if (arguments.lpddr5) { // which sorts accesses by date
        options.memory.pacing = degs::Pacing::Annotated;
    }
    degs::Accelerator accelerator("accelerator", degs::load_design(arguments.files[0]), options);
    degs::RiscvCpu cpu("cpu", degs::load_riscv_program(arguments.files[2]),
                       sc_core::sc_time(1, sc_core::SC_NS));
    Loader loader("loader", scene, arguments.cameras);
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
    sc_core::sc_start();
    if (!bus.ended()) {
        std::printf("The firmware %s.\n", cpu.fault().empty()
                                              ? "sleeps for ever"
                                              : ("has stopped: " + cpu.fault()).c_str());
        return 1;
    }
    std::printf("%llu instructions, %s\n", static_cast<unsigned long long>(cpu.instructions()),
                sc_core::sc_time_stamp().to_string().c_str());
    return static_cast<int>(bus.status());
}

} // namespace

int sc_main(int argc, char* argv[]) {
    Arguments arguments;
    if (!parse(argc, argv, arguments)) {
        std::printf("usage: riscv DESIGN.yaml SCENE FIRMWARE.elf [--lpddr5 | --memory FILE] "
                    "[CAMERA ...]\n");
        return 2;
    }
    try {
        return boot(arguments);
    } catch (const std::exception& mistake) {
        std::printf("%s\n", mistake.what());
        return 1;
    }
}
