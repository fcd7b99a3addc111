// SPDX-License-Identifier: Apache-2.0
// degs config: what a configuration file may say.
#include <memory>

#include "config/config_document.hpp"
#include "sim/commands.hpp"
#include "sim/run_config.hpp"
#include "sim/text/standard_output.hpp"

namespace degs::sim {
namespace {

struct ConfigOptions {
    bool has_config = false; // else the defaults
    std::string config;
    std::vector<std::string> overrides;
    std::string format = "text";
};

/// path = value
///     meaning (integer, 1 to 64)
std::string text(const std::vector<KeyDoc>& keys) {
    std::string lines;
    for (const KeyDoc& key : keys) {
        if (key.type == "section") {
            lines += "\n" + key.path + ": " + key.doc + "\n";
        } else {
            lines += key.path + " = " + key.default_value + "\n    " + key.doc + " (" + key.type +
                     ", " + key.allowed + ")\n";
        }
    }
    return lines;
}

void run(const ConfigOptions& options) {
    const RunConfig config =
        options.has_config ? load_run_config(options.config, options.overrides) : RunConfig{};
    if (options.format == "markdown") {
        print(markdown_table(document(config)));
    } else if (options.format == "yaml") {
        print(resolved_yaml(config));
    } else {
        print(text(document(config)));
    }
}

} // namespace

void add_config_command(CLI::App& program) {
    auto options = std::make_shared<ConfigOptions>();
    CLI::App* command = program.add_subcommand(
        "config", "explain every configuration key with its default, or with a file's value");
    CLI::Option* file = command
                            ->add_option("config", options->config,
                                         "configuration file (YAML); without it, the defaults")
                            ->type_name("FILE");
    command->add_option("--set", options->overrides, "path.to.key=value; may be repeated")
        ->type_name("KEY=VALUE")
        ->take_all()
        ->expected(1)
        ->needs(file);
    command
        ->add_option("--format", options->format,
                     "text, markdown, or yaml: a complete file that can be run")
        ->check(CLI::IsMember({"text", "markdown", "yaml"}))
        ->capture_default_str();
    command->callback([options, file] {
        options->has_config = file->count() != 0; // "" is a name, too
        run(*options);
    });
}

} // namespace degs::sim
