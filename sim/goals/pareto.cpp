// SPDX-License-Identifier: Apache-2.0
#include "sim/goals/pareto.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace degs::sim {
namespace {

/// Whether `a` is at least as good as `b` in all goals.
bool reaches(const Goals& a, const Goals& b) {
    for (std::size_t g = 0; g < a.size(); ++g) {
        if (a[g] > b[g]) {
            return false;
        }
    }
    return true;
}

} // namespace

// A design can only be beaten by those before it in the order of the goals, and one that is beaten
// by a front is beaten by all before that; so the first front that does not beat it is found by
// halving.
std::vector<std::vector<std::size_t>> fronts_of(const std::vector<Goals>& goals) {
    std::vector<std::size_t> order(goals.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&goals](std::size_t a, std::size_t b) {
        return std::tie(goals[a], a) < std::tie(goals[b], b);
    });
    std::vector<std::vector<std::size_t>> fronts;
    for (const std::size_t position : order) {
        const auto beats = [&goals, position](const std::vector<std::size_t>& front, int) {
            return std::any_of(front.rbegin(), front.rend(), [&](std::size_t other) {
                return reaches(goals[other], goals[position]);
            });
        };
        const auto front = std::lower_bound(fronts.begin(), fronts.end(), 0, beats);
        if (front == fronts.end()) {
            fronts.push_back({position});
        } else {
            front->push_back(position);
        }
    }
    return fronts;
}

std::vector<std::size_t> pareto_front(const std::vector<Goals>& goals) {
    const auto fronts = fronts_of(goals);
    return fronts.empty() ? std::vector<std::size_t>() : fronts.front();
}

} // namespace degs::sim
