// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/boot_platform.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "sim/soc/boot_memory.hpp"
#include "tlm/set_access.hpp"

namespace degs::sim {
namespace {

enum BootInitiator : std::size_t { kBootCpu, kBootAccelerator, kBootInitiators };
enum BootWindow : std::size_t { kRegistersWindow, kPortWindow, kMemoryWindow };

std::vector<AddressBus::Window> boot_windows(const dram::Config& memory) {
    const BootMap map = boot_map();
    return {{map.registers, 0x1000, false},
            {map.console, 8, false},
            {map.memory, dram::Channels(memory).mapping().capacity(), true}};
}

Accelerator::Options boot_options(const Scene& scene) {
    Accelerator::Options options;
    options.antialiased = scene.traits.antialiased;
    options.memory.pacing = Pacing::Annotated; // the memory sorts by date
    return options;
}

} // namespace

FirmwarePort::FirmwarePort(const sc_core::sc_module_name& name)
    : sc_core::sc_module(name), in("in") {
    in.register_b_transport(this, &FirmwarePort::transport);
}

void FirmwarePort::transport(tlm::tlm_generic_payload& payload, sc_core::sc_time& /*delay*/) {
    if (!payload.is_write() || payload.get_data_length() != 4 || payload.get_address() % 4 != 0) {
        payload.set_response_status(tlm::TLM_ADDRESS_ERROR_RESPONSE);
        return;
    }
    std::uint32_t word = 0;
    std::memcpy(&word, payload.get_data_ptr(), sizeof word);
    payload.set_response_status(tlm::TLM_OK_RESPONSE);
    if (payload.get_address() == 0) {
        console_ += static_cast<char>(word & 0xFFU);
        return;
    }
    ended_ = true;
    status_ = word;
    sc_core::sc_stop();
}

BootPlatform::BootPlatform(const sc_core::sc_module_name& name, const BootRequest& request,
                           const View& view)
    : sc_core::sc_module(name), time_{ClockDomain(request.config.accelerator().clock_ghz),
                                      Fidelity::Exact},
      memory_("memory", request.memory, time_, kBootInitiators),
      bus_("bus", kBootInitiators, boot_windows(request.memory)), port_("port"),
      accelerator_("accelerator", request.config.accelerator(), boot_options(view.scene)),
      cpu_("cpu", request.program, sc_core::sc_time(kBootCyclePs, sc_core::SC_PS)), irq_("irq") {
    bus_.out[bus_.socket_of(kRegistersWindow)].bind(accelerator_.registers);
    bus_.out[bus_.socket_of(kPortWindow)].bind(port_.in);
    for (std::size_t i = 0; i < kBootInitiators; ++i) {
        bus_.out[bus_.socket_of(kMemoryWindow, i)].bind(memory_.in[i]);
    }
    cpu_.out.bind(bus_.in[kBootCpu]);
    accelerator_.mem.bind(bus_.in[kBootAccelerator]);
    accelerator_.irq.bind(irq_);
    cpu_.irq.bind(irq_);
    put_into_memory(
        boot_memory(view.scene.cloud, view.camera, memory_.channels().mapping().capacity()));
}

void BootPlatform::put_into_memory(std::vector<unsigned char> bytes) {
    constexpr std::size_t kMostBytes = 1U << 24U;
    for (std::size_t at = 0; at < bytes.size(); at += kMostBytes) {
        tlm::tlm_generic_payload payload;
        set_access(payload, tlm::TLM_WRITE_COMMAND, at, bytes.data() + at,
                   std::min(kMostBytes, bytes.size() - at));
        if (memory_.in[0].get_base_export()->transport_dbg(payload) != payload.get_data_length()) {
            throw std::logic_error("the memory took fewer bytes than it has");
        }
    }
}

} // namespace degs::sim
