// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/frame_workload.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>

#include "base/grouped_number.hpp"
#include "base/parallel.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

constexpr int kMaxTileSize = 1 << 16; // px; keeps every pixel coordinate of the grid within int

void check(const GaussianCloud& cloud, const Camera& camera, int tile_size,
           const ProjectionOptions& options) {
    if (camera.width < 1 || camera.height < 1 || !(camera.fx > 0) || !(camera.fy > 0)) {
        throw InputError("Camera " + std::to_string(camera.id) + " has an image of " +
                         std::to_string(camera.width) + " x " + std::to_string(camera.height) +
                         " pixels and focal lengths " + std::to_string(camera.fx) + " and " +
                         std::to_string(camera.fy) + "; all four must be positive.");
    }
    if (tile_size < 1 || tile_size > kMaxTileSize) {
        throw InputError("Tile size " + std::to_string(tile_size) +
                         " is not possible; it must lie in 1 .. " + std::to_string(kMaxTileSize) +
                         " pixels.");
    }
    if (!(options.near_plane >= 0)) {
        throw InputError("Near plane " + std::to_string(options.near_plane) +
                         " is not possible; it must be 0 or a positive distance in scene units.");
    }
    check_projection(camera, options);
    if (cloud.size() > std::numeric_limits<std::uint32_t>::max()) {
        throw InputError("The scene has " + std::to_string(cloud.size()) +
                         " Gaussians; at most 4294967295 are supported.");
    }
}

/// Everything that binning needs to know about the mode, and the scratch space for it.
class Binner {
public:
    Binner(const TileGrid& grid, TileMode mode) : grid_(grid), mode_(mode) {}

    /// Valid until the next call.
    const std::vector<TileRun>& cover(const ProjectedSplat& splat) {
        cover_tiles(splat, grid_, mode_, runs_);
        return runs_;
    }
    /// The tiles of the last call of cover() once more.
    const std::vector<TileRun>& last_cover() const { return runs_; }
    std::size_t tile(int row, int column) const { return row * grid_.tiles_x() + column; }
    const PixelBox& covered() const { return grid_.covered(); }

private:
    TileGrid grid_;
    TileMode mode_;
    std::vector<TileRun> runs_;
};

void count_cull(Cull cull, CullCounts& counts) {
    switch (cull) {
    case Cull::None:
        break;
    case Cull::Near:
        ++counts.near;
        break;
    case Cull::Transparent:
        ++counts.transparent;
        break;
    case Cull::Degenerate:
        ++counts.degenerate;
        break;
    case Cull::OffScreen:
        ++counts.off_screen;
        break;
    }
}

/// Adds a splat to the length of every list it belongs to (kept in ends[tile + 1]).
std::uint32_t count_tiles(const std::vector<TileRun>& cover, const Binner& binner,
                          std::vector<std::uint64_t>& ends) {
    std::uint32_t touched = 0;
    for (const TileRun& run : cover) {
        touched += run.last - run.first + 1;
        const std::size_t begin = binner.tile(run.row, run.first) + 1;
        const std::size_t end = binner.tile(run.row, run.last) + 1;
        for (std::size_t tile = begin; tile <= end; ++tile) {
            ++ends[tile];
        }
    }
    return touched;
}

/// What becomes of neighbouring Gaussians: visible splats in cloud order, shaded.
struct ProjectedBlock {
    CullCounts culled;
    std::vector<ProjectedSplat> splats;
    std::vector<glm::vec3> means;
    std::vector<std::uint32_t> tiles_touched;
};

/// Projects Gaussians begin .. end - 1 and counts their entries in lists.
ProjectedBlock project_block(const GaussianCloud& cloud, const Camera& camera,
                             const Projector& projector, std::size_t begin, std::size_t end,
                             TileMode mode, Binner& binner, std::vector<std::uint64_t>& ends) {
    ProjectedBlock block;
    for (std::size_t i = begin; i < end; ++i) {
        ProjectedSplat splat;
        // In the 3-sigma modes their box decides what is on the screen, not the ellipse.
        Cull cull = lists_whole_ellipse(mode) ? projector.project(i, binner.covered(), splat)
                                              : projector.project_anywhere(i, splat);
        if (cull == Cull::None) {
            cull = binner.cover(splat).empty() ? Cull::OffScreen : projector.shade(i, splat);
        }
        if (cull != Cull::None) {
            count_cull(cull, block.culled);
            if (cull == Cull::Near && camera.seen_depth(cloud.means[i])) {
                ++block.culled.near_in_view;
            }
            continue;
        }
        block.splats.push_back(splat);
        block.means.emplace_back(cloud.means[i]);
        block.tiles_touched.push_back(count_tiles(binner.last_cover(), binner, ends));
    }
    return block;
}

template <class Value>
void append(std::vector<Value>& all, const std::vector<Value>& some) {
    all.insert(all.end(), some.begin(), some.end());
}

