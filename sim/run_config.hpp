// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "config/config_source.hpp"
#include "modules/render_engine.hpp"

namespace degs::sim {

/// A configuration file: the kind of accelerator, then the keys of that kind.
class RunConfig {
public:
    /// The first of accelerator_kinds() with its defaults.
    RunConfig();
    RunConfig(const RunConfig& other)
        : warnings(other.warnings), kind_(other.kind_), model_(other.model_->clone()) {}
    RunConfig& operator=(const RunConfig& other) {
        warnings = other.warnings;
        kind_ = other.kind_;
        model_ = other.model_->clone();
        return *this;
    }
    ~RunConfig() = default;

    /// One sentence for each key that was set and has no effect.
    std::vector<std::string> warnings;

    const AcceleratorConfig& accelerator() const { return *model_; }
    /// See AcceleratorConfig::scale_to.
    void scale_to(int pes) { model_->scale_to(pes); }
    /// The name of this kind of accelerator in a file, e.g. "degs".
    std::string kind() const;

    void describe(ConfigVisitor& visitor);
    /// See AcceleratorConfig::problem.
    std::string problem() const { return model_->problem(); }

private:
    int kind_ = 0; // into accelerator_kinds()
    std::unique_ptr<AcceleratorConfig> model_;
};

/// Reads and checks a file with `--set` overrides, on the LPDDR5 memory of another file if one is
/// named. Throws InputError.
RunConfig load_run_config(const std::string& file, const std::vector<std::string>& overrides,
                          const std::string& memory_file = "");
/// The same for a file that has been read.
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
