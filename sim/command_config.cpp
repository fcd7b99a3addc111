// SPDX-License-Identifier: Apache-2.0
// degs config: what a configuration file may say.
#include <filesystem>
#include <memory>

#include "config/config_document.hpp"
#include "config/config_words.hpp"
#include "config/error.hpp"
#include "sim/commands.hpp"
#include "sim/run_config.hpp"
#include "sim/statistics_list.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/warnings.hpp"

namespace degs::sim {
namespace {

struct ConfigOptions {
    bool has_config = false; // else the defaults
    std::string config;
    std::vector<std::string> overrides;
    std::string format = "text";
    bool stats = false;
    std::string of = "run"; ///< the command whose statistics are listed
    std::string section;    ///< of the statistics
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

/// A file, or the defaults of an accelerator by name.
RunConfig config_of(const ConfigOptions& options) {
    if (!options.has_config) {
        return RunConfig{};
    }
    std::error_code ignored;
    if (is_accelerator(options.config) && !std::filesystem::exists(options.config, ignored)) {
        return default_run_config(options.config, options.overrides);
    }
    return load_run_config(options.config, options.overrides);
}

std::string statistics(const RunConfig& config, const ConfigOptions& options) {
    if (options.format == "yaml") {
        throw InputError(
            "--stats has the formats text and markdown; 'yaml' is for configurations.");
    }
    if (options.of != "run" && options.has_config) {
        throw InputError("The statistics of 'degs " + options.of +
                         "' are the same for every configuration; leave out " +
                         config_words::quote(options.config) + ".");
    }
    const std::vector<Statistic> all = options.of == "compare"  ? statistics_of_compare()
                                       : options.of == "memory" ? statistics_of_memory()
                                                                : statistics_of(config);
    const std::vector<Statistic> list = statistics_in(all, options.section);
    return options.format == "markdown" ? statistics_markdown(list, options.section)
                                        : statistics_text(list);
}

void run(const ConfigOptions& options) {
    const RunConfig config = config_of(options);
    print_warnings(config.warnings);
    if (options.stats) {
        print(statistics(config, options));
    } else if (options.format == "markdown") {
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
        "config", "explain every configuration key with its default, or with a file's value; with "
                  "--stats, every statistic that a run reports");
    CLI::Option* file =
        command
            ->add_option("config", options->config,
                         "configuration file (YAML), or the name of an accelerator for its "
                         "defaults; without it, those of degs")
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
    CLI::Option* stats =
        command->add_flag("--stats", options->stats,
                          "the statistics that a run on this accelerator reports, with units and "
                          "meanings");
    command->add_option("--of", options->of, "the command whose statistics are listed")
        ->check(CLI::IsMember({"run", "compare", "memory"}))
        ->capture_default_str()
        ->needs(stats);
    command
        ->add_option("--section", options->section,
                     "a part of the statistics: stages, stages.span or timing.cycles")
        ->type_name("PATH")
        ->needs(stats);
    command->callback([options, file] {
        options->has_config = file->count() != 0; // "" is a name, too
        run(*options);
    });
}

} // namespace degs::sim
