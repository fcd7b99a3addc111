// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/analytic_slicing.hpp"

#include <algorithm>
#include <cmath>

namespace degs {

AnalyticSlicing::AnalyticSlicing(int units, int splats_per_cycle, int rows)
    : cycles_per_splat_(1.0 / splats_per_cycle), free_(units, 0), passed_(rows, 0), recent_(1, 0) {}

void AnalyticSlicing::begin_tile(double date, std::size_t rows_per_cycle) {
    recent_.assign(std::max<std::size_t>(rows_per_cycle, 1), 0);
    std::fill(free_.begin(), free_.end(), date);
    std::fill(passed_.begin(), passed_.end(), date);
    begun_ = done_ = date;
}

double AnalyticSlicing::begin(double arrived) {
    const auto unit = std::min_element(free_.begin(), free_.end());
    begun_ = latest_ = std::max({std::ceil(arrived), begun_, *unit});
    std::swap(*unit, free_.back()); // the unit at work is the last one
    sent_ = cell_ = 0;
    next_row_ = 0;
    return begun_;
}

double AnalyticSlicing::send(int row) {
    // A row that the splat passes without sending it is passed with the one before.
    for (; next_row_ < row; ++next_row_) {
        passed_[next_row_] =
            sent_ == 0 ? passed_[next_row_] : std::max(passed_[next_row_], latest_);
    }
    double& cell = recent_[cell_];
    double date = std::max(latest_, passed_[row]);
    if (sent_ >= recent_.size()) {
        date = std::max(date, cell + 1);
    }
    if (date >= stalled_ && date < stalled_until_) {
        date = stalled_until_;
    }
    cell = latest_ = date;
    passed_[row] = date;
    ++sent_;
    cell_ = cell_ + 1 == recent_.size() ? 0 : cell_ + 1;
    next_row_ = row + 1;
    return date;
}

void AnalyticSlicing::stall(double date) {
    stalled_ = latest_;
    stalled_until_ = date;
    recent_[(cell_ == 0 ? recent_.size() : cell_) - 1] = latest_ = date;
    passed_[next_row_ - 1] = date;
}

double AnalyticSlicing::end() {
    if (sent_ != 0) {
        const auto below = passed_.begin() + next_row_;
        std::fill(below, std::lower_bound(below, passed_.end(), latest_), latest_);
    }
    free_.back() = latest_ + cycles_per_splat_;
    done_ = std::max(done_, free_.back());
    return latest_ - begun_ + 1;
}

} // namespace degs
