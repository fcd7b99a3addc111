// SPDX-License-Identifier: Apache-2.0
#include "sim/scene/scene_out_option.hpp"

#include "degs/error.hpp"

namespace degs::sim {

void add_scene_out(CLI::App& command, std::string& out, const std::string& extensions) {
    const std::string meaning = "file to write (" + extensions + ")";
    CLI::Option* const argument =
        command.add_option("out", out, meaning + ", unless --out names it")->type_name("FILE");
    command.add_option("--out", out, meaning)->type_name("FILE")->excludes(argument);
}

void require_scene_out(const std::string& out) {
    if (out.empty()) {
        throw InputError("The file to write is missing; it is the last argument, or --out FILE.");
    }
}

} // namespace degs::sim
