// SPDX-License-Identifier: Apache-2.0
// Uses headers of its own and the package's in one program. Exits with 0 if an accelerator is built
// with the keys that were set by name.
#include <cstdio>
#include <string>

#include <systemc>
#include <tlm_utils/simple_initiator_socket.h>
#include <tlm_utils/simple_target_socket.h>

#include <base/error.hpp>
#include <baselines/design.hpp>
#include <config/config.hpp>
#include <cost/technology.hpp>
#include <dram/timing.hpp>
#include <driver/driver.h>
#include <modules/config.hpp>
#include <platform/accelerator.hpp>
#include <scene/scene.hpp>
#include <splat/model.hpp>
#include <stats/statistics.hpp>
#include <tlm/memory.hpp>

#include <degs/accelerator.hpp>
#include <degs/bus_width.hpp>
#include <degs/date_sorter.hpp>
#include <degs/degs_driver.h>
#include <degs/design.hpp>
#include <degs/error.hpp>
#include <degs/keys.hpp>
#include <degs/messages.hpp>
#include <degs/options.hpp>
#include <degs/registers.hpp>
#include <degs/scene.hpp>

namespace {

constexpr int kOwnHeaders = own::config_config + own::scene_scene + own::tlm_memory +
                            own::dram_timing + own::platform_accelerator + own::baselines_design +
                            own::base_error + own::cost_technology + own::splat_model +
                            own::stats_statistics + own::modules_config + own::driver_driver;

struct Memory : sc_core::sc_module {
    tlm_utils::simple_target_socket<Memory> in{"in"};
    explicit Memory(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
};

struct Host : sc_core::sc_module {
    tlm_utils::simple_initiator_socket<Host> out{"out"};
    explicit Host(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
};

std::string refusal_of(degs::Design& design, const std::string& key, const std::string& value) {
    try {
        design.set(key, value);
    } catch (const degs::InputError& mistake) {
        return mistake.what();
    }
    return "";
}

} // namespace

int sc_main(int, char**) {
    degs::Design design;
    design.set({"scheduler.banks=4", "packing.bytes=16KiB", "clock_ghz=0.5"});
    const std::string refused = refusal_of(design, "scheduler.banks", "100");
    degs::AcceleratorOptions options;
    options.set("memory.outstanding", "7");
    degs::Accelerator accelerator("accelerator", design, options);
    Memory memory("memory");
    Host host("host");
    accelerator.mem.bind(memory.in);
    host.out.bind(accelerator.registers);
    sc_core::sc_start(sc_core::SC_ZERO_TIME);
    const bool right = kOwnHeaders == 12 && design.get("scheduler.banks") == "4" &&
                       design.get("packing.bytes") == "16384" && design.kind() == "degs" &&
                       design.pes() == 32 && accelerator.clock_ghz() == 0.5 &&
                       options.memory.outstanding == 7 &&
                       refused.find("'scheduler.banks'") != std::string::npos;
    std::printf("%s, %d PEs, banks %s, refused: %s: %s\n", design.name().c_str(), design.pes(),
                design.get("scheduler.banks").c_str(), refused.c_str(), right ? "right" : "WRONG");
    return right ? 0 : 1;
}
