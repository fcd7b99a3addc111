// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/group_totals.hpp"

#include <limits>
#include <utility>

namespace degs::sim {

void GroupTotals::add(std::vector<double> amounts, const TileWork& work) {
    amounts_.push_back(std::move(amounts));
    work_.push_back(work);
}

void GroupTotals::add_known(const std::vector<double>& amounts) {
    for (std::size_t i = 0; i < known_.size(); ++i) {
        known_[i] += amounts[i];
    }
}

std::size_t GroupTotals::best_size(std::size_t amount) const {
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t size = 0; size < TileWork::kSizes; ++size) {
        double amounts = 0, sizes = 0;
        for (std::size_t g = 0; g < groups(); ++g) {
            amounts += amounts_[g][amount];
            sizes += work_[g].sizes()[size];
        }
        double squares = 0;
        for (std::size_t g = 0; g < groups() && sizes > 0; ++g) {
            const double residual = amounts_[g][amount] - amounts / sizes * work_[g].sizes()[size];
            squares += residual * residual;
        }
        if (sizes > 0 && squares < least) {
            least = squares;
            best = size;
        }
    }
    return best;
}

std::vector<double> GroupTotals::totals(const TileWork& rest, std::size_t left_out) const {
    std::vector<double> totals = known_;
    for (std::size_t i = 0; i < totals.size(); ++i) {
        const std::size_t size = best_size(i);
        double amounts = 0, sizes = 0;
        for (std::size_t g = 0; g < groups(); ++g) {
            if (g != left_out) {
                amounts += amounts_[g][i];
                sizes += work_[g].sizes()[size];
            }
        }
        totals[i] += sizes > 0 ? amounts / sizes * rest.sizes()[size] : 0;
    }
    return totals;
}

} // namespace degs::sim
