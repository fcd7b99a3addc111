// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "sim/sweep/search.hpp"

namespace degs::sim {
namespace {

/// The front of those positions that `wanted` lists.
std::vector<std::size_t> front_of(const std::vector<Goals>& goals,
                                  std::vector<std::size_t> wanted) {
    std::sort(wanted.begin(), wanted.end(), [&goals](std::size_t a, std::size_t b) {
        return std::make_pair(goals[a], a) < std::make_pair(goals[b], b);
    });
    std::vector<std::size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t position : wanted) {
        if (goals[position][1] < least) {
            least = goals[position][1];
            front.push_back(position);
        }
    }
    return front;
}

/// How far the neighbours of a place on the front lie apart, in ratios of both goals.
double gap_at(const std::vector<Goals>& goals, const std::vector<std::size_t>& front,
              std::size_t place) {
    if (place == 0 || place + 1 == front.size()) {
        return std::numeric_limits<double>::infinity();
    }
    const Goals& before = goals[front[place - 1]];
    const Goals& after = goals[front[place + 1]];
    return std::abs(std::log(after[0] / before[0])) + std::abs(std::log(before[1] / after[1]));
}

/// Leaves `count` places of the front: the one whose neighbours are closest goes first.
void thin(const std::vector<Goals>& goals, std::vector<std::size_t>& front, std::size_t count) {
    while (front.size() > count) {
        std::size_t closest = 0;
        for (std::size_t place = 1; place < front.size(); ++place) {
            if (gap_at(goals, front, place) < gap_at(goals, front, closest)) {
                closest = place;
            }
        }
        front.erase(front.begin() + static_cast<std::ptrdiff_t>(closest));
    }
}

/// Ranks from 1; equal values share the mean of theirs.
std::vector<double> ranks_of(const std::vector<double>& values) {
    std::vector<double> ranks(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        std::size_t less = 0;
        std::size_t equal = 0;
        for (const double other : values) {
            less += other < values[i] ? 1 : 0;
            equal += other == values[i] ? 1 : 0;
        }
        ranks[i] = static_cast<double>(less) + (static_cast<double>(equal) + 1) / 2;
    }
    return ranks;
}

} // namespace

std::vector<std::size_t> pareto_front(const std::vector<Goals>& goals) {
    std::vector<std::size_t> all(goals.size());
    std::iota(all.begin(), all.end(), 0);
    return front_of(goals, all);
}

std::vector<std::size_t> best_of(const std::vector<Goals>& goals, std::size_t count) {
    std::vector<std::size_t> rest(goals.size());
    std::iota(rest.begin(), rest.end(), 0);
    std::vector<std::size_t> best;
    while (best.size() < count && !rest.empty()) {
        std::vector<std::size_t> front = front_of(goals, rest);
        rest.erase(std::remove_if(rest.begin(), rest.end(),
                                  [&front](std::size_t position) {
                                      return std::find(front.begin(), front.end(), position) !=
                                             front.end();
                                  }),
                   rest.end());
        thin(goals, front, count - best.size());
        best.insert(best.end(), front.begin(), front.end());
    }
    std::sort(best.begin(), best.end());
    return best;
}

std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr std::size_t kFewest = 3;
    if (a.size() < kFewest) {
        return {};
    }
    const std::vector<double> first = ranks_of(a);
    const std::vector<double> second = ranks_of(b);
    const double mean = (static_cast<double>(a.size()) + 1) / 2;
    double covariance = 0;
    double spread_a = 0;
    double spread_b = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        covariance += (first[i] - mean) * (second[i] - mean);
        spread_a += (first[i] - mean) * (first[i] - mean);
        spread_b += (second[i] - mean) * (second[i] - mean);
    }
    if (spread_a == 0 || spread_b == 0) {
        return {};
    }
    return covariance / std::sqrt(spread_a * spread_b);
}

} // namespace degs::sim
