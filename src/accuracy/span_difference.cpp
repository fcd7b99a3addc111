// SPDX-License-Identifier: Apache-2.0
#include "accuracy/span_difference.hpp"

#include <algorithm>
#include <cmath>

namespace degs {
namespace {

/// The pixels of a row; `inside` becomes false if there are some and not all lie in the image.
PixelRange solve(const DataPath& path, std::uint32_t splat, int y, const PixelRange& image,
                 bool& inside) {
    const std::optional<RowSpan> span = path.solve_row(splat, y, image.first, image.last + 1, y);
    if (!span) {
        return {};
    }
    inside =
        inside && span->length >= 1 && span->x0 >= 0 && span->x0 + span->length <= image.size();
    const int x0 = image.first + span->x0;
    return {x0, x0 + span->length - 1};
}

double off_threshold(const ProjectedSplat& s, int x, int y) {
    const double dy = y - s.mu_y;
    const double u = x - s.mu_x - s.cov_b / s.cov_c * dy;
    const double q = s.conic_a() * u * u + dy * dy / s.cov_c;
    return std::abs(std::exp(0.5 * (s.q_threshold - q)) - 1);
}

/// Counts what `one` has and `other` has not.
void count_flips(const ProjectedSplat& splat, int y, const PixelRange& one, const PixelRange& other,
                 SpanDifference& difference) {
    for (int x = one.first; x <= one.last; ++x) {
        if (other.holds(x)) {
            x = other.last;
            continue;
        }
        ++difference.flips;
        difference.farthest = std::max(difference.farthest, off_threshold(splat, x, y));
    }
}

} // namespace

SpanDifference compare_spans(const FrameWorkload& workload, const DataPathOptions& first,
                             const DataPathOptions& second) {
    const auto one = make_data_path(first, workload.tile_size, 1);
    const auto two = make_data_path(second, workload.tile_size, 1);
    one->add_frame(workload);
    two->add_frame(workload);
    const PixelBox image = workload.camera.window();
    const PixelRange columns{image.x0, image.x1};
    SpanDifference difference;
    for (std::uint32_t i = 0; i < workload.splats.size(); ++i) {
        const PixelRange rows = one->rows(i).widened(1).within({image.y0, image.y1});
        for (int y = rows.first; y <= rows.last; ++y) {
            const PixelRange a = solve(*one, i, y, columns, difference.inside);
            const PixelRange b = solve(*two, i, y, columns, difference.inside);
            difference.spans += a.empty() ? 0 : 1;
            difference.pixels += a.size();
            count_flips(workload.splats[i], y, a, b, difference);
            count_flips(workload.splats[i], y, b, a, difference);
        }
    }
    return difference;
}

} // namespace degs
