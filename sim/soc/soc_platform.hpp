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
///     host ----------+                +-- accelerator.registers
///     accelerator.mem +-- AddressBus --+
///     display --------+               +-- Lpddr5, a socket for each initiator
///     cores ----------+
///
/// Registers at 0x1000'0000, memory at 0x8000'0000. The lower half of the memory is the
/// accelerator's (scene, workspace, frame buffers), the upper half the cores'.
class SocPlatform : public sc_core::sc_module {
public:
    SocPlatform(const sc_core::sc_module_name& name, const SocRequest& request, const View& view,
                Timeline* timeline = nullptr);

    SocHost& host() { return *host_; }
    /// The display, which shows nothing until show() is called.
    Display& display() { return *display_; }
    void complete_timeline() { accelerator_.core().complete_timeline(); }
    void set_load(double gb_per_s);
    std::uint64_t cpu_bytes() const;

private:
    void add_cores(const SocRequest& request);

    std::uint64_t capacity_;
    Timebase time_;
    dram::Lpddr5 memory_;
    AddressBus bus_;
    Accelerator accelerator_;
    std::unique_ptr<SocHost> host_;
    std::unique_ptr<Display> display_;
    std::vector<std::unique_ptr<CpuTraffic>> cores_;
    sc_core::sc_signal<bool> irq_;
};

} // namespace degs::sim
