// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_out_option.hpp"

namespace degs::sim {

void add_scene_out(CLI::App& command, std::string& out, const std::string& extensions) {
    const std::string meaning = "file to write (" + extensions + ")";
    command.add_option("out", out, meaning + ", unless --out names it")->type_name("FILE");
    command.add_option("--out", out, meaning)->type_name("FILE");
}

} // namespace degs::sim
