// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "degs/riscv_cpu.hpp"
#include "dram/channels.hpp"
#include "sim/simulation/run_config.hpp"
#include "sim/simulation/view.hpp"

namespace degs::sim {

constexpr double kBootCyclePs = 1000; ///< an instruction of the core

struct BootRequest {
    RunConfig config;
    dram::Config memory;
    std::string firmware; ///< the file, or "built in"
    RiscvProgram program;
    double limit_ms = 1000; ///< of simulated time
};

struct BootResult {
    std::string console;  ///< what the firmware printed
    bool ended = false;   ///< by itself
    bool limited = false; ///< by the limit
    std::string fault;    ///< why it has stopped without an end, see RiscvCpu; empty: it waits
    std::uint32_t status = 0;
    std::uint64_t instructions = 0;
    double simulated_ms = 0; ///< from power-on
    double wall_s = 0;
};

/// The firmware in a file, or the one that is built in if `file` is empty. Throws InputError, one
/// sentence, if there is none or it cannot run on the core.
RiscvProgram load_firmware(const std::string& file);

/// Lets a core boot the firmware on a platform with the accelerator and an Lpddr5 memory, which
/// holds the scene and the view. Once per process. Throws InputError if the scene does not fit.
BootResult run_boot(const BootRequest& request, const View& view);

nlohmann::ordered_json boot_json(const BootRequest& request, const View& view,
                                 const BootResult& result);
std::string boot_words(const BootRequest& request, const View& view, const BootResult& result);

} // namespace degs::sim
