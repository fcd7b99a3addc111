// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "degs/keys.hpp"

namespace degs {

struct AcceleratorConfig;
class ConfigVisitor;

/// What a configuration file describes: the kind of accelerator, then the keys of that kind. Keys
/// are set and read by the names that files and `--set` use; docs/keys.md lists them.
class Design {
public:
    /// The first kind of accelerator, DeGS, with its defaults: the structure of degs-64 in fp32.
    Design();
    Design(const Design& other);
    Design& operator=(const Design& other);
    Design(Design&& other) noexcept;
    Design& operator=(Design&& other) noexcept;
    ~Design();

    /// What reports call the design, and the kind of accelerator in a file, e.g. "degs".
    const std::string& name() const;
    std::string kind() const;
    int pes() const;

    /// Assigns values as `--set key=value` does, all at once, so that rules between keys hold again
    /// when the last one is there. Throws InputError, one sentence that names the key, what is
    /// wrong and what is allowed; the design is then as it was. Returns a sentence for each value
    /// that has no effect.
    std::vector<std::string> set(const std::vector<std::string>& assignments);
    std::vector<std::string> set(const std::string& key, const std::string& value) {
        return set({key + "=" + value});
    }
    /// The value of a key as a file would say it. Throws InputError if there is no such key.
    std::string get(const std::string& key) const;
    /// All keys with their values, ranges and meanings. A visitor may change values; rules between
    /// keys are checked by problem(), and by the accelerator that is built.
    void visit(KeyVisitor& visitor);
    /// The first range or rule that does not hold, as one sentence, or nothing if all do.
    std::string problem() const;
    /// Becomes the design of its family with that many PEs, by the rule of docs/families.md.
    /// Expects a design with default values. Throws InputError, which names the nearest sizes, if
    /// there is none.
    void scale_to(int pes);

    /// One sentence for each key of the file that has no effect.
    std::vector<std::string> warnings;

    // For programs that are built from the sources.
    const AcceleratorConfig& accelerator() const;
    void describe(ConfigVisitor& visitor);

private:
    int kind_ = 0; // into accelerator_kinds()
    std::unique_ptr<AcceleratorConfig> model_;
};

/// Reads a configuration file (docs/configuration.md) of any accelerator, for degs::Accelerator:
///     degs::Accelerator accelerator("accelerator", degs::load_design("degs-64.yaml"));
/// `overrides` are "path.to.key=value". Throws InputError, one sentence that names the file and the
/// line, for a file that cannot be read and for every key or value that is wrong.
Design load_design(const std::string& file, const std::vector<std::string>& overrides = {});

} // namespace degs
