// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <systemc>

#include "degs/accelerator.hpp"
#include "dram/lpddr5.hpp"
#include "platform/accelerator_core.hpp"
#include "sim/soc/address_bus.hpp"
#include "sim/soc/soc_study.hpp"

namespace degs::sim {

/// The example platform:
///
///     hosts ----------+                +-- accelerators' registers
///     accelerators ---+-- AddressBus --+
///     display --------+                +-- Lpddr5, a socket for each initiator
///     cores ----------+
///
/// Registers at 0x1000'0000 and every 4 KB behind, memory at 0x8000'0000. The lower half of the
/// memory is the accelerators' in equal parts (scene, workspace, frame buffers), the upper half the
/// cores'.
class SocPlatform : public sc_core::sc_module {
public:
    SocPlatform(const sc_core::sc_module_name& name, const SocRequest& request, const View& view,
                Timeline* timeline = nullptr);

    std::size_t accelerators() const { return accelerators_.size(); }
    /// The processor that drives an accelerator.
    SocHost& host(std::size_t accelerator) { return *hosts_[accelerator]; }
    /// The display, which shows nothing until show() is called.
    Display& display() { return *display_; }
    /// Completes the timeline of the first accelerator.
    void complete_timeline() { accelerators_.front()->core().complete_timeline(); }
    void set_load(double gb_per_s);
    std::uint64_t cpu_bytes() const;
    /// That an accelerator has read and written, in whole bursts of the memory.
    std::uint64_t accelerator_bytes(std::size_t accelerator) const;

private:
    void add_accelerator(const SocAccelerator& accelerator, bool antialiased, Timeline* timeline);
    void add_display(const SocRequest& request);
    void add_cores(const SocRequest& request);
    // Initiators of the bus, in the order of their sockets.
    std::size_t host_socket(std::size_t i) const { return i; }
    std::size_t accelerator_socket(std::size_t i) const { return irqs_.size() + i; }
    std::size_t display_socket() const { return 2 * irqs_.size(); }
    std::size_t core_socket(std::size_t i) const { return display_socket() + 1 + i; }

    std::uint64_t capacity_;
    Timebase time_;
    dram::Lpddr5 memory_;
    AddressBus bus_;
    sc_core::sc_vector<sc_core::sc_signal<bool>> irqs_; // of the accelerators
    std::vector<std::unique_ptr<Accelerator>> accelerators_;
    std::vector<std::unique_ptr<SocHost>> hosts_;
    std::unique_ptr<Display> display_;
    std::vector<std::unique_ptr<CpuTraffic>> cores_;
};

} // namespace degs::sim