/// Visible splats in cloud order, shaded; lists are counted but not filled.
void project_all(const GaussianCloud& cloud, const Binner& binner, FrameWorkload& work) {
    constexpr std::size_t kBlock = 1U << 14; // Gaussians: long against a thread's start
    const std::unique_ptr<Projector> projector =
        make_projector(cloud, work.camera, work.projection);
    std::vector<ProjectedBlock> blocks((cloud.size() + kBlock - 1) / kBlock);
    struct Worker {
        Binner binner;
        std::vector<std::uint64_t> ends;
    };
    std::vector<Worker> workers(host_threads(), Worker{binner, {}});
    parallel_blocks(blocks.size(), [&](std::size_t b, std::size_t w) {
        Worker& worker = workers[w];
        worker.ends.resize(work.tile_begin.size());
        blocks[b] = project_block(cloud, work.camera, *projector, b * kBlock,
                                  std::min((b + 1) * kBlock, cloud.size()), work.tile_mode,
                                  worker.binner, worker.ends);
    });
    std::size_t visible = 0;
    for (const ProjectedBlock& block : blocks) {
        visible += block.splats.size();
        work.culled += block.culled;
    }
    work.splats.reserve(visible);
    for (ProjectedBlock& block : blocks) {
        append(work.splats, block.splats);
        append(work.visible_means, block.means);
        append(work.tiles_touched, block.tiles_touched);
        block = {};
    }
    work.visible_of.reserve(visible);
    for (const ProjectedSplat& splat : work.splats) {
        work.visible_of.push_back(splat.id);
    }
    for (const Worker& worker : workers) {
        for (std::size_t tile = 0; tile < worker.ends.size(); ++tile) {
            work.tile_begin[tile] += worker.ends[tile];
        }
    }
}

/// Positions in near-to-far order. Bits of positive floats order like their values; the position
/// in the low half makes the order of equal keys that of the cloud. `format` is one that fits
/// floats; rounding keeps the order, and what lies beyond it is infinite or its last value.
std::vector<std::uint64_t> depth_order(const std::vector<ProjectedSplat>& splats,
                                       const NumberFormat& format) {
    const Rounder key_of(format);
    std::vector<std::uint64_t> keys(splats.size());
    for (std::size_t i = 0; i < splats.size(); ++i) {
        const auto depth = static_cast<float>(key_of(splats[i].depth));
        std::uint32_t bits = 0;
        std::memcpy(&bits, &depth, sizeof bits);
        keys[i] = static_cast<std::uint64_t>(bits) << 32 | i;
    }
    std::sort(keys.begin(), keys.end());
    for (std::uint64_t& key : keys) {
        key &= 0xffffffffU;
    }
    return keys;
}

template <class Value>
void reorder(std::vector<Value>& values, const std::vector<std::uint64_t>& order) {
    std::vector<Value> sorted;
    sorted.reserve(values.size());
    for (const std::uint64_t position : order) {
        sorted.push_back(values[position]);
    }
    values.swap(sorted);
}

/// Turns list lengths into offsets and appends every splat, near to far, to its lists.
void fill_lists(Binner& binner, FrameWorkload& work) {
    for (std::size_t tile = 1; tile < work.tile_begin.size(); ++tile) {
        work.tile_begin[tile] += work.tile_begin[tile - 1];
    }
    work.tile_splats.resize(work.tile_begin.back());
    std::vector<std::uint64_t> next(work.tile_begin.begin(), work.tile_begin.end() - 1);
    for (std::size_t i = 0; i < work.splats.size(); ++i) {
        for (const TileRun& run : binner.cover(work.splats[i])) {
            const std::size_t end = binner.tile(run.row, run.last);
            for (std::size_t tile = binner.tile(run.row, run.first); tile <= end; ++tile) {
                work.tile_splats[next[tile]++] = static_cast<std::uint32_t>(i);
            }
        }
    }
}

} // namespace

std::uint32_t FrameWorkload::visible_among(std::uint64_t first_gaussians) const {
    const auto end = std::lower_bound(visible_of.begin(), visible_of.end(), first_gaussians);
    return static_cast<std::uint32_t>(end - visible_of.begin());
}

FrameWorkload make_frame_workload(const GaussianCloud& cloud, const Camera& camera, int tile_size,
                                  TileMode mode, const ProjectionOptions& options) {
    check(cloud, camera, tile_size, options);
    const TileGrid grid(camera, tile_size);
    FrameWorkload work;
    work.camera = camera;
    work.projection = options;
    work.tile_size = tile_size;
    work.tile_mode = mode;
    work.tiles_x = grid.tiles_x();
    work.tiles_y = grid.tiles_y();
    work.gaussians = cloud.size();
    work.sh_degree = cloud.sh_degree;
    work.tile_begin.assign(work.tiles() + std::size_t{1}, 0);

    Binner binner(grid, mode);
    project_all(cloud, binner, work);
    const std::vector<std::uint64_t> order =
        depth_order(work.splats, work.projection.numbers.depth_key);
    reorder(work.splats, order);
    reorder(work.tiles_touched, order);
    fill_lists(binner, work);
    return work;
}

CullCounts& CullCounts::operator+=(const CullCounts& other) {
    near += other.near;
    near_in_view += other.near_in_view;
    transparent += other.transparent;
    degenerate += other.degenerate;
    off_screen += other.off_screen;
    return *this;
}

std::string CullCounts::explain() const {
    return grouped(total()) +
           " Gaussians of the scene were culled, so that their colours were not evaluated: " +
           grouped(off_screen) + " touch no pixel, " + grouped(near) +
           " are nearer than the near plane, " + grouped(transparent) +
           " are fainter than 1/255, " + grouped(degenerate) + " have no finite projection.";
}

} // namespace degs
