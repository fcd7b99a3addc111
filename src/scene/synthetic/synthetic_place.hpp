// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "scene/synthetic/synthetic_build.hpp"

namespace degs {

/// How the colour of a surface varies over it.
enum class Pattern { Plain, Boards, Tiles, Books, Leaves, Picture, Pane };

/// The surface of a thing: two colours, which the pattern mixes, and the kind of its splats.
struct Material {
    glm::dvec3 rgb{0.5};
    glm::dvec3 other{0.5};
    Pattern pattern = Pattern::Plain;
    double size = 1;     ///< of splats, over those of the scene
    double opacity = 1;  ///< times the opacities of the scene
    double rough = 0.15; ///< how far normals lean
    double depth = 0.01; ///< of splats from the surface; of a ball a share of its radii
    double upright = 0;  ///< how near the longest axes of splats are to the vertical
};

/// A trained level of detail of a place: its sizes and opacities by the number of Gaussians.
struct PlaceLevel {
    double gaussians;
    double size;    ///< median of the largest standard deviations, scene units
    double opacity; ///< power of a uniform number that gives opacities: larger is fainter
    double spread =
        1; ///< power of sizes over their median; a finer level keeps some of the largest
};

/// The shapes of the splats of a place, common to its levels and things.
struct PlaceShapes {
    MeasuredDistribution sizes;       ///< largest standard deviations over the median of the level
    MeasuredDistribution elongations; ///< largest over middle axis
    double upright = 0;               ///< the least `Material::upright` of its things
};

/// Surfaces and foliage that share the Gaussians of a scene by their area.
class SyntheticPlace {
public:
    SyntheticPlace(const SyntheticSpec& spec, const std::vector<PlaceLevel>& levels,
                   const PlaceShapes& shapes);

    /// A parallelogram; its normal is the cross product of its edges.
    void sheet(const glm::dvec3& corner, const glm::dvec3& u, const glm::dvec3& v,
               const Material& material, double density = 1);
    /// All six faces.
    void box(const glm::dvec3& low, const glm::dvec3& high, const Material& material,
             double density = 1);
    /// A ball with these radii: splats lie in its shell, more of them near its surface.
    void ball(const glm::dvec3& centre, const glm::dvec3& radii, const Material& material,
              double density = 1);

    /// Makes all Gaussians of the scene, of which `sky` are very large, faint and `far` away.
    void fill(GaussianCloud& cloud, const std::vector<Camera>& cameras, double far) const;

private:
    struct Part {
        bool ball;
        glm::dvec3 corner, u, v, normal; ///< of a ball: centre and radii
        Material material;
        double until; ///< sum of the areas times densities up to this part
    };
    void push(Part part, double area, double density);
    void add(SyntheticBuilder& builder, const Part& part) const;
    void add_sky(SyntheticBuilder& builder, double far) const;

    SyntheticSpec spec_;
    PlaceLevel level_;
    PlaceShapes shapes_;
    std::vector<Part> parts_;
};

/// The views of whole captures: overview 1440x1080, near and closeup 1920x1080.
std::vector<Camera> place_cameras(const std::array<SyntheticView, 3>& views);

} // namespace degs
