// SPDX-License-Identifier: Apache-2.0
// A platform that has nothing of DeGS but its installed package: a memory of its own, one Gaussian,
// one frame. Exits with 0 if the pixels are right.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <vector>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <degs/accelerator.hpp>
#include <degs/registers.hpp>

namespace {

constexpr unsigned kSh = 0x1000, kWorkspace = 0x2000, kFrame = 0x10000, kSide = 64;

struct Memory : sc_core::sc_module {
    tlm_utils::simple_target_socket<Memory> in{"in"};
    std::vector<unsigned char> bytes = std::vector<unsigned char>(0x20000, 0x55);
    explicit Memory(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {
        in.register_b_transport(this, &Memory::transport);
    }
    void transport(tlm::tlm_generic_payload& p, sc_core::sc_time& delay) {
        if (p.get_address() + p.get_data_length() > bytes.size()) {
            p.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
            return;
        }
        unsigned char* const here = bytes.data() + p.get_address();
        std::memcpy(p.is_read() ? p.get_data_ptr() : here, p.is_read() ? here : p.get_data_ptr(),
                    p.get_data_length());
        delay += sc_core::sc_time(80, sc_core::SC_NS);
        p.set_response_status(tlm::TLM_OK_RESPONSE);
    }
};

struct Driver : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Driver> out{"out"};
    sc_core::sc_in<bool> irq{"irq"};
    std::uint32_t status = 0;
    SC_CTOR(Driver) { SC_THREAD(run); }
    void access(tlm::tlm_command command, unsigned offset, std::uint32_t& word) {
        tlm::tlm_generic_payload p;
        p.set_command(command);
        p.set_address(offset);
        p.set_data_ptr(reinterpret_cast<unsigned char*>(&word));
        p.set_data_length(4);
        p.set_streaming_width(4);
        sc_core::sc_time delay;
        out->b_transport(p, delay);
        wait(delay);
    }
    void write(degs::Register which, std::uint32_t word, unsigned index = 0) {
        access(tlm::TLM_WRITE_COMMAND, static_cast<unsigned>(which) + 4 * index, word);
    }
    void write(degs::Register which, double value, unsigned pair = 0) {
        std::uint32_t words[2];
        std::memcpy(words, &value, sizeof value);
        write(which, words[0], 2 * pair);
        write(which, words[1], 2 * pair + 1);
    }
    void run() {
        using R = degs::Register;
        write(R::Geometry, 0U);
        write(R::Sh, kSh);
        write(R::Count, 1U);
        write(R::Workspace, kWorkspace);
        write(R::WorkspaceBytes, kFrame - kWorkspace);
        write(R::FrameBuffer, kFrame);
        write(R::Width, kSide);
        write(R::Height, kSide);
        write(R::FocalX, 64.0);
        write(R::FocalY, 64.0);
        for (unsigned axis = 0; axis < 3; ++axis) {
            write(R::Axes, 1.0, 4 * axis);
        }
        write(R::IrqEnable, degs::kIrqDone | degs::kIrqError);
        write(R::Control, degs::kControlStart);
        wait(irq.posedge_event());
        access(tlm::TLM_READ_COMMAND, static_cast<unsigned>(R::Status), status);
    }
};

} // namespace

int sc_main(int, char**) {
    degs::Accelerator accelerator("accelerator", degs::Design());
    Memory memory("memory");
    Driver driver("driver");
    sc_core::sc_signal<bool> irq;
    accelerator.mem.bind(memory.in);
    accelerator.irq.bind(irq);
    driver.irq.bind(irq);
    driver.out.bind(accelerator.registers);
    // A red ball of opacity 0.8 at distance 4; SH of degree 0: colour = 0.5 + 0.28209479 c.
    const float record[11] = {0, 0, 4, 0.3F, 0.3F, 0.3F, 1, 0, 0, 0, 0.8F};
    const float colour[3] = {0.5F / 0.28209479F, -0.5F / 0.28209479F, -0.5F / 0.28209479F};
    std::memcpy(memory.bytes.data(), record, sizeof record);
    std::memcpy(memory.bytes.data() + kSh, colour, sizeof colour);
    sc_core::sc_start();

    const auto pixel = [&](unsigned x, unsigned y) {
        return memory.bytes.data() + kFrame + 4 * (y * kSide + x);
    };
    const unsigned char* const centre = pixel(kSide / 2, kSide / 2);
    // Half a pixel off the mean, sigma 4.8 px: 255 * 0.8 * exp(-0.25 / 23.3) = 202 of alpha 0.8.
    const bool right = driver.status == degs::kStatusDone && std::abs(centre[0] - 202) <= 1 &&
                       centre[1] <= 1 && std::abs(centre[3] - 202) <= 1 && pixel(0, 0)[0] == 0 &&
                       pixel(0, 0)[3] == 0 && pixel(kSide - 1, kSide - 1)[0] == 0;
    std::printf("status %u, centre %d %d %d %d: %s\n", driver.status, centre[0], centre[1],
                centre[2], centre[3], right ? "right" : "WRONG");
    return right ? 0 : 1;
}
