// SPDX-License-Identifier: Apache-2.0
#include "sim/simulation/frame_changes.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "base/gini.hpp"
#include "base/ratio.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The Jaccard index of two ascending lists; 1 for two empty ones.
double jaccard(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    std::vector<std::uint32_t> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    const std::size_t either = a.size() + b.size() - both.size();
    return either == 0 ? 1 : ratio_of(both.size(), either);
}

std::uint64_t list_length(const FrameWorkload& frame, int tile) {
    return frame.tile_begin[tile + 1] - frame.tile_begin[tile];
}

double churn(const FrameWorkload& before, const FrameWorkload& now) {
    std::uint64_t changed = 0;
    std::uint64_t most = 0;
    for (int tile = 0; tile < now.tiles(); ++tile) {
        const std::uint64_t a = list_length(before, tile);
        const std::uint64_t b = list_length(now, tile);
        changed += std::max(a, b) - std::min(a, b);
        most += std::max(a, b);
    }
    return most == 0 ? 0 : ratio_of(changed, most);
}

/// Nearest rank.
double p99_list_length(const std::vector<const FrameWorkload*>& frames) {
    std::vector<std::uint64_t> lengths;
    for (const FrameWorkload* frame : frames) {
        for (int tile = 0; tile < frame->tiles(); ++tile) {
            lengths.push_back(list_length(*frame, tile));
        }
    }
    const std::size_t rank = (lengths.size() * 99 + 99) / 100 - 1;
    std::nth_element(lengths.begin(), lengths.begin() + rank, lengths.end());
    return static_cast<double>(lengths[rank]);
}

/// px^2 of the ellipse in which the splat is drawn.
double footprint(const ProjectedSplat& splat) {
    return kPi * splat.q_threshold * std::sqrt(splat.det);
}

} // namespace

std::string changes_words(const FrameChanges& changes) {
    std::string words;
    if (changes.active_overlap) {
        words += "active overlap " + three_digits(*changes.active_overlap) + " · ";
    }
    if (changes.tile_churn) {
        words += "tile churn " + percent(*changes.tile_churn) + " % · ";
    }
    return words + "P99 of tile candidates " + three_digits(changes.p99_tile_candidates) +
           " · footprint Gini " + three_digits(changes.footprint_gini);
}

FrameChanges frame_changes(const std::vector<const FrameWorkload*>& frames) {
    FrameChanges changes;
    changes.frames = frames.size();
    changes.p99_tile_candidates = p99_list_length(frames);
    double overlap = 0;
    double churned = 0;
    bool same_gaussians = frames.size() > 1;
    bool same_tiles = frames.size() > 1;
    for (std::size_t k = 0; k < frames.size(); ++k) {
        std::vector<double> areas;
        areas.reserve(frames[k]->splats.size());
        for (const ProjectedSplat& splat : frames[k]->splats) {
            areas.push_back(footprint(splat));
        }
        changes.footprint_gini += gini(std::move(areas)) / static_cast<double>(frames.size());
        if (k == 0) {
            continue;
        }
        const FrameWorkload& before = *frames[k - 1];
        same_gaussians = same_gaussians && before.gaussians == frames[k]->gaussians;
        same_tiles = same_tiles && before.tiles_x == frames[k]->tiles_x &&
                     before.tiles_y == frames[k]->tiles_y;
        overlap += same_gaussians ? jaccard(before.visible_of, frames[k]->visible_of) : 0;
        churned += same_tiles ? churn(before, *frames[k]) : 0;
    }
    const auto pairs = static_cast<double>(frames.size()) - 1;
    if (same_gaussians) {
        changes.active_overlap = overlap / pairs;
    }
    if (same_tiles) {
        changes.tile_churn = churned / pairs;
    }
    return changes;
}

} // namespace degs::sim
