// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/raster.hpp"

#include <algorithm>
#include <vector>

#include "sim/text/output_columns.hpp"

#include <stb/stb_easy_font.h>

namespace degs::sim {
namespace {

// What stb_easy_font writes: four corners of each rectangle.
struct FontCorner {
    float x, y, z;
    unsigned char colour[4];
};

constexpr std::size_t kCornersPerCharacter = 4 * 24; // stb_easy_font says some 17 on average

// The font has the characters from 32 to 126 and reads beyond its table for others.
std::string printable(const std::string& words) {
    std::string plain = in_ascii(words);
    std::replace_if(
        plain.begin(), plain.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    return plain;
}

} // namespace

Raster::Raster(int width, int height) : image_(width, height) {
    std::fill(image_.rgb.begin(), image_.rgb.end(), 1.0F);
}

void Raster::rectangle(int x, int y, int width, int height, const Colour& colour) {
    for (int row = std::max(y, 0); row < std::min(y + height, image_.height); ++row) {
        for (int column = std::max(x, 0); column < std::min(x + width, image_.width); ++column) {
            float* const pixel = &image_.rgb[3 * image_.at(column, row)];
            std::transform(colour.begin(), colour.end(), pixel,
                           [](double c) { return static_cast<float>(c); });
        }
    }
}

void Raster::put(const Image& image, int x, int y) {
    for (int row = 0; row < image.height && y + row < image_.height; ++row) {
        const int columns = std::min(image.width, image_.width - x);
        std::copy_n(&image.rgb[3 * image.at(0, row)], 3 * std::max(columns, 0),
                    &image_.rgb[3 * image_.at(x, y + row)]);
    }
}

void Raster::text(int x, int y, int scale, const std::string& words, const Colour& colour) {
    std::string plain = printable(words);
    std::vector<FontCorner> corners(plain.size() * kCornersPerCharacter);
    const int rectangles =
        stb_easy_font_print(0, 0, plain.data(), nullptr, corners.data(),
                            static_cast<int>(corners.size() * sizeof(FontCorner)));
    for (int i = 0; i < rectangles; ++i) {
        const FontCorner &from = corners[4 * i], &to = corners[4 * i + 2];
        rectangle(x + static_cast<int>(from.x) * scale, y + static_cast<int>(from.y) * scale,
                  static_cast<int>(to.x - from.x) * scale, static_cast<int>(to.y - from.y) * scale,
                  colour);
    }
}

int raster_width(const std::string& words, int scale) {
    std::string plain = printable(words);
    return stb_easy_font_width(plain.data()) * scale;
}

} // namespace degs::sim
