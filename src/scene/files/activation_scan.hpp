// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace degs {

/// Tells whether scales and opacities are logarithms and logits, or have been through exp and the
/// logistic function already, each for itself: then no scale is negative, or no opacity lies outside
/// 0 to 1, which logarithms and logits of a whole scene do not keep to.
class ActivationScan {
public:
    void add_scale(double value) { negative_scale_ = negative_scale_ || value < 0; }
    void add_opacity(double value) { wide_opacity_ = wide_opacity_ || value < 0 || value > 1; }

    // Of everything added so far; true if nothing was.
    bool scales_look_activated() const { return !negative_scale_; }
    bool opacities_look_activated() const { return !wide_opacity_; }

private:
    bool negative_scale_ = false, wide_opacity_ = false;
};

/// Gaussians of which the values say something about their whole scene.
constexpr std::size_t kFewestToJudge = 4;
/// Gaussians of which one kind of values alone, scales or opacities, decides how a file of an open
/// format is read. Large units of length or even opacities keep a few logarithms or logits within
/// the range as well, but not a hundred.
constexpr std::size_t kFewestToTake = 100;

/// What a reader says of a file whose format has logarithms and logits, and some of whose values do not
/// look like them. `count` Gaussians; empty if there is nothing to say.
std::string activated_note(const ActivationScan& scan, std::size_t count);
/// The same of scales that have been through exp, of a format that keeps opacities as shares.
std::string activated_note(const std::vector<glm::vec3>& scales);
/// The same of a file whose format leaves it open, and of which they were taken as they look.
std::string taken_as_they_are_note(bool scales, bool opacities);

} // namespace degs
