// SPDX-License-Identifier: Apache-2.0
// The error of a data path's numbers against double precision: rows of results, as table and as
// JSON.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sim/shell/output_folder.hpp"
#include "sim/view/view.hpp"
#include "splat/frame/rendering_rules.hpp"
#include "splat/numbers/number_set.hpp"
#include "splat/pixels/exponent_gemm.hpp"

namespace degs::sim {

/// The pixel with the largest error, and its cause as blame_pixel finds it.
struct WorstPixel {
    int x = 0, y = 0;
    double error = 0;           ///< of the pixel's replay
    std::uint32_t gaussian = 0; ///< index in the scene
    std::string operation;      ///< empty if the replay has no error
    double explained = 0;       ///< error that the operation makes
    std::string flip;           ///< "stop rule", "span ends" or empty
    // Where exponents are products of matrices, pixels are not replayed, and the last three stay
    // empty.
};

/// One number set on one scene, or on one kind of single Gaussians. Values that a kind of
/// measurement does not have are empty, and null in the file.
struct AccuracyRow {
    std::string scene;           ///< or "isotropic-3", "random"
    std::optional<int> camera;   ///< position in the scene's list
    std::string eye;             ///< "left" or "right"; empty: the camera is one view
    std::string resolution;      ///< "1920x1080", of single Gaussians "32x32"
    std::string numbers;         ///< number set, or "fp16-direct"
    double alpha_error_mean = 0; ///< absolute, against fp64, over all pixels
    double alpha_error_max = 0;  ///< over pixels that both draw
    std::optional<double> psnr_db, ssim, flip, max_abs_error; ///< of images
    std::uint64_t nonfinite = 0; ///< values that are infinite or not a number

    // Only images have these numbers.
    bool identical = false;      ///< to the reference; psnr_db is empty then
    std::string span_ends;       ///< that the image was made with
    std::uint64_t recounted = 0; ///< pixels with another number of updates than the reference's
    std::optional<WorstPixel> worst;
    std::string error_image; ///< file name, empty if none was asked for

    // Only single Gaussians have these numbers.
    std::optional<double> spread;       ///< standard deviation of the Gaussians' means
    std::optional<double> mean_to_fp16; ///< alpha_error_mean against fp16-direct
    std::uint64_t gaussians = 0;
    std::uint64_t support = 0; ///< pixels with alpha >= 1/255
    std::uint64_t flips = 0;   ///< pixels that only one of the two draws
};

/// Which camera of the scene, and which eye, view `number` of the group is.
void name_view(const ViewRequest& view, const GroupRequest& group, std::size_t number,
               AccuracyRow& row);

/// A table for terminals.
std::string accuracy_table(const std::vector<AccuracyRow>& rows);
/// accuracy.json: a list of objects, one per row, in this order.
nlohmann::ordered_json accuracy_json(const std::vector<AccuracyRow>& rows);

/// The paper's test of single Gaussians (Sec. V-B).
struct SingleGaussianRequest {
    std::vector<NumberSet> sets;
    std::uint64_t seed = 1;
    int gaussians = 2000;           ///< per kind
    RenderingRules rules;           ///< of the views
    std::vector<ViewRequest> views; ///< whose projected Gaussians are a kind each
    GroupRequest group;             ///< of each view: eyes, or cameras
};
/// Kinds: isotropic-3 and random (single_gaussian.hpp), then those of the views, drawn from the
/// visible splats. The first row of a kind is fp16-direct. Throws InputError.
std::vector<AccuracyRow> measure_single_gaussians(const SingleGaussianRequest& request);

/// Whole images of the modelled data path against the reference renderer in double precision, both
/// with exact tile lists and the reference's stop rule.
struct SceneAccuracyRequest {
    std::vector<std::string> sets;        ///< as numbers_of() reads them
    std::vector<ViewRequest> scenes;      ///< a view's own resolution does not count
    GroupRequest group;                   ///< of each view: eyes, or cameras
    std::vector<std::string> resolutions; ///< as image_size() reads them; empty: the views' own
    std::string span_ends;                ///< for every set; empty: each set's own
    int tile_size = 32;                   ///< px; outward ends and bases of spans depend on it
    std::optional<ExponentGemm> gemm;     ///< exponents are products of matrices
    RenderingRules rules;                 ///< of the views
    bool error_images = true;             ///< write test - reference as EXR
};
/// One row per scene, resolution, view and set. Throws InputError.
std::vector<AccuracyRow> measure_scenes(const SceneAccuracyRequest& request,
                                        const OutputFolder& out);
/// The paths of the error images that an earlier measurement left beside its accuracy.json.
std::vector<std::string> old_error_images(const OutputFolder& out);

/// PSNR over the height of images, a panel per scene and camera, a line per set; rows of single
/// Gaussians are left out. Empty if nothing is left.
std::string accuracy_svg(const std::vector<AccuracyRow>& rows);

} // namespace degs::sim
