// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/soc_platform.hpp"

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

constexpr std::uint64_t kRegisters = 0x10000000, kRegisterWindow = 0x1000, kMemory = 0x80000000;
enum Initiator : std::size_t { kHost, kAccelerator, kDisplay, kFirstCore };

std::uint64_t capacity_of(const dram::Config& config) {
    return dram::Channels(config).mapping().capacity();
}

std::size_t initiators(const SocRequest& request) {
    return kFirstCore + request.cores;
}

Accelerator::Options accelerator_options(const Scene& scene, Timeline* timeline) {
    Accelerator::Options options;
    options.antialiased = scene.traits.antialiased;
    options.timeline = timeline;
    options.memory.pacing = Pacing::Annotated; // the memory sorts by date
    return options;
}

} // namespace

SocPlatform::SocPlatform(const sc_core::sc_module_name& name, const SocRequest& request,
                         const View& view, Timeline* timeline)
    : sc_core::sc_module(name),
      capacity_(capacity_of(request.memory)), time_{ClockDomain(
                                                        request.config.accelerator().clock_ghz),
                                                    Fidelity::Exact},
      memory_("memory", request.memory, time_, initiators(request)),
      bus_("bus", initiators(request),
           {{kRegisters, kRegisterWindow, false}, {kMemory, capacity_, true}}),
      accelerator_("accelerator", request.config.accelerator(),
                   accelerator_options(view.scene, timeline)),
      irq_("irq") {
    bus_.out[bus_.socket_of(0)].bind(accelerator_.registers);
    for (std::size_t i = 0; i < initiators(request); ++i) {
        bus_.out[bus_.socket_of(1, i)].bind(memory_.in[i]);
    }
    host_ = std::make_unique<SocHost>("host", kRegisters, kMemory, capacity_ / 2);
    host_->out.bind(bus_.in[kHost]);
    host_->irq.bind(irq_);
    accelerator_.irq.bind(irq_);
    accelerator_.mem.bind(bus_.in[kAccelerator]);
    Display::Config screen;
    screen.refresh_hz = request.refresh_hz > 0 ? request.refresh_hz : 1;
    display_ = std::make_unique<Display>("display", screen);
    display_->out.bind(bus_.in[kDisplay]);
    add_cores(request);
}

// A region for each core, so that streams do not meet in one row by construction.
void SocPlatform::add_cores(const SocRequest& request) {
    const std::uint64_t count = request.cores;
    const std::uint64_t share = capacity_ / 2 / count / 4096 * 4096;
    for (std::uint64_t i = 0; i < count; ++i) {
        CpuTraffic::Config core;
        core.pattern = request.pattern;
        core.reads_per_write = request.reads_per_write;
        core.begin = kMemory + capacity_ / 2 + i * share;
        core.bytes = share;
        core.seed = static_cast<unsigned>(i + 1);
        cores_.push_back(std::make_unique<CpuTraffic>(("core_" + std::to_string(i)).c_str(), core));
        cores_.back()->out.bind(bus_.in[kFirstCore + i]);
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

} // namespace degs::sim
