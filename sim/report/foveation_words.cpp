// SPDX-License-Identifier: Apache-2.0
#include "sim/report/foveation_words.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "base/ratio.hpp"
#include "scene/files/image_io.hpp"
#include "sim/report/view_words.hpp"
#include "sim/simulation/foveated_image.hpp"
#include "sim/simulation/run_result.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_facts.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

const char* name_of(const FoveatedLevel& level) {
    return level.scale == 1 ? "fovea" : level.scale == 2 ? "middle" : "periphery";
}

ordered_json box_json(const PixelBox& box) {
    return {box.x0, box.y0, box.width(), box.height()};
}

void put_part(const PartError* part, ordered_json& json) {
    json["psnr_db"] = part != nullptr ? number_json(part->psnr_db) : ordered_json();
    json["flip"] = part != nullptr ? number_json(part->flip) : ordered_json();
}

/// What view `number` of the frame asks for.
const WorkloadFacts& view_of(const RunResult& result, std::size_t number) {
    return result.views.empty() ? result.workload : result.views[number].workload;
}

ordered_json level_json(const RunResult& result, const FoveatedImage& image, std::size_t level,
                        std::size_t view) {
    const FoveatedLevel& part = image.view.levels[level];
    ordered_json json{{"name", name_of(part)},
                      {"view", view},
                      {"scale", part.scale},
                      {"rectangle", box_json(part.shown)},
                      {"pixels_shown", image.shown[level]},
                      {"pixels_drawn", view_of(result, view).pixels}};
    put_part(image.parts.empty() ? nullptr : &image.parts[level], json);
    return json;
}

ordered_json image_json(const RunResult& result, std::size_t number) {
    const FoveatedImage& image = result.foveation->images[number];
    const std::size_t count = image.view.levels.size();
    ordered_json json;
    json["levels"] = ordered_json::array();
    for (std::size_t level = 0; level < count; ++level) {
        json["levels"].push_back(level_json(result, image, level, number * count + level));
    }
    put_part(image.whole ? &*image.whole : nullptr, json);
    json["crc32"] = pixel_crc32(image.image);
    return json;
}

/// Pixels of the images of a frame.
std::uint64_t image_pixels(const RunResult& result) {
    std::uint64_t pixels = 0;
    for (const FoveatedImage& image : result.foveation->images) {
        pixels += image.view.camera.pixels();
    }
    return pixels;
}

} // namespace

ordered_json foveation_json(const RunResult& result) {
    const FoveationFacts& facts = *result.foveation;
    ordered_json json{{"centre", {facts.asked.centre.x, facts.asked.centre.y}},
                      {"fovea_degrees", facts.asked.fovea},
                      {"periphery_degrees", facts.asked.periphery},
                      {"pixels", image_pixels(result)},
                      {"pixels_drawn", drawn_pixels(result)}};
    json["images"] = ordered_json::array();
    for (std::size_t i = 0; i < facts.images.size(); ++i) {
        json["images"].push_back(image_json(result, i));
    }
    return json;
}

std::string foveation_words(const RunResult& result) {
    const std::uint64_t drawn = drawn_pixels(result), pixels = image_pixels(result);
    std::string words = scaled(drawn) + " pixels drawn for " + scaled(pixels) + " (" +
                        percent(ratio_of(drawn, pixels)) + " %)";
    const FoveatedImage& image = result.foveation->images.front();
    for (std::size_t level = 0; level < image.parts.size(); ++level) {
        const PartError& part = image.parts[level];
        words += std::string(" · ") + name_of(image.view.levels[level]) + " " +
                 (std::isinf(part.psnr_db) && part.psnr_db > 0
                      ? "identical"
                      : three_digits(part.psnr_db) + " dB, FLIP " + three_digits(part.flip));
    }
    return words;
}

} // namespace degs::sim
