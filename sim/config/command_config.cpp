// SPDX-License-Identifier: Apache-2.0
// degs config: what a configuration file may say.
#include <filesystem>
#include <memory>
#include <optional>

#include "config/config_document.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "modules/kit/config/number_choice.hpp"
#include "sim/config/config_difference.hpp"
#include "sim/config/cost_output.hpp"
#include "sim/config/schema.hpp"
#include "sim/config/shared_keys.hpp"
#include "sim/config/statistics_list.hpp"
#include "sim/design/run_config.hpp"
#include "sim/shell/commands.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/warnings.hpp"

namespace degs::sim {
namespace {

constexpr const char* kNumberKeys = "numbers"; ///< of --keys

struct ConfigOptions {
    bool has_config = false; // else the defaults
    std::string config;
    std::vector<std::string> overrides;
    std::string format = "text";
    std::optional<int> pes;             ///< of the design of a family that is wanted
    std::vector<std::string> different; ///< two configurations to be compared
    bool cost = false;
    bool stats = false;
    std::string keys = "all"; ///< the part of the keys that is listed
    std::string of = "run";   ///< the command whose statistics are listed
    std::string section;      ///< of the statistics
    std::string schema;       ///< name of the kind of file whose schema is wanted
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
RunConfig config_of(const std::string& name, const std::vector<std::string>& overrides) {
    std::error_code ignored;
    if (is_accelerator(name) && !std::filesystem::exists(name, ignored)) {
        return default_run_config(name, overrides);
    }
    return load_run_config(name, overrides);
}

RunConfig config_of(const ConfigOptions& options) {
    if (options.pes) {
        if (!is_accelerator(options.config)) {
            throw InputError("--pes makes the design of a family, so it takes the name of an "
                             "accelerator (" +
                             config_words::list(accelerator_names()) + "), not " +
                             config_words::quote(options.config) + ".");
        }
        return sized_run_config(options.config, *options.pes, options.overrides);
    }
    return options.has_config ? config_of(options.config, options.overrides) : RunConfig{};
}

std::string difference_of(const ConfigOptions& options) {
    std::vector<std::vector<KeyDoc>> documents;
    for (const std::string& name : options.different) {
        const RunConfig config = config_of(name, {});
        print_warnings(config.warnings);
        documents.push_back(document(config));
    }
    const std::vector<KeyDifference> keys = difference(documents.front(), documents.back());
    return (options.format == "markdown" ? difference_markdown : difference_text)(
        keys, options.different.front(), options.different.back());
}

/// A file that says how it was made; with --pes this is what is wanted if no format is named.
std::string file_text(const RunConfig& config, const ConfigOptions& options) {
    std::string head;
    if (options.pes) {
        head = "# " + config.accelerator().name + ", written by 'degs config " + options.config +
               " --pes " + std::to_string(*options.pes) +
               "'. docs/families.md explains the rule of its sizes.\n";
    }
    return head + resolved_yaml(config);
}

std::string statistics(const RunConfig& config, const ConfigOptions& options) {
    const std::vector<Statistic> all = options.of == "compare"  ? statistics_of_compare()
                                       : options.of == "memory" ? statistics_of_memory()
                                                                : statistics_of(config);
    const std::vector<Statistic> list = statistics_in(all, options.section);
    return options.format == "markdown" ? statistics_markdown(list, options.section)
                                        : statistics_text(list);
}

/// Keys of a part of the configuration, or the parts of its number set.
std::vector<KeyDoc> listed_keys(const RunConfig& config, const std::string& part) {
    return part == kNumberKeys ? document(read_numbers(config.get("pipeline.numbers"), {}).set())
                               : keys_of_part(document(config), part);
}

/// Similar keys and costs have tables with the values of all accelerators beside each other.
std::string keys_markdown(const RunConfig& config, const std::string& part) {
    return part == "similar" ? similar_keys_markdown()
           : part == "cost"  ? cost_keys_markdown()
                             : markdown_table(listed_keys(config, part));
}

std::string costs(const RunConfig& config, const ConfigOptions& options) {
    const AcceleratorConfig& accelerator = config.accelerator();
    const cost::BillOfMaterials bill = accelerator.bill();
    return options.format == "json"       ? cost_json(accelerator.name, bill, accelerator.clock())
           : options.format == "markdown" ? cost_markdown(bill)
                                          : cost_text(bill, accelerator.clock());
}

void run(const ConfigOptions& options) {
    if (!options.schema.empty()) {
        print(schema_text(options.schema));
        return;
    }
    if (!options.different.empty()) {
        print(difference_of(options));
        return;
    }
    const RunConfig config = config_of(options);
    print_warnings(config.warnings);
    if (options.cost) {
        print(costs(config, options));
    } else if (options.stats) {
        print(statistics(config, options));
    } else if (options.format == "markdown") {
        print(keys_markdown(config, options.keys));
    } else if (options.format == "text") {
        print(text(listed_keys(config, options.keys)));
    } else {
        print(file_text(config, options));
    }
}

/// Adds --stats and the options that go with it.
void add_statistics_options(CLI::App* command, ConfigOptions& options) {
    command->add_flag("--stats", options.stats,
                      "the statistics that a run on this accelerator reports, with units and "
                      "meanings");
    command->add_option("--of", options.of, "the command whose statistics are listed")
        ->check(CLI::IsMember({"run", "compare", "memory"}))
        ->capture_default_str();
    command
        ->add_option("--section", options.section,
                     "a part of the statistics: stages, stages.span or timing.cycles")
        ->type_name("PATH");
}

/// Adds the option that lists only a part of the keys.
void add_keys_option(CLI::App* command, ConfigOptions& options) {
    std::vector<std::string> listed = key_parts();
    listed.emplace_back(kNumberKeys);
    command
        ->add_option("--keys", options.keys,
                     "which keys are listed; shared: those that all accelerators have with the "
                     "same default, range and meaning; similar: those that several have with the "
                     "same range and meaning; own: all others of the accelerator; cost: "
                     "its areas and powers; numbers: the parts of the number set that "
                     "pipeline.numbers names, which it may change")
        ->check(CLI::IsMember(listed))
        ->capture_default_str();
}

} // namespace

void add_config_command(CLI::App& program) {
    auto options = std::make_shared<ConfigOptions>();
    CLI::App* command = program.add_subcommand(
        "config", "explain every configuration key with its default, or with a file's value; with "
                  "--cost, what a design takes; with --stats, what a run reports");
    CLI::Option* file =
        command
            ->add_option("config", options->config,
                         "configuration file (YAML), or the name of an accelerator for its "
                         "defaults; without it, those of degs")
            ->type_name("FILE");
    add_overrides_option(*command, options->overrides, "path.to.key=value; may be repeated");
    CLI::Option* pes =
        command
            ->add_option("--pes", options->pes,
                         "writes the complete design with this number of PEs of the family of an "
                         "accelerator, which is named instead of a file")
            ->type_name("INT");
    command
        ->add_option("--diff", options->different,
                     "the keys in which two configurations differ; files, or names of "
                     "accelerators for their defaults")
        ->type_name("FILE FILE")
        ->expected(2);
    CLI::Option* format =
        command
            ->add_option("--format", options->format,
                         "text, markdown, yaml: a complete file that can be run, or json for "
                         "--cost")
            ->check(CLI::IsMember({"text", "markdown", "yaml", "json"}))
            ->capture_default_str();
    command->add_flag("--cost", options->cost,
                      "area and power of every block of the design, without a run");
    add_statistics_options(command, *options);
    add_keys_option(command, *options);
    command
        ->add_option("--schema", options->schema,
                     "the JSON Schema of a kind of file, with which editors complete and check "
                     "keys")
        ->check(CLI::IsMember(schema_names()));
    command->callback([options, file, pes, format] {
        options->has_config = file->count() != 0; // "" is a name, too
        if (pes->count() != 0 && format->count() == 0 && !options->cost) {
            options->format = "yaml";
        }
        run(*options);
    });
}

} // namespace degs::sim
