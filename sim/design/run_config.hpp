// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "config/config_source.hpp"
#include "degs/design.hpp"
#include "modules/kit/accelerator/render_engine.hpp"

namespace degs::sim {

using RunConfig = Design;

/// Puts the LPDDR5 memory of a file in the place of the memory section of a design (--memory); does
/// nothing without a name. Throws InputError.
void put_memory(ConfigNode& tree, const std::string& file);

/// Reads and checks a file with `--set` overrides, on the LPDDR5 memory of another file if one is
/// named. Throws InputError.
RunConfig load_run_config(const std::string& file, const std::vector<std::string>& overrides,
                          const std::string& memory_file = "");
/// Loads and checks the configuration of a file that has been read. Throws InputError.
RunConfig load_run_config(const ConfigSource& source);

/// The kinds of accelerators that a file may name.
std::vector<std::string> accelerator_names();
/// Whether a file may name this kind of accelerator.
bool is_accelerator(const std::string& kind);
/// The design of a kind's family with that many PEs, with overrides. Throws InputError.
RunConfig sized_run_config(const std::string& kind, int pes,
                           const std::vector<std::string>& overrides);
/// The defaults of a kind of accelerator, with overrides. Throws InputError.
RunConfig default_run_config(const std::string& kind, const std::vector<std::string>& overrides);

} // namespace degs::sim
