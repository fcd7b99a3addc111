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

void FrameChangesSum::add(FramePointer frame) {
    std::vector<double> areas;
    areas.reserve(frame->splats.size());
    for (const ProjectedSplat& splat : frame->splats) {
        areas.push_back(footprint(splat));
    }
    footprint_gini_ += gini(std::move(areas)) / static_cast<double>(frames_);
    for (int tile = 0; tile < frame->tiles(); ++tile) {
        ++tiles_of_length_[list_length(*frame, tile)];
    }
    tiles_ += frame->tiles();
    if (before_ != nullptr) {
        compare(*before_, *frame);
    }
    before_ = std::move(frame);
}

void FrameChangesSum::compare(const FrameWorkload& before, const FrameWorkload& now) {
    same_gaussians_ = same_gaussians_ && before.gaussians == now.gaussians;
    same_tiles_ = same_tiles_ && before.tiles_x == now.tiles_x && before.tiles_y == now.tiles_y;
    overlap_ += same_gaussians_ ? jaccard(before.visible_of, now.visible_of) : 0;
    churned_ += same_tiles_ ? churn(before, now) : 0;
}

/// Nearest rank.
double FrameChangesSum::p99_list_length() const {
    const std::size_t rank = (tiles_ * 99 + 99) / 100 - 1;
    std::size_t below = 0;
    for (const auto& [length, tiles] : tiles_of_length_) {
        below += tiles;
        if (below > rank) {
            return static_cast<double>(length);
        }
    }
    return 0;
}

FrameChanges FrameChangesSum::changes() const {
    FrameChanges changes;
    changes.p99_tile_candidates = p99_list_length();
    changes.footprint_gini = footprint_gini_;
    const auto pairs = static_cast<double>(frames_) - 1;
    if (same_gaussians_ && frames_ > 1) {
        changes.active_overlap = overlap_ / pairs;
    }
    if (same_tiles_ && frames_ > 1) {
        changes.tile_churn = churned_ / pairs;
    }
    return changes;
}

} // namespace degs::sim
