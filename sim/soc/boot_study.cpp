// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/boot_study.hpp"

#include <sstream>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/soc/boot_platform.hpp"
#include "sim/soc/built_in_firmware.hpp"
#include "sim/soc/soc_study.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// What the firmware printed, in whole lines that no terminal takes for commands.
std::string console_lines(const std::string& console) {
    std::istringstream from(console);
    std::string lines;
    for (std::string line; std::getline(from, line);) {
        lines += visible(line) + "\n";
    }
    return lines;
}

} // namespace

RiscvProgram load_firmware(const std::string& file) {
    if (!file.empty()) {
        return load_riscv_program(file);
    }
    const std::vector<unsigned char> elf = built_in_firmware();
    if (elf.empty()) {
        throw InputError("This program has no firmware built in, because riscv64-unknown-elf-gcc "
                         "was missing: install gcc-riscv64-unknown-elf and build again, or name an "
                         "ELF file with --firmware.");
    }
    return riscv_program(elf, "The built-in firmware");
}

BootResult run_boot(const BootRequest& request, const View& view) {
    const Stopwatch wall;
    BootPlatform platform("soc", request, view);
    {
        const Progress progress("firmware");
        sc_core::sc_start(sc_core::sc_time(request.limit_ms, sc_core::SC_MS),
                          sc_core::SC_EXIT_ON_STARVATION);
    }
    BootResult result;
    result.console = platform.port().console();
    result.ended = platform.port().ended();
    result.limited = !result.ended && sc_core::sc_pending_activity();
    result.fault = platform.cpu().fault();
    result.status = platform.port().status();
    result.instructions = platform.cpu().instructions();
    result.simulated_ms = sc_core::sc_time_stamp().to_seconds() * 1e3;
    result.wall_s = wall.seconds();
    return result;
}

nlohmann::ordered_json boot_json(const BootRequest& request, const View& view,
                                 const BootResult& result) {
    nlohmann::ordered_json json =
        soc_head_json("degs-soc-boot", request.config, request.memory, view);
    json["cpu"] = {{"kind", "riscv"}, {"cycle_ps", kBootCyclePs}, {"firmware", request.firmware}};
    json["console"] = result.console;
    json["status"] = result.status;
    json["instructions"] = result.instructions;
    json["simulated_ms"] = result.simulated_ms;
    json["warnings"] = view.scene.notes;
    json["host"] = {{"wall_s", result.wall_s}};
    return json;
}

std::string boot_words(const BootRequest& request, const View& view, const BootResult& result) {
    const std::string heading =
        soc_heading(request.config, request.memory, view) + " · RV32IM core";
    const std::string end = result.ended ? "ended with status " + std::to_string(result.status)
                            : !result.fault.empty() ? "has stopped"
                            : result.limited        ? "has not ended"
                                                    : "sleeps for ever";
    return visible(heading) + "\n" + console_lines(result.console) + "firmware " +
           visible(request.firmware) + ", " + end + " · " + grouped(result.instructions) +
           " instructions · " + three_digits(result.simulated_ms) + " ms · host " +
           three_digits(result.wall_s) + " s\n";
}

} // namespace degs::sim
