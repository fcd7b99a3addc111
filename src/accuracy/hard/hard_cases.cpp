// SPDX-License-Identifier: Apache-2.0
#include "accuracy/hard/hard_cases.hpp"

#include "accuracy/hard/hard_builder.hpp"

namespace degs {
namespace {

constexpr const char* kPixels = "same pixels";

HardCase drawn(const char* id, const char* what, const char* expectation,
               std::vector<HardScene> (*make)(int, int),
               std::string (*check)(const HardScene&, const FrameWorkload&) = nullptr) {
    HardCase out;
    out.id = id;
    out.what = what;
    out.expectation = expectation;
    out.make = make;
    out.check = check;
    return out;
}

HardCase needles() {
    HardCase out =
        drawn("H1", "needles up to 10 000 px long, aspect 100 to 10^5, six angles",
              "same pixels; fp32 spans as in double but for counted flips", make_needle_case);
    out.spans = true;
    return out;
}

HardCase refused(const char* id, const char* what, std::string (*refuse)(const std::string&)) {
    HardCase out;
    out.id = id;
    out.what = what;
    out.expectation = "a sentence that names the file";
    out.refuse = refuse;
    return out;
}

HardCase node_transforms() {
    HardCase out =
        drawn("H25", "glTF nodes that turn, scale unevenly, mirror, shear and flatten",
              "M Sigma M^T, colours of the local frame, same pixels; the last three refused",
              make_transform_case);
    out.refuse = refuse_node_transforms;
    return out;
}

std::vector<HardCase> make_cases() {
    return {
        needles(),
        drawn("H2", "Gaussians of one axis or none, without and with dilation",
              "determinant 0: dropped, counted; dilated: same pixels", make_degenerate_case),
        drawn("H3", "z = 0.2001 to 0.3 and sizes up to 100 z", "same pixels, finite",
              make_close_case),
        drawn("H4", "a scene within 0.15 units of the camera",
              "dropped, counted; same pixels with near_plane 0.001", make_tiny_scene_case),
        drawn("H5", "z = 0.2 and the next double above", "dropped; kept", make_near_plane_case),
        drawn("H6", "means far outside of the view, splats that reach into it",
              "the clamp moves no mean; same pixels", make_far_mean_case, check_far_mean),
        drawn("H7", "1000 splats that cover every tile", "listed by every tile; same pixels",
              make_giants_case, check_giants),
        drawn("H8", "NaN and infinity in scale, opacity, mean and colour", "dropped, counted",
              make_not_finite_case),
        drawn("H9", "quaternions of length 0, 10^-20, 3, 10^20 and NaN",
              "0 and NaN dropped, the others as of length 1", make_quaternion_case,
              check_quaternion),
        drawn("H10", "opacity 0, around 1/255, 1, above 1 and negative",
              "as the alpha test says; outside 0 .. 1 dropped", make_opacity_case),
        drawn("H11", "60 splats of opacity above 0.99", "T >= 10^-4; same pixels",
              make_opaque_stack_case),
        drawn("H12", "50 500 splats with a pixel at alpha = 1/255", "flips within T/255",
              make_threshold_case),
        drawn("H13", "T (1 - alpha) just above and below 10^-4", "the crossing splat is refused",
              make_saturating_case),
        drawn("H14", "4400 splats at two depths one ulp apart, 400 of them twice",
              "order of depth, then of index", make_equal_depth_case),
        drawn("H15", "depths from 0.21 to 10^7", "order of depth; same pixels",
              make_depth_range_case),
        drawn("H16", "a wide view, turned in place, in the order of z and in that of distance",
              "the order of the rule; same pixels", make_order_case, check_order_case),
        drawn("H17", "10^6 splats of 0.001 to 0.1 px", kPixels, make_subpixel_case),
        drawn("H18", "splats of 0.05 to 17 px of SPZ files, trained with anti-aliasing or not",
              "the file decides; compensated splats keep their weight; same pixels",
              make_antialiased_case, check_antialiased),
        drawn("H19", "centres on tile corners, ellipses through pixels", kPixels, make_corner_case),
        drawn("H20", "images of 1 x 1, 1 x N, N x 1 and odd sizes", kPixels, make_image_size_case),
        drawn("H21", "no Gaussian, none visible, one, all in one tile",
              "background where nothing is", make_empty_case),
        drawn("H22", "colours below 0 and above 1, up to 30, SH of degree 3", "clamped at 0 alone",
              make_colour_case),
        drawn("H23", "world offsets up to 10^7", "same places; same pixels", make_offset_case,
              check_offset),
        drawn("H24", "sigma of 100 to 4096 px, pixels 255 px and more from the mean", kPixels,
              make_fp16_range_case),
        node_transforms(),
        drawn("H26", "two meshes interleaved in depth", "one order for both", make_two_meshes_case),
        drawn("H27", "positions to the ends of SPZ, opacity bytes 0 and 255, rotations of bytes",
              "half a step, 0 and 1 exactly, length 1; same pixels", make_quantised_case,
              check_quantised),
        refused("H28",
                "truncated PLY, wrong count, missing properties, plain points, colours alone",
                refuse_broken_files),
        refused("H29", "GLB files whose indices, counts, types and chunks are wrong",
                refuse_broken_glb),
        drawn("H30", "a pixel with 10^4 splats in a tile that is full at once", kPixels,
              make_long_tail_case),
        drawn("H31", "1500 splats of one pixel, one after the other", "same pixels and updates",
              make_one_pixel_case),
        drawn("H32", "rows of 1 to 48 px across the borders of tiles", "same pixels and updates",
              make_row_case),
    };
}

} // namespace

const std::vector<HardCase>& hard_cases() {
    static const std::vector<HardCase> cases = make_cases();
    return cases;
}

} // namespace degs
