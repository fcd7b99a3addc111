// SPDX-License-Identifier: Apache-2.0
// A platform in one file: a processor, a bus, a memory, an interrupt and an accelerator of any
// design.
//     platform DESIGN.yaml SCENE [CAMERA]
// renders a view and prints the checksum of its pixels, which is image.crc32 in the report of
//     degs run DESIGN.yaml --scene SCENE --camera CAMERA
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <systemc>
#include <tlm_utils/multi_passthrough_target_socket.h>
#include <tlm_utils/simple_initiator_socket.h>
#include <zlib.h>

#include <degs/accelerator.hpp>
#include <degs/degs_driver.h>
#include <degs/error.hpp>
#include <degs/scene.hpp>

using Payload = tlm::tlm_generic_payload;
constexpr std::uint64_t kRegisters = 0x10000000, kMemory = 0x80000000, kPage = 4096;

/// Registers from kRegisters on, and a memory from kMemory on, which takes 80 ns for an access.
struct Bus : sc_core::sc_module {
    tlm_utils::multi_passthrough_target_socket<Bus> in{"in"};
    tlm_utils::simple_initiator_socket<Bus> registers{"registers"};
    std::vector<unsigned char> memory;
    SC_CTOR(Bus) {
        in.register_b_transport(this, &Bus::transport);
        in.register_transport_dbg(this, &Bus::move);
    }
    void transport(int, Payload& p, sc_core::sc_time& delay) {
        if (p.get_address() < kMemory) {
            p.set_address(p.get_address() - kRegisters);
            registers->b_transport(p, delay);
            return;
        }
        delay += sc_core::sc_time(80, sc_core::SC_NS);
        p.set_response_status(move(0, p) != 0 ? tlm::TLM_OK_RESPONSE
                                              : tlm::TLM_ADDRESS_ERROR_RESPONSE);
    }
    unsigned move(int, Payload& p) {
        const std::uint64_t at = p.get_address() - kMemory;
        if (at > memory.size() || p.get_data_length() > memory.size() - at) {
            return 0;
        }
        unsigned char* const here = memory.data() + at;
        std::memcpy(p.is_read() ? p.get_data_ptr() : here, p.is_read() ? here : p.get_data_ptr(),
                    p.get_data_length());
        return p.get_data_length();
    }
    /// The address of a copy of `bytes` in new memory.
    std::uint64_t add(const std::vector<unsigned char>& bytes) {
        const std::uint64_t at = kMemory + memory.size();
        memory.insert(memory.end(), bytes.begin(), bytes.end());
        memory.resize((memory.size() + kPage - 1) / kPage * kPage);
        return at;
    }
};

/// Runs the driver for one frame.
struct Processor : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Processor> out{"out"};
    sc_core::sc_in<bool> irq{"irq"};
    degs_scene scene{};
    degs_camera camera{};
    degs_window window{};
    std::uint64_t frame_buffer = 0, workspace = 0, workspace_bytes = 0;
    degs_counters counters{};
    std::uint32_t error = DEGS_ERROR_CODE_NONE;
    SC_CTOR(Processor) { SC_THREAD(run); }

    static std::uint32_t access(void* self, tlm::tlm_command command, std::uint32_t offset,
                                std::uint32_t word) {
        Payload p; // the words of a little-endian host
        p.set_command(command);
        p.set_address(kRegisters + offset);
        p.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
        p.set_data_length(4);
        p.set_streaming_width(4);
        sc_core::sc_time delay;
        static_cast<Processor*>(self)->out->b_transport(p, delay);
        sc_core::wait(delay);
        return word;
    }
    static std::uint32_t read(void* self, std::uint32_t offset) {
        return access(self, tlm::TLM_READ_COMMAND, offset, 0);
    }
    static void write(void* self, std::uint32_t offset, std::uint32_t word) {
        access(self, tlm::TLM_WRITE_COMMAND, offset, word);
    }
    void run() {
        const degs_device device{this, &read, &write};
        degs_set_scene(&device, &scene);
        degs_set_camera(&device, &camera);
        degs_set_window(&device, &window);
        degs_set_frame_buffer(&device, frame_buffer, DEGS_FORMAT_RGBA8);
        degs_set_workspace(&device, workspace, workspace_bytes);
        degs_start(&device, DEGS_IRQ_ENABLE_DONE | DEGS_IRQ_ENABLE_ERROR);
        wait(irq.posedge_event());
        degs_acknowledge(&device);
        error = degs_error(&device);
        degs_read_counters(&device, &counters);
    }
};

