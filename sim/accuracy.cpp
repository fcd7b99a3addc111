// SPDX-License-Identifier: Apache-2.0
#include "sim/accuracy.hpp"

#include <cstdio>

#include "sim/text_table.hpp"
#include "sim/words.hpp"

namespace degs::sim {
namespace {

std::string error_words(std::optional<double> error) {
    if (!error) {
        return "";
    }
    char text[32];
    std::snprintf(text, sizeof text, "%.2e", *error);
    return text;
}

std::string decibel_words(std::optional<double> decibels) {
    return decibels ? three_digits(*decibels) : "";
}

std::string flip_words(const AccuracyRow& row) {
    if (row.gaussians == 0) {
        return "";
    }
    const double share =
        row.support > 0 ? static_cast<double>(row.flips) / static_cast<double>(row.support) : 0;
    return percent(share, 4);
}

nlohmann::ordered_json or_null(std::optional<double> value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace

std::string accuracy_table(const std::vector<AccuracyRow>& rows) {
    TextTable table({"scene", "camera", "size", "numbers", "mean", "spread", "max", "to fp16",
                     "flips %", "PSNR dB", "SSIM", "pixel max", "non-finite"});
    for (const AccuracyRow& row : rows) {
        table.add({row.scene, row.camera ? std::to_string(*row.camera) : "", row.resolution,
                   row.numbers, error_words(row.alpha_error_mean), error_words(row.spread),
                   error_words(row.alpha_error_max), error_words(row.mean_to_fp16), flip_words(row),
                   decibel_words(row.psnr_db), row.ssim ? three_digits(*row.ssim) : "",
                   error_words(row.max_abs_error), grouped(row.nonfinite)});
    }
    return table.text();
}

nlohmann::ordered_json accuracy_json(const std::vector<AccuracyRow>& rows) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const AccuracyRow& row : rows) {
        nlohmann::ordered_json json;
        json["scene"] = row.scene;
        json["camera"] = row.camera ? nlohmann::ordered_json(*row.camera) : nullptr;
        json["resolution"] = row.resolution;
        json["numbers"] = row.numbers;
        json["alpha_error_mean"] = row.alpha_error_mean;
        json["alpha_error_max"] = row.alpha_error_max;
        json["psnr_db"] = or_null(row.psnr_db);
        json["ssim"] = or_null(row.ssim);
        json["max_abs_error"] = or_null(row.max_abs_error);
        json["nonfinite"] = row.nonfinite;
        json["alpha_error_spread"] = or_null(row.spread);
        json["alpha_error_mean_to_fp16"] = or_null(row.mean_to_fp16);
        json["gaussians"] = row.gaussians;
        json["support_pixels"] = row.support;
        json["flips"] = row.flips;
        list.push_back(std::move(json));
    }
    return list;
}

} // namespace degs::sim
