// SPDX-License-Identifier: Apache-2.0
// degs registers: the register map of the accelerator on a platform.
#include <memory>

#include "sim/registers/register_formats.hpp"
#include "sim/shell/commands.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {

void add_registers_command(CLI::App& program) {
    auto format = std::make_shared<std::string>("markdown");
    CLI::App* command = program.add_subcommand(
        "registers", "print the registers of the accelerator on a platform, for drivers and tools");
    command
        ->add_option(
            "--format", *format,
            "markdown: a table; views: that of an entry of the table of views; c: a header "
            "for drivers; svd: CMSIS-SVD; ip-xact: IEEE 1685-2022")
        ->check(CLI::IsMember({"markdown", "views", "c", "svd", "ip-xact"}))
        ->capture_default_str();
    command->callback([format] {
        print(*format == "c"         ? registers_c()
              : *format == "views"   ? view_entry_markdown()
              : *format == "svd"     ? registers_svd()
              : *format == "ip-xact" ? registers_ip_xact()
                                     : registers_markdown());
    });
}

} // namespace degs::sim
