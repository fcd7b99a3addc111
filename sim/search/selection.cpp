// SPDX-License-Identifier: Apache-2.0
#include "sim/search/selection.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace degs::sim {
namespace {

/// How far apart two values are, as a ratio. There is none over 0 or between signs, which is far.
double distance(double a, double b) {
    const double ratio = b / a;
    const bool has_ratio = ratio > 0 && std::isfinite(ratio);
    return a == b      ? 0
           : has_ratio ? std::abs(std::log(ratio))
                       : std::numeric_limits<double>::infinity();
}

/// A front from which designs drop out one by one.
class Crowd {
public:
    Crowd(const std::vector<Goals>& goals, const std::vector<std::size_t>& front)
        : goals_(goals), front_(front), alive_(front.size(), true), rooms_(front.size()) {
        for (std::size_t g = 0; g < goals[front[0]].size(); ++g) {
            link(g);
        }
        for (std::size_t place = 0; place < front.size(); ++place) {
            rooms_[place] = room_of(place);
        }
    }

    void drop_the_closest() {
        std::size_t closest = front_.size();
        for (std::size_t place = 0; place < front_.size(); ++place) {
            if (alive_[place] && (closest == front_.size() || rooms_[place] < rooms_[closest])) {
                closest = place;
            }
        }
        alive_[closest] = false;
        std::vector<std::size_t> neighbours;
        for (auto& links : links_) {
            const auto [before, after] = links[closest];
            if (before != kNone) {
                links[before].second = after;
                neighbours.push_back(before);
            }
            if (after != kNone) {
                links[after].first = before;
                neighbours.push_back(after);
            }
        }
        for (const std::size_t place : neighbours) {
            rooms_[place] = room_of(place);
        }
    }

    double room(std::size_t place) const {
        return rooms_[place].first > 0 ? std::numeric_limits<double>::infinity()
                                       : rooms_[place].second;
    }

    std::vector<std::size_t> rest() const {
        std::vector<std::size_t> rest;
        for (std::size_t place = 0; place < front_.size(); ++place) {
            if (alive_[place]) {
                rest.push_back(front_[place]);
            }
        }
        return rest;
    }

private:
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    using Links = std::vector<std::pair<std::size_t, std::size_t>>; ///< places before and after
    using Room = std::pair<int, double>; ///< in how many goals it is the best; the distances

    double cost(std::size_t place, std::size_t g) const { return goals_[front_[place]][g]; }

    void link(std::size_t g) {
        std::vector<std::size_t> order(front_.size());
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(), [this, g](std::size_t a, std::size_t b) {
            return std::make_pair(cost(a, g), a) < std::make_pair(cost(b, g), b);
        });
        Links links(front_.size(), {kNone, kNone});
        for (std::size_t i = 1; i < order.size(); ++i) {
            links[order[i]].first = order[i - 1];
            links[order[i - 1]].second = order[i];
        }
        links_.push_back(std::move(links));
    }

    /// The worst in a goal has no second neighbour there, which counts nothing.
    Room room_of(std::size_t place) const {
        Room room{0, 0.0};
        for (std::size_t g = 0; g < links_.size(); ++g) {
            const auto [before, after] = links_[g][place];
            if (before == kNone) {
                ++room.first;
            } else if (after != kNone) {
                room.second += distance(cost(before, g), cost(after, g));
            }
        }
        return room;
    }

    const std::vector<Goals>& goals_;
    const std::vector<std::size_t>& front_;
    std::vector<bool> alive_;
    std::vector<Links> links_; ///< by goal
    std::vector<Room> rooms_;
};

} // namespace

std::vector<std::size_t> best_of(const std::vector<Goals>& goals, std::size_t count) {
    std::vector<std::size_t> best;
    for (const std::vector<std::size_t>& front : fronts_of(goals)) {
        if (best.size() == count) {
            break;
        }
        Crowd crowd(goals, front);
        for (std::size_t left = front.size(); left > count - best.size(); --left) {
            crowd.drop_the_closest();
        }
        const std::vector<std::size_t> rest = crowd.rest();
        best.insert(best.end(), rest.begin(), rest.end());
    }
    std::sort(best.begin(), best.end());
    return best;
}

std::vector<std::size_t> best_within(const std::vector<Goals>& goals,
                                     const std::vector<double>& excess, std::size_t count) {
    std::vector<std::size_t> within;
    std::vector<std::size_t> outside;
    std::vector<Goals> costs;
    for (std::size_t position = 0; position < goals.size(); ++position) {
        (excess[position] == 0 ? within : outside).push_back(position);
        if (excess[position] == 0) {
            costs.push_back(goals[position]);
        }
    }
    std::vector<std::size_t> best;
    for (const std::size_t position : best_of(costs, count)) {
        best.push_back(within[position]);
    }
    std::stable_sort(outside.begin(), outside.end(),
                     [&excess](std::size_t a, std::size_t b) { return excess[a] < excess[b]; });
    outside.resize(std::min(outside.size(), count - best.size()));
    best.insert(best.end(), outside.begin(), outside.end());
    return best;
}

std::vector<Standing> standings_of(const std::vector<Goals>& goals) {
    std::vector<Standing> standings(goals.size());
    const std::vector<std::vector<std::size_t>> fronts = fronts_of(goals);
    for (std::size_t f = 0; f < fronts.size(); ++f) {
        const Crowd crowd(goals, fronts[f]);
        for (std::size_t place = 0; place < fronts[f].size(); ++place) {
            standings[fronts[f][place]] = {f, crowd.room(place)};
        }
    }
    return standings;
}

} // namespace degs::sim
