// SPDX-License-Identifier: Apache-2.0
#include "sim/workload_file/splat_block.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "scene/files/input_file.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kAtOnce = 256; // splats, which a core's caches hold together
constexpr std::size_t kReals = 13;

/// The values of a splat, in the order of their columns.
template <class Splat, class Pass>
void pass_values(Splat& s, Pass&& pass) {
    std::size_t column = 0;
    for (auto* value :
         {&s.mu_x, &s.mu_y, &s.cov_a, &s.cov_b, &s.cov_c, &s.det, &s.opacity, &s.q_threshold,
          &s.q_cut_off, &s.colour[0], &s.colour[1], &s.colour[2], &s.depth}) {
        pass(column++, *value);
    }
}

[[noreturn]] void fail_damaged(const std::string& path, const std::string& place) {
    fail_file(path, place + " is damaged; it must hold columns of planes that libzstd unpacks.");
}

} // namespace

std::size_t blocks_of(std::size_t splats) {
    return splats / kSplatsPerBlock + (splats % kSplatsPerBlock == 0 ? 0 : 1);
}

std::string pack_gaussians(const FrameWorkload& frame, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> steps(frame.visible_of.begin() + static_cast<std::ptrdiff_t>(begin),
                                     frame.visible_of.begin() + static_cast<std::ptrdiff_t>(end));
    for (std::size_t i = steps.size(); i-- > 1;) {
        steps[i] -= steps[i - 1];
    }
    PlaneWriter writer;
    writer.put(steps);
    for (int axis = 0; axis < 3; ++axis) {
        std::vector<double> column;
        for (std::size_t i = begin; i < end; ++i) {
            column.push_back(frame.visible_means[i][axis]);
        }
        writer.put(column);
    }
    return writer.block((end - begin) * kBytesPerGaussian);
}

std::string pack_splats(const FrameWorkload& frame, std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> places;
    std::array<std::vector<double>, kReals> columns;
    for (std::size_t i = begin; i < end; ++i) {
        places.push_back(frame.visible_among(frame.splats[i].id));
        pass_values(frame.splats[i], [&](std::size_t column, const double& value) {
            columns[column].push_back(value);
        });
    }
    PlaneWriter writer;
    writer.put(places);
    for (const std::vector<double>& column : columns) {
        writer.put(column);
    }
    return writer.block((end - begin) * kBytesPerSplat);
}

SplatUnpacker::SplatUnpacker(const std::string& path, FrameWorkload& frame)
    : path_(path), frame_(frame), limits_(frame.projection),
      key_of_(frame.projection.numbers.depth_key),
      seen_(new std::atomic<unsigned char>[frame.visible_of.size()]()) {}

void SplatUnpacker::check_gaussian(const std::string& place, std::size_t at,
                                   bool has_before) const {
    const std::uint32_t id = frame_.visible_of[at];
    if (id >= frame_.gaussians || (has_before && id <= frame_.visible_of[at - 1])) {
        fail_file(path_, place + ", splat " + std::to_string(at) + " is of Gaussian " +
                             std::to_string(id) + ", but numbers must rise and lie below " +
                             std::to_string(frame_.gaussians) + ".");
    }
}

void SplatUnpacker::gaussians(const std::string& place, std::string_view block, std::size_t begin,
                              std::size_t end, PlaneReader::Workspace& workspace) const {
    const std::size_t count = end - begin;
    PlaneReader reader(block, count, workspace);
    std::array<PlaneReader::Column, 4> columns;
    for (PlaneReader::Column& column : columns) {
        if (!reader.next(false, column)) {
            fail_damaged(path_, place);
        }
    }
    if (!reader.complete()) {
        fail_damaged(path_, place);
    }
    columns[0].get(0, count, frame_.visible_of.data() + begin);
    std::vector<float> values(count);
    for (int axis = 0; axis < 3; ++axis) {
        columns[1 + axis].get(0, count, values.data());
        for (std::size_t i = 0; i < count; ++i) {
            frame_.visible_means[begin + i][axis] = values[i];
        }
    }
    for (std::size_t i = begin; i < end; ++i) {
        frame_.visible_of[i] += i == begin ? 0 : frame_.visible_of[i - 1];
        check_gaussian(place, i, i > begin);
        const glm::vec3& mean = frame_.visible_means[i];
        if (!std::isfinite(mean.x) || !std::isfinite(mean.y) || !std::isfinite(mean.z)) {
            fail_file(path_, place + ", the mean of Gaussian " +
                                 std::to_string(frame_.visible_of[i]) +
                                 " is not finite; only finite coordinates are allowed.");
        }
    }
}

float SplatUnpacker::depth_key(std::size_t at) const {
    return static_cast<float>(key_of_(frame_.splats[at].depth));
}

void SplatUnpacker::check_order(const std::string& place, std::size_t at, float before,
                                float own) const {
    const bool rises =
        before < own || (before == own && frame_.splats[at - 1].id < frame_.splats[at].id);
    if (!rises) {
        fail_file(path_, place + ", splat " + std::to_string(at) +
                             " is not behind the one before it; splats must come near to far, and "
                             "those of equal depths by the numbers of their Gaussians.");
    }
}

void SplatUnpacker::splats(const std::string& place, std::string_view block, std::size_t begin,
                           std::size_t end, PlaneReader::Workspace& workspace) const {
    PlaneReader reader(block, end - begin, workspace);
    std::array<PlaneReader::Column, 1 + kReals> columns;
    for (std::size_t column = 0; column < columns.size(); ++column) {
        if (!reader.next(column > 0, columns[column])) {
            fail_damaged(path_, place);
        }
    }
    if (!reader.complete()) {
        fail_damaged(path_, place);
    }
    std::array<std::uint32_t, kAtOnce> places;
    std::array<std::array<double, kAtOnce>, kReals> values;
    float key_before = 0;
    for (std::size_t first = begin; first < end; first += kAtOnce) {
        const std::size_t count = std::min(kAtOnce, end - first);
        columns[0].get(first - begin, count, places.data());
        for (std::size_t column = 0; column < kReals; ++column) {
            columns[1 + column].get(first - begin, count, values[column].data());
        }
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t at = first + i;
            ProjectedSplat& splat = frame_.splats[at];
            pass_values(splat,
                        [&](std::size_t column, double& value) { value = values[column][i]; });
            const bool there = places[i] < frame_.visible_of.size();
            splat.id = there ? frame_.visible_of[places[i]] : 0;
            if (!there || !is_sound(splat, limits_)) {
                fail_file(path_, place + ", splat " + std::to_string(at) +
                                     " has a value that is not finite or outside its range; only "
                                     "what a projection gives is allowed.");
            }
            seen_[places[i]].store(1, std::memory_order_relaxed);
            const float key = depth_key(at);
            if (at > begin) {
                check_order(place, at, key_before, key);
            }
            key_before = key;
        }
    }
}

void SplatUnpacker::check_whole(const std::string& place) const {
    const std::size_t splats = frame_.splats.size();
    for (std::size_t first = kSplatsPerBlock; first < splats; first += kSplatsPerBlock) {
        check_gaussian(place, first, true);
        check_order(place, first, depth_key(first - 1), depth_key(first));
    }
    for (std::size_t i = 0; i < splats; ++i) {
        if (seen_[i].load(std::memory_order_relaxed) == 0) {
            fail_file(path_, place + ", Gaussian " + std::to_string(frame_.visible_of[i]) +
                                 " has no splat; every one must have its own.");
        }
    }
}

} // namespace degs::sim
