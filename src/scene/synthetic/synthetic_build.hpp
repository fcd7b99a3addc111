// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/synthetic/synthetic.hpp"
#include "scene/synthetic/synthetic_random.hpp"

namespace degs {

/// The look of the Gaussians of one part of a scene, independent of their place. Sizes are largest
/// standard deviations in scene units at `SyntheticSpec::gaussians` = 100 000.
struct SyntheticLook {
    MeasuredDistribution size;
    MeasuredDistribution elongation; ///< largest over middle axis
    MeasuredDistribution flatness;   ///< middle over smallest axis
    MeasuredDistribution opacity;
    float view_dependence = 0; ///< largest SH coefficient of degree 1; halves per degree
};

/// Grows a cloud one Gaussian at a time.
class SyntheticBuilder {
public:
    SyntheticBuilder(GaussianCloud& cloud, const SyntheticSpec& spec, int sh_degree);

    SyntheticRandom& random() { return random_; }
    /// Sizes times this keep the covered area for any number of Gaussians.
    double size_factor() const { return size_factor_; }

    /// A Gaussian whose smallest axis is `normal` (unit length), turned about it at random. Its
    /// sizes are those of the look times `scale`.
    void add(const SyntheticLook& look, const glm::dvec3& mean, const glm::dvec3& normal,
             const glm::dvec3& rgb, double scale = 1);
    void add_exact(const glm::dvec3& mean, const glm::dvec3& scale, const glm::dvec4& rotation,
                   double opacity, const glm::dvec3& rgb, float view_dependence = 0);
    /// Unit quaternion (w, x, y, z) that takes z to `normal` after a random turn about z.
    glm::dvec4 facing(const glm::dvec3& normal);

private:
    GaussianCloud& cloud_;
    SyntheticRandom random_;
    double size_factor_;
};

/// The three views of every profile: overview 640x480, near 1280x720, closeup 1920x1080, as the
/// shared trained scenes have them. `focal` is in widths of the image.
struct SyntheticView {
    glm::dvec3 position;
    glm::dvec3 target;
    double focal = 0.8;
};
std::vector<Camera> synthetic_cameras(const std::array<SyntheticView, 3>& views);

// One function per profile; each fills an empty scene.
void make_object(const SyntheticSpec& spec, SyntheticScene& scene);
void make_outdoor(const SyntheticSpec& spec, SyntheticScene& scene);
void make_landscape(const SyntheticSpec& spec, SyntheticScene& scene);
void make_lighthouse(const SyntheticSpec& spec, SyntheticScene& scene);
void make_interior(const SyntheticSpec& spec, SyntheticScene& scene);
void make_garden(const SyntheticSpec& spec, SyntheticScene& scene);
void make_dense(const SyntheticSpec& spec, SyntheticScene& scene);
void make_uniform(const SyntheticSpec& spec, SyntheticScene& scene);
void make_single(const SyntheticSpec& spec, SyntheticScene& scene);
void make_needles(const SyntheticSpec& spec, SyntheticScene& scene);
void make_dynamic(const SyntheticSpec& spec, SyntheticScene& scene); ///< at its time

} // namespace degs
