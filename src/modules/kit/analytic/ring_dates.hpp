// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace degs {

/// Dates at which the cells of a ring are free again, oldest first; at first all are.
class RingDates {
public:
    explicit RingDates(std::size_t cells = 1) : dates_(std::max<std::size_t>(cells, 1), 0) {}
    double oldest() const { return dates_[next_]; }
    void replace_oldest(double date) {
        dates_[next_] = date;
        next_ = next_ + 1 == dates_.size() ? 0 : next_ + 1;
    }

private:
    std::vector<double> dates_;
    std::size_t next_ = 0;
};

} // namespace degs
