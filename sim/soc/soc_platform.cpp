// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_platform.hpp"

#include <string>

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

constexpr std::uint64_t kRegisters = 0x10000000, kRegisterWindow = 0x1000, kMemory = 0x80000000;
constexpr std::uint64_t kPage = 4096;

std::uint64_t capacity_of(const dram::Config& config) {
    return dram::Channels(config).mapping().capacity();
}

/// Hosts, accelerators, display, cores.
std::size_t initiators(const SocRequest& request) {
    return 2 * request.accelerators.size() + 1 + request.cores;
}

/// The registers of each accelerator, and the memory.
std::vector<AddressBus::Window> windows(std::size_t accelerators, std::uint64_t capacity) {
    std::vector<AddressBus::Window> windows;
    for (std::uint64_t i = 0; i < accelerators; ++i) {
        windows.push_back({kRegisters + i * kRegisterWindow, kRegisterWindow, false});
    }
    windows.push_back({kMemory, capacity, true});
    return windows;
}

std::string numbered(const char* name, std::size_t i) {
    return i == 0 ? name : name + ("_" + std::to_string(i));
}

} // namespace

SocPlatform::SocPlatform(const sc_core::sc_module_name& name, const SocRequest& request,
                         const View& view, Timeline* timeline)
    : sc_core::sc_module(name),
      capacity_(capacity_of(request.memory)), time_{ClockDomain(
                                                        request.config().accelerator().clock_ghz),
                                                    Fidelity::Exact},
      memory_("memory", request.memory, time_, initiators(request)),
      bus_("bus", initiators(request), windows(request.accelerators.size(), capacity_)),
      irqs_("irq", request.accelerators.size()) {
    for (std::size_t i = 0; i < initiators(request); ++i) {
        bus_.out[bus_.socket_of(irqs_.size(), i)].bind(memory_.in[i]);
    }
    for (const SocAccelerator& accelerator : request.accelerators) {
        add_accelerator(accelerator, view.scene.traits.antialiased,
                        accelerators_.empty() ? timeline : nullptr);
    }
    add_display(request);
    add_cores(request);
}

void SocPlatform::add_accelerator(const SocAccelerator& accelerator, bool antialiased,
                                  Timeline* timeline) {
    const std::size_t i = accelerators_.size();
    Accelerator::Options options;
    options.antialiased = antialiased;
    options.timeline = timeline;
    options.memory.pacing = Pacing::Annotated; // the memory sorts by date
    options.memory.qos = accelerator.qos;
    accelerators_.push_back(std::make_unique<Accelerator>(
        numbered("accelerator", i).c_str(), accelerator.config.accelerator(), options));
    accelerators_[i]->mem.bind(bus_.in[accelerator_socket(i)]);
    accelerators_[i]->irq.bind(irqs_[i]);
    bus_.out[bus_.socket_of(i)].bind(accelerators_[i]->registers);
    const std::uint64_t share = capacity_ / 2 / irqs_.size() / kPage * kPage;
    hosts_.push_back(std::make_unique<SocHost>(
        numbered("host", i).c_str(), kRegisters + i * kRegisterWindow, kMemory + i * share, share));
    hosts_[i]->out.bind(bus_.in[host_socket(i)]);
    hosts_[i]->irq.bind(irqs_[i]);
}

void SocPlatform::add_display(const SocRequest& request) {
    Display::Config screen;
    screen.refresh_hz = request.refresh_hz > 0 ? request.refresh_hz : 1;
    screen.qos = request.display_qos;
    display_ = std::make_unique<Display>("display", screen);
    display_->out.bind(bus_.in[display_socket()]);
}

// A region for each core, so that streams do not meet in one row by construction.
void SocPlatform::add_cores(const SocRequest& request) {
    const std::uint64_t count = request.cores;
    const std::uint64_t share = capacity_ / 2 / count / kPage * kPage;
    for (std::uint64_t i = 0; i < count; ++i) {
        CpuTraffic::Config core;
        core.pattern = request.pattern;
        core.reads_per_write = request.reads_per_write;
        core.qos = request.cores_qos;
        core.begin = kMemory + capacity_ / 2 + i * share;
        core.bytes = share;
        core.seed = static_cast<unsigned>(i + 1);
        cores_.push_back(std::make_unique<CpuTraffic>(("core_" + std::to_string(i)).c_str(), core));
        cores_.back()->out.bind(bus_.in[core_socket(i)]);
    }
}

void SocPlatform::set_load(double gb_per_s) {
    for (auto& core : cores_) {
        core->set_rate(mean_of(gb_per_s, cores_.size()));
    }
}

std::uint64_t SocPlatform::cpu_bytes() const {
    std::uint64_t bytes = 0;
    for (const auto& core : cores_) {
        bytes += core->bytes_moved();
    }
    return bytes;
}

std::uint64_t SocPlatform::accelerator_bytes(std::size_t accelerator) const {
    const dram::Lpddr5::Stats& stats = memory_.stats(accelerator_socket(accelerator));
    return stats.bytes_read + stats.bytes_written;
}

} // namespace degs::sim
