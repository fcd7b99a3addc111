// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace degs {

/// Tells whether scales and opacities are logarithms and logits, or have been through exp and the
/// logistic function already: then no scale is negative and no opacity lies outside 0 to 1, which
/// logarithms and logits of a whole scene do not keep to.
class ActivationScan {
public:
    void add_scale(double value) { negative_scale_ = negative_scale_ || value < 0; }
    void add_opacity(double value) { wide_opacity_ = wide_opacity_ || value < 0 || value > 1; }

    /// Of everything added so far; true if nothing was.
    bool looks_activated() const { return !negative_scale_ && !wide_opacity_; }

private:
    bool negative_scale_ = false, wide_opacity_ = false;
};

/// Gaussians of which the values say something about their whole scene.
constexpr std::size_t kFewestToJudge = 4;

/// What a reader says of a file whose format has logarithms and logits, and whose values do not look
/// like them.
constexpr const char* kActivatedNote =
    "No scale is negative and no opacity outside 0 to 1, so the file seems to hold both as they "
    "are; "
    "they were read as logarithms and logits, as its format says.";

} // namespace degs