int render(const char* design_file, const char* scene_file, int position) {
    const degs::Design design = degs::load_design(design_file);
    const degs::MemoryScene scene = degs::load_memory_scene(scene_file);
    for (const std::vector<std::string>* sentences : {&design.warnings, &scene.notes}) {
        for (const std::string& sentence : *sentences) {
            std::fprintf(stderr, "warning: %s\n", sentence.c_str());
        }
    }
    if (position < 0 || std::size_t(position) >= scene.views.size()) {
        std::printf("%s has cameras 0 to %zu.\n", scene_file, scene.views.size() - 1);
        return 1;
    }
    const degs::MemoryScene::View& view = scene.views[std::size_t(position)];
    if (view.lens != degs::LensKind::Pinhole) { // which a table of views would take
        std::fprintf(stderr, "warning: The camera has a lens; this program draws a pinhole.\n");
    }
    const std::size_t pixels = std::size_t(view.width) * std::size_t(view.height);
    degs::AcceleratorOptions options;
    options.antialiased = scene.antialiased;
    degs::Accelerator accelerator("accelerator", design, options);
    Processor cpu("cpu");
    Bus bus("bus");
    sc_core::sc_signal<bool> irq("irq");
    cpu.out.bind(bus.in);
    accelerator.mem.bind(bus.in);
    bus.registers.bind(accelerator.registers);
    accelerator.irq.bind(irq);
    cpu.irq.bind(irq);

    cpu.scene = {bus.add(scene.geometry), bus.add(scene.sh), scene.gaussians, scene.sh_degree};
    cpu.frame_buffer = bus.add(std::vector<unsigned char>(pixels * 4));
    cpu.workspace_bytes = std::uint64_t{64} << 20U;
    cpu.workspace = bus.add(std::vector<unsigned char>(cpu.workspace_bytes));
    cpu.camera.width = static_cast<std::uint32_t>(view.width);
    cpu.camera.height = static_cast<std::uint32_t>(view.height);
    cpu.camera.focal_x = view.focal_x;
    cpu.camera.focal_y = view.focal_y;
    cpu.window = {view.shift_x, view.shift_y, static_cast<std::uint32_t>(view.origin_x),
                  static_cast<std::uint32_t>(view.origin_y)};
    for (int i = 0; i < 9; ++i) {
        cpu.camera.axes[i] = view.axes[i];
        cpu.camera.position[i % 3] = view.position[i % 3];
    }
    sc_core::sc_start();
    if (cpu.error != DEGS_ERROR_CODE_NONE) {
        std::printf("The frame ended with error %u.\n", cpu.error);
        return 1;
    }
    uLong checksum = crc32(0, nullptr, 0); // of red, green and blue
    for (std::size_t i = 0; i < pixels; ++i) {
        checksum = crc32(checksum, &bus.memory[cpu.frame_buffer - kMemory + 4 * i], 3);
    }
    std::printf("%s: %dx%d, %llu cycles, image %08lx\n", design.name().c_str(), view.width,
                view.height, static_cast<unsigned long long>(cpu.counters.cycles), checksum);
    return 0;
}

int sc_main(int argc, char* argv[]) {
    if (argc < 3) {
        std::printf("usage: platform DESIGN.yaml SCENE [CAMERA]\n");
        return 2;
    }
    try {
        return render(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 0);
    } catch (const degs::InputError& mistake) {
        std::printf("%s\n", mistake.what());
        return 1;
    }
}
