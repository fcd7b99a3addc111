// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "splat/model/gaussian.hpp"

namespace degs {

/// Tells whether scales and opacities are logarithms and logits, or have been through exp and the
/// logistic function already, each for itself: then no scale is negative, or no opacity lies
/// outside 0 to 1, which logarithms and logits of a whole scene do not keep to.
class ActivationScan {
public:
    void add_scale(double value) { negative_scale_ = negative_scale_ || value < 0; }
    void add_opacity(double value) { wide_opacity_ = wide_opacity_ || value < 0 || value > 1; }

    // What everything added so far looks like; true if nothing was added.
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

/// Whether Gaussians can have these sizes in a scene of this extent. In large units of length the
/// logarithms of all sizes are positive, so that their sign says nothing. If scales that are sizes
/// already are read as logarithms, however, no Gaussian is smaller than a unit: most are nearly as
/// large as that, or they are large in a small scene. Positions and scales of the same Gaussians.
bool sizes_fit_scene(const std::vector<glm::dvec3>& means, const std::vector<glm::vec3>& scales);

/// What a reader says of a file whose format has logarithms and logits, and some of whose values do
/// not look like them. Empty if there is nothing to say. `cloud`: as they were read.
std::string activated_note(ActivationScan scan, const GaussianCloud& cloud);
/// What a reader says of such a file from the cloud alone. `logits`: the format has logits of
/// opacities; most formats keep them as shares, so that nothing can be wrong with them.
std::string activated_note(const GaussianCloud& cloud, bool logits = false);
/// What a reader says of a file whose format leaves it open, and whose values were taken as they
/// look.
std::string taken_as_they_are_note(bool scales, bool opacities);

} // namespace degs
