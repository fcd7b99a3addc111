// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy/accuracy.hpp"

#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "base/ratio.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

std::string error_words(std::optional<double> error) {
    if (!error || std::isnan(*error)) {
        return error ? "nan" : ""; // without the sign that printf gives some of them
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.2e", *error);
    return text;
}

std::string decibel_words(const AccuracyRow& row) {
    return row.identical ? "identical" : row.psnr_db ? three_digits(*row.psnr_db) : "";
}

/// Six decimals, because the interesting values lie close to 1.
std::string ssim_words(double ssim) {
    if (std::isnan(ssim)) {
        return "nan";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.6f", ssim);
    return text;
}

/// "1204, 377: #5012, exp (stop rule)".
std::string worst_words(const std::optional<WorstPixel>& worst) {
    if (!worst) {
        return "";
    }
    std::string words = std::to_string(worst->x) + ", " + std::to_string(worst->y);
    if (!worst->operation.empty()) {
        words += ": #" + std::to_string(worst->gaussian) + ", " + worst->operation;
    }
    return words + (worst->flip.empty() ? "" : " (" + worst->flip + ")");
}

std::string flip_words(const AccuracyRow& row) {
    if (row.gaussians == 0) {
        return "";
    }
    const double share = ratio_of(row.flips, row.support);
    return percent(share, 4);
}

std::string camera_words(const AccuracyRow& row) {
    return (row.camera ? std::to_string(*row.camera) : "") + (row.eye.empty() ? "" : " ") + row.eye;
}

nlohmann::ordered_json or_null(const std::string& words) {
    return words.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(words);
}

nlohmann::ordered_json worst_json(const std::optional<WorstPixel>& worst) {
    if (!worst) {
        return nullptr;
    }
    nlohmann::ordered_json json;
    json["x"] = worst->x;
    json["y"] = worst->y;
    json["gaussian"] = worst->gaussian;
    json["operation"] = or_null(worst->operation);
    json["flip"] = or_null(worst->flip);
    json["error"] = number_json(worst->error);
    json["error_of_operation"] = number_json(worst->explained);
    return json;
}

/// Adds the keys that only rows of images have.
void add_image_keys(const AccuracyRow& row, nlohmann::ordered_json& json) {
    const bool image = !row.span_ends.empty();
    json["identical"] = image ? nlohmann::ordered_json(row.identical) : nullptr;
    json["span_ends"] = or_null(row.span_ends);
    json["recounted_pixels"] = image ? nlohmann::ordered_json(row.recounted) : nullptr;
    json["worst_pixel"] = worst_json(row.worst);
    json["error_image"] = or_null(row.error_image);
}

} // namespace

void name_view(const ViewRequest& view, const GroupRequest& group, std::size_t number,
               AccuracyRow& row) {
    row.camera = group.cameras.empty() ? view.camera : group.cameras[number];
    row.eye = !group.eyes_m ? "" : number == 0 ? "left" : "right";
}

std::string accuracy_table(const std::vector<AccuracyRow>& rows) {
    TextTable table({"scene", "camera", "size", "numbers", "mean", "spread", "max", "to fp16",
                     "flips %", "PSNR dB", "SSIM", "FLIP", "pixel max", "non-finite", "ends",
                     "worst pixel"});
    for (const AccuracyRow& row : rows) {
        table.add({row.scene, camera_words(row), row.resolution, row.numbers,
                   error_words(row.alpha_error_mean), error_words(row.spread),
                   error_words(row.alpha_error_max), error_words(row.mean_to_fp16), flip_words(row),
                   decibel_words(row), row.ssim ? ssim_words(*row.ssim) : "", error_words(row.flip),
                   error_words(row.max_abs_error), grouped(row.nonfinite), row.span_ends,
                   worst_words(row.worst)});
    }
    return table.text();
}

nlohmann::ordered_json accuracy_json(const std::vector<AccuracyRow>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const AccuracyRow& row : rows) {
        nlohmann::ordered_json json;
        json["scene"] = row.scene;
        json["camera"] = row.camera ? nlohmann::ordered_json(*row.camera) : nullptr;
        if (!row.eye.empty()) {
            json["eye"] = row.eye;
        }
        json["resolution"] = row.resolution;
        json["numbers"] = row.numbers;
        json["alpha_error_mean"] = number_json(row.alpha_error_mean);
        json["alpha_error_max"] = number_json(row.alpha_error_max);
        json["psnr_db"] = value_or_null(row.psnr_db);
        json["ssim"] = value_or_null(row.ssim);
        json["flip"] = value_or_null(row.flip);
        json["max_abs_error"] = value_or_null(row.max_abs_error);
        json["nonfinite"] = row.nonfinite;
        json["alpha_error_spread"] = value_or_null(row.spread);
        json["alpha_error_mean_to_fp16"] = value_or_null(row.mean_to_fp16);
        json["gaussians"] = row.gaussians;
        json["support_pixels"] = row.support;
        json["flips"] = row.flips;
        add_image_keys(row, json);
        list.push_back(std::move(json));
    }
    return list;
}

} // namespace degs::sim
