// SPDX-License-Identifier: Apache-2.0
// Frames made by hand: splats go straight to the screen, without a scene and a projection.
#pragma once

#include <algorithm>
#include <vector>

#include "splat/frame/frame_workload.hpp"
#include "splat/frame/tile_cover.hpp"
#include "tests/splat/frame/projected.hpp"

namespace degs::test {

/// A frame of these splats, near to far in the order given; every Gaussian is visible.
inline FrameWorkload make_frame(std::vector<ProjectedSplat> splats, int width, int height,
                                int tile_size) {
    const TileGrid grid{width, height, tile_size};
    FrameWorkload frame;
    frame.camera.width = width;
    frame.camera.height = height;
    frame.camera.fx = frame.camera.fy = 1;
    frame.tile_size = tile_size;
    frame.tiles_x = grid.tiles_x();
    frame.tiles_y = grid.tiles_y();
    frame.gaussians = splats.size();
    std::vector<std::vector<std::uint32_t>> lists(static_cast<std::size_t>(frame.tiles()));
    std::vector<TileRun> runs;
    for (std::uint32_t i = 0; i < splats.size(); ++i) {
        splats[i].id = i;
        splats[i].depth = 1 + i;
        frame.visible_of.push_back(i);
        frame.visible_means.emplace_back(splats[i].mu_x, splats[i].mu_y, splats[i].depth);
        cover_tiles(splats[i], grid, TileMode::Exact, runs);
        std::uint32_t touched = 0;
        for (const TileRun& run : runs) {
            for (int x = run.first; x <= run.last; ++x, ++touched) {
                lists[static_cast<std::size_t>(run.row * frame.tiles_x + x)].push_back(i);
            }
        }
        frame.tiles_touched.push_back(touched);
    }
    frame.tile_begin.push_back(0);
    for (const auto& list : lists) {
        frame.tile_splats.insert(frame.tile_splats.end(), list.begin(), list.end());
        frame.tile_begin.push_back(frame.tile_splats.size());
    }
    frame.splats = std::move(splats);
    return frame;
}

/// One pixel and nothing else: the neighbours at distance 1 are outside q <= Q_th.
inline ProjectedSplat one_pixel(int x, int y, double opacity = 0.5) {
    const double sigma = 0.9 / std::sqrt(2 * std::log(opacity * 255));
    return make_splat(x, y, sigma, sigma, 0, opacity);
}

/// Covers every pixel within `radius` of the centre many times over, with alpha close to `opacity`.
inline ProjectedSplat blanket(double x, double y, double radius, double opacity = 0.5) {
    return make_splat(x, y, 4 * radius, 4 * radius, 0, opacity);
}

/// Pixels [x0, x1] of row y and nothing else; alpha falls to the ends.
inline ProjectedSplat one_row(double x0, double x1, int y, double opacity = 0.5) {
    const double reach = std::sqrt(2 * std::log(opacity * 255));
    return make_splat((x0 + x1) / 2, y, ((x1 - x0) / 2 + 0.3) / reach, 0.9 / reach, 0, opacity);
}

/// Splats of all sizes, many of them opaque enough to end pixels, some needles.
inline FrameWorkload random_frame(unsigned seed, int width, int height, int tile_size, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        const double size = 0.7 * std::exp(3.2 * unit(random));
        const double aspect = unit(random) < 0.2 ? 30 * unit(random) + 1 : 1 + 2 * unit(random);
        const double opacity =
            unit(random) < 0.5 ? 0.9 + 0.1 * unit(random) : 1.0 / 255 + 0.9 * unit(random);
        ProjectedSplat s =
            make_splat(width * (1.2 * unit(random) - 0.1), height * (1.2 * unit(random) - 0.1),
                       size * aspect, size, 6.3 * unit(random), opacity);
        for (double& channel : s.colour) {
            channel = 1.5 * unit(random);
        }
        splats.push_back(s);
    }
    return make_frame(splats, width, height, tile_size);
}

/// Splats of one pixel each, in one tile.
inline FrameWorkload one_pixel_splats(int count) {
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < count; ++i) {
        splats.push_back(one_pixel(i % 16, i / 16 % 16));
    }
    return make_frame(splats, 16, 16, 16);
}

} // namespace degs::test
