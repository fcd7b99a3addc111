// SPDX-License-Identifier: Apache-2.0
// A pixel of two frames of one scene: what the format of the projection does to it.
#include <algorithm>
#include <cmath>
#include <map>

#include "accuracy/pixel_replay.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {
namespace {

/// A Gaussian's share of a pixel.
struct Share {
    double alpha = 0;
    double rgb[3] = {0, 0, 0};
};

std::uint32_t id_of(const FrameWorkload& work, std::uint64_t begin, std::size_t entry) {
    return work.splats[work.tile_splats[begin + entry]].id;
}

/// The list of the pixel's tile, by Gaussian.
struct Listed {
    std::map<std::uint32_t, Share> parts;
    std::vector<std::uint32_t> order; ///< Gaussians that the pixel is in, near to far

    Listed(const FrameWorkload& work, int x, int y, const PixelReplay& replay) {
        const int tile = work.grid().tile_of_pixel(x, y);
        const std::uint64_t begin = work.tile_begin[tile];
        for (std::size_t i = 0; i < replay.alpha.size(); ++i) {
            const ProjectedSplat& splat = work.splats[work.tile_splats[begin + i]];
            Share& part = parts[id_of(work, begin, i)];
            part.alpha = replay.alpha[i];
            for (int c = 0; c < 3; ++c) {
                part.rgb[c] = replay.weight[i] * splat.colour[c];
            }
            if (replay.weight[i] > 0) {
                order.push_back(splat.id);
            }
        }
    }
    Share part(std::uint32_t id) const {
        const auto at = parts.find(id);
        return at == parts.end() ? Share() : at->second;
    }
};

/// The Gaussian whose part differs most.
std::uint32_t most_changed(const Listed& a, const Listed& b) {
    std::uint32_t worst = 0;
    double most = -1;
    for (const Listed* side : {&a, &b}) {
        for (const auto& entry : side->parts) {
            const Share left = a.part(entry.first);
            const Share right = b.part(entry.first);
            for (int c = 0; c < 3; ++c) {
                const double change = std::abs(left.rgb[c] - right.rgb[c]);
                if (change > most) {
                    most = change;
                    worst = entry.first;
                }
            }
        }
    }
    return worst;
}

/// The Gaussians that both lists have blended, in the order of the first.
std::vector<std::uint32_t> shared(const Listed& of, const Listed& other) {
    std::vector<std::uint32_t> ids;
    std::copy_if(
        of.order.begin(), of.order.end(), std::back_inserter(ids), [&other](std::uint32_t id) {
            return std::find(other.order.begin(), other.order.end(), id) != other.order.end();
        });
    return ids;
}

std::string flipped_list(const Listed& a, const Listed& b, std::uint32_t id) {
    if ((a.part(id).alpha > 0) != (b.part(id).alpha > 0)) {
        return "span ends";
    }
    if (shared(a, b) != shared(b, a)) {
        return "depth order";
    }
    const auto last = [](const Listed& list) { return list.order.empty() ? 0 : list.order.back(); };
    return last(a) != last(b) ? "stop rule" : "";
}

} // namespace

PixelBlame blame_pixel(const FrameWorkload& reference, const FrameWorkload& projected, int x, int y,
                       const NumberSet& set, StopRule stop) {
    PixelBlame blame = blame_pixel(projected, x, y, set, stop);
    const PixelReplay truth = replay_reference(reference, x, y);
    const PixelReplay drawn = replay_reference(projected, x, y);
    const double error =
        pixel_distance(truth, replay_row(projected, x, y, QuantizedRow(set), stop));
    const double share = std::max(pixel_distance(truth, drawn), error - blame.error);
    blame.error = error;
    if (share > blame.explained) {
        const Listed exact(reference, x, y, truth);
        const Listed rounded(projected, x, y, drawn);
        blame.id = most_changed(exact, rounded);
        blame.operation = "projection";
        blame.explained = share;
        blame.flip = flipped_list(exact, rounded, blame.id);
    }
    return blame;
}

} // namespace degs
