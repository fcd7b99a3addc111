// SPDX-License-Identifier: Apache-2.0
// What `pipeline.numbers`, `degs accuracy --numbers` and `base` of a number file say.
#pragma once

#include <string>
#include <vector>

#include "config/config.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// An arithmetic, and the parts of its number set that differ.
struct NumberChoice {
    Arithmetic base;
    /// "part=value" of NumberSet::describe, each part once, in its order and as it writes values.
    std::vector<std::string> parts = {};

    NumberChoice(Arithmetic arithmetic = Arithmetic::Fp32) : base(arithmetic) {}

    /// "tuned:alpha=uq1.15:exp.entries=32": names no file, and read_numbers() gives the same again.
    std::string text() const;
    NumberSet set() const;
    /// The key `numbers`, a text that read_numbers() understands. What it then holds is text(), so
    /// that a description of a design says what is in a file, and not where it lies.
    void describe(ConfigVisitor& visitor);
};

/// Reads NAME[:PART=VALUE].... The name is that of an arithmetic, or, with a dot or a slash, the
/// path of a number file; `records=NAME` stands for the formats of a Gaussian in memory. Throws
/// InputError, which begins with the place of the origin or of the mistake in the file.
NumberChoice read_numbers(const std::string& text, const ConfigOrigin& origin);

/// A number file: the set that is its base, a text as above, and the parts that differ.
struct NumberFile {
    std::string base;
    NumberSet set; ///< the base's; a reader changes it
    void describe(ConfigVisitor& visitor);
};

} // namespace degs
