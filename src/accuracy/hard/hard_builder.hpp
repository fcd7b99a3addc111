// SPDX-License-Identifier: Apache-2.0
// Makes hard cases out of splats that are given by their place on the screen.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "accuracy/hard/hard_cases.hpp"
#include "scene/synthetic/synthetic_random.hpp"

namespace degs {

/// A flat Gaussian that faces the camera.
struct ScreenSplat {
    double x = 0, y = 0;         ///< px, integer = pixel centre
    double major = 1, minor = 1; ///< standard deviations before dilation, px
    double angle = 0;            ///< of the major axis, radians
    double opacity = 0.8;
    glm::dvec3 rgb{0.8, 0.6, 0.3};
    double depth = 10; ///< scene units
};

/// A scene under a camera at the origin that looks along z; 0.8 widths of focal length.
class HardBuilder {
public:
    HardBuilder(int width, int height);

    void add(const ScreenSplat& splat);
    /// Adds a Gaussian in world units, for those that have no place on the screen.
    void add_world(const glm::dvec3& mean, const glm::dvec3& scale, const glm::dvec4& rotation,
                   double opacity, const glm::dvec3& rgb);
    /// A window around a pixel, clipped to the image; nothing if it lies outside.
    void look(double x, double y, int radius = 24);

    int width() const { return scene.camera.width; }
    int height() const { return scene.camera.height; }
    double middle_x() const { return middle_of(width()); }  ///< a pixel centre
    double middle_y() const { return middle_of(height()); } ///< a pixel centre

    HardScene scene;

private:
    static int middle_of(int pixels) { return pixels / 2; }
};

/// For cases with a single scene.
inline std::vector<HardScene> only_scene(HardBuilder& builder) {
    return {std::move(builder.scene)};
}

/// Repeats the last Gaussian, which the caller then changes.
void repeat_last(GaussianCloud& cloud);

// The cases by what makes them hard; each fills in scenes for a viewport.
std::vector<HardScene> make_needle_case(int width, int height);       // H1
std::vector<HardScene> make_degenerate_case(int width, int height);   // H2
std::vector<HardScene> make_close_case(int width, int height);        // H3
std::vector<HardScene> make_tiny_scene_case(int width, int height);   // H4
std::vector<HardScene> make_near_plane_case(int width, int height);   // H5
std::vector<HardScene> make_far_mean_case(int width, int height);     // H6
std::vector<HardScene> make_giants_case(int width, int height);       // H7
std::vector<HardScene> make_not_finite_case(int width, int height);   // H8
std::vector<HardScene> make_quaternion_case(int width, int height);   // H9
std::vector<HardScene> make_opacity_case(int width, int height);      // H10
std::vector<HardScene> make_opaque_stack_case(int width, int height); // H11
std::vector<HardScene> make_threshold_case(int width, int height);    // H12
std::vector<HardScene> make_saturating_case(int width, int height);   // H13
std::vector<HardScene> make_equal_depth_case(int width, int height);  // H14
std::vector<HardScene> make_depth_range_case(int width, int height);  // H15
std::vector<HardScene> make_order_case(int width, int height);        // H16
std::vector<HardScene> make_subpixel_case(int width, int height);     // H17
std::vector<HardScene> make_antialiased_case(int width, int height);  // H18
std::vector<HardScene> make_corner_case(int width, int height);       // H19
std::vector<HardScene> make_image_size_case(int width, int height);   // H20
std::vector<HardScene> make_empty_case(int width, int height);        // H21
std::vector<HardScene> make_colour_case(int width, int height);       // H22
std::vector<HardScene> make_offset_case(int width, int height);       // H23
std::vector<HardScene> make_fp16_range_case(int width, int height);   // H24
std::vector<HardScene> make_transform_case(int width, int height);    // H25
std::vector<HardScene> make_two_meshes_case(int width, int height);   // H26
std::vector<HardScene> make_quantised_case(int width, int height);    // H27
std::vector<HardScene> make_long_tail_case(int width, int height);    // H30
std::vector<HardScene> make_one_pixel_case(int width, int height);    // H31
std::vector<HardScene> make_row_case(int width, int height);          // H32

std::string check_far_mean(const HardScene& scene, const FrameWorkload& workload);    // H6
std::string check_giants(const HardScene& scene, const FrameWorkload& workload);      // H7
std::string check_quaternion(const HardScene& scene, const FrameWorkload& workload);  // H9
std::string check_order_case(const HardScene& scene, const FrameWorkload& workload);  // H16
std::string check_antialiased(const HardScene& scene, const FrameWorkload& workload); // H18
std::string check_offset(const HardScene& scene, const FrameWorkload& workload);      // H23
std::string check_quantised(const HardScene& scene, const FrameWorkload& workload);   // H27
std::string refuse_node_transforms(const std::string& folder);                        // H25
std::string refuse_broken_files(const std::string& folder);                           // H28
std::string refuse_broken_glb(const std::string& folder);                             // H29

} // namespace degs
