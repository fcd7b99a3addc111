// SPDX-License-Identifier: Apache-2.0
// Hard cases by what meets in a pixel or a tile: H11 .. H14, H19 .. H21, H30, H31.
#include <cmath>

#include "accuracy/hard/hard_builder.hpp"

namespace degs {
namespace {

glm::dvec3 cold_rgb(int i) {
    return {0.1 + 0.11 * (i % 8), 0.9 - 0.12 * (i % 7), 0.5};
}

} // namespace

std::vector<HardScene> make_opaque_stack_case(int width, int height) {
    HardBuilder builder(width, height);
    for (int i = 0; i < 60; ++i) {
        builder.add({builder.middle_x() + i % 3, builder.middle_y() - i % 2, 20.0 + i, 15, 0.1 * i,
                     0.991 + 0.009 * (i % 2), cold_rgb(i), 10.0 + i});
    }
    builder.look(builder.middle_x(), builder.middle_y());
    return only_scene(builder);
}

// Half of them have an opacity of 1/255, centred on a pixel; the others reach 1/255 at a pixel.
std::vector<HardScene> make_threshold_case(int width, int height) {
    HardBuilder builder(width, height);
    constexpr int kSide = 100; // px of the patch
    const double sigma = std::sqrt(4 - 0.3);
    const double reach = 2 * std::sqrt(2 * std::log(0.5 * 255)); // px
    for (int i = 0; i < 100000; ++i) {
        const int place = i * 37 % (kSide * kSide);
        const int column = place % kSide - kSide / 2;
        const int row = place / kSide - kSide / 2;
        const double x = builder.middle_x() + column;
        const double y = builder.middle_y() + row;
        if (i % 2 == 0) {
            builder.add({x, y, sigma, sigma, 0, 1.0 / 255.0, cold_rgb(i), 10 + 1e-4 * i});
        } else if (i % 200 == 1) {
            builder.add({x + reach, y, sigma, sigma, 0, 0.5, cold_rgb(i), 10 + 1e-4 * i});
        }
    }
    builder.look(builder.middle_x(), builder.middle_y(), 40);
    return only_scene(builder);
}

std::vector<HardScene> make_saturating_case(int width, int height) {
    HardBuilder builder(width, height);
    int column = 0;
    for (const double last : {0.9, 0.98, 0.9899, 0.98999, 0.9900, 0.9901, 0.995, 1.0}) {
        const double x = builder.middle_x() + 12 * column - 48;
        const double y = builder.middle_y();
        builder.add({x, y, 3, 3, 0, 1.0, {0.9, 0.2, 0.2}, 10.0 + column});
        builder.add({x, y, 3, 3, 0, last, {0.2, 0.9, 0.2}, 30.0 + column});
        builder.add({x, y, 3, 3, 0, 0.02, {0.2, 0.2, 0.9}, 50.0 + column}); // would still fit
        ++column;
    }
    builder.look(builder.middle_x(), builder.middle_y(), 60);
    return only_scene(builder);
}

std::vector<HardScene> make_equal_depth_case(int width, int height) {
    HardBuilder builder(width, height);
    const float depth = 10;
    const double next = std::nextafter(depth, 11.0F);
    for (int i = 0; i < 4000; ++i) {
        builder.add({builder.middle_x() + i % 61 - 30, builder.middle_y() + i % 59 - 29, 2, 1,
                     0.1 * i, 0.3, cold_rgb(i), i % 3 == 0 ? next : depth});
        if (i % 10 == 0) {
            repeat_last(builder.scene.cloud);
        }
    }
    builder.look(builder.middle_x(), builder.middle_y(), 40);
    return only_scene(builder);
}

// Centres on the corners of tiles of 16 px and more, on pixels and between them; the ellipse passes
// exactly through a pixel 4 px away.
std::vector<HardScene> make_corner_case(int width, int height) {
    HardBuilder builder(width, height);
    const double deviation = 4 / std::sqrt(2 * std::log(0.7 * 255));
    const double sigma = std::sqrt(deviation * deviation - 0.3);
    const int x = width / 2 / 64 * 64;
    const int y = height / 2 / 64 * 64;
    int i = 0;
    for (const int corner : {-64, -32, -16, 0, 16}) {
        for (const double shift : {-1.0, -0.5, 0.0, 0.5}) {
            builder.add({x + corner + shift, y + corner + shift, sigma, sigma, 0, 0.7, cold_rgb(i),
                         10.0 + i});
            builder.add({x + corner + shift, 1.0 * y - corner, sigma, sigma, 0, 0.7, cold_rgb(i),
                         10.5 + i});
            ++i;
        }
    }
    builder.look(x, y, 64);
    return only_scene(builder);
}

std::vector<HardScene> make_image_size_case(int width, int height) {
    const std::pair<int, int> sizes[] = {
        {1, 1}, {1, height}, {width, 1}, {width - 3, height - 7}, {width / 2 + 1, 33}};
    std::vector<HardScene> scenes;
    for (const auto& [w, h] : sizes) {
        HardBuilder builder(w, h);
        for (int i = 0; i < 12; ++i) {
            const double size = 2.0 + 4 * i;
            builder.add({0.09 * i * (w - 1), (1 - 0.09 * i) * (h - 1), size, size / 3, 0.4 * i, 0.6,
                         cold_rgb(i), 10.0 + i});
        }
        builder.look(0, 0);
        builder.look(builder.middle_x(), builder.middle_y());
        builder.look(w - 1, h - 1);
        scenes.push_back(only_scene(builder).front());
    }
    return scenes;
}

std::vector<HardScene> make_empty_case(int width, int height) {
    std::vector<HardScene> scenes;
    const auto finish = [&scenes](HardBuilder& builder) {
        builder.look(builder.middle_x(), builder.middle_y());
        builder.look(0, 0);
        scenes.push_back(only_scene(builder).front());
    };
    HardBuilder nothing(width, height);
    finish(nothing);
    HardBuilder hidden(width, height);
    hidden.add({5, 5, 3, 3, 0, 0.5, {1, 1, 1}, 0.1});
    hidden.add({5, 5, 3, 3, 0, 0.001, {1, 1, 1}, 10});
    hidden.add({-500, 5, 3, 3, 0, 0.5, {1, 1, 1}, 10});
    hidden.scene.culled.near = hidden.scene.culled.transparent = 1;
    hidden.scene.culled.off_screen = 1;
    finish(hidden);
    HardBuilder single(width, height);
    single.add({single.middle_x(), single.middle_y(), 4, 3, 1, 0.9, {0.9, 0.8, 0.1}, 10});
    finish(single);
    HardBuilder tile(width, height);
    for (int i = 0; i < 500; ++i) {
        tile.add({2.0 + i % 10, 2.0 + i % 11, 0.5, 0.4, 0.1 * i, 0.1, cold_rgb(i), 10.0 + i});
    }
    finish(tile);
    return scenes;
}

// All pixels of a tile but one saturate at once; that one has a list of 10 000.
std::vector<HardScene> make_long_tail_case(int width, int height) {
    HardBuilder builder(width, height);
    const int x = width / 2 / 64 * 64 + 8;
    const int y = height / 2 / 64 * 64 + 8;
    for (int dy = -40; dy <= 40; dy += 2) {
        for (int dx = -40; dx <= 40; dx += 2) {
            if (std::max(std::abs(dx), std::abs(dy)) > 6) {
                for (const double depth : {5.0, 6.0, 7.0}) {
                    builder.add(
                        {double(x + dx), double(y + dy), 1.2, 1.2, 0, 1.0, {0.3, 0.3, 0.3}, depth});
                }
            }
        }
    }
    for (int i = 0; i < 10000; ++i) {
        builder.add({double(x), double(y), 0.3, 0.2, 0.01 * i, 0.0045 + 1e-7 * i, cold_rgb(i),
                     10 + 0.01 * i});
    }
    builder.look(x, y, 16);
    return only_scene(builder);
}

// At most 0.02 opaque, a splat of 0.3 px^2 has no second pixel.
std::vector<HardScene> make_one_pixel_case(int width, int height) {
    HardBuilder builder(width, height);
    builder.scene.same_counts = true;
    for (int i = 0; i < 3000; ++i) {
        const int shift = i < 1500 ? 0 : 3;
        builder.add({builder.middle_x() + shift, builder.middle_y(), 0, 0, 0,
                     0.005 + 0.014 * (i % 100) / 100, cold_rgb(i), 10 + 0.001 * i});
    }
    builder.look(builder.middle_x(), builder.middle_y(), 8);
    return only_scene(builder);
}

} // namespace degs
