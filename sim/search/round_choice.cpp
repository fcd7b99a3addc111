// SPDX-License-Identifier: Apache-2.0
#include "sim/search/round_choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "sim/goals/judgement.hpp"
#include "sim/search/hypervolume.hpp"
#include "sim/search/selection.hpp"

namespace degs::sim {
namespace {

constexpr double kOptimism = 1;     ///< deviations in favour of a design
constexpr double kMostOptimism = 2; ///< beyond which nobody is simulated
constexpr std::size_t kLooked = 64; ///< designs whose gain is computed
constexpr double kMargin = 0.1;     ///< of the range of a goal, beyond its worst value

class Choice {
public:
    Choice(const RoundFacts& facts, std::size_t count) : facts_(facts), count_(count) {
        for (const Columns& found : facts.front) {
            volume_.push_back(costs({found, std::vector<double>(found.size(), 0)}, 0));
        }
        set_worst();
    }

    /// Adds the designs that gain most if expectations are wrong by so many deviations.
    void add_gains(double optimism) {
        std::vector<std::size_t> pool = best(optimism, kLooked, false);
        while (chosen_.size() < count_ && !pool.empty()) {
            double most = 0;
            auto who = pool.end();
            for (auto p = pool.begin(); p != pool.end(); ++p) {
                const double gain = hypervolume_gain(volume_, at(*p, optimism), worst_);
                if (gain > most) {
                    most = gain;
                    who = p;
                }
            }
            if (who == pool.end()) {
                return;
            }
            volume_.push_back(at(*who, optimism));
            chosen_.insert(*who);
            pool.erase(who);
        }
    }

    void add_the_best() {
        for (const std::size_t prospect : best(0, count_ - chosen_.size(), true)) {
            chosen_.insert(prospect);
        }
    }

    std::vector<std::size_t> variants() const {
        std::vector<std::size_t> variants;
        for (const std::size_t prospect : chosen_) {
            variants.push_back(facts_.prospects[prospect].variant);
        }
        return variants;
    }

private:
    /// Logarithms, the smaller the better; nothing is known of what has none for any design.
    Goals costs(const Expectation& expected, double optimism) const {
        const std::vector<Aim>& goals = facts_.aims->goals;
        Goals costs;
        for (std::size_t g = 0; g < goals.size(); ++g) {
            const double sign = goals[g].better == Direction::Maximise ? -1 : 1;
            costs.push_back(sign * expected.columns[g].value_or(0) -
                            optimism * expected.deviations[g]);
        }
        return costs;
    }

    Goals at(std::size_t prospect, double optimism) const {
        return costs(facts_.prospects[prospect].expected, optimism);
    }

    double excess(std::size_t prospect, double optimism) const {
        const Aims& aims = *facts_.aims;
        double sum = 0;
        for (std::size_t l = 0; l < aims.limits.size(); ++l) {
            const std::size_t column = aims.goals.size() + l;
            const Expectation& expected = facts_.prospects[prospect].expected;
            const std::optional<double>& told = expected.columns[column];
            if (told && facts_.bounds[l]) {
                const double shift = (aims.limits[l].at_most ? -1 : 1) * optimism;
                const double value = std::exp(*told + shift * expected.deviations[column]);
                sum += holds(aims.limits[l], value, *facts_.bounds[l])
                           ? 0
                           : std::max(excess_of(value, *facts_.bounds[l]),
                                      std::numeric_limits<double>::min());
            }
        }
        return sum;
    }

    /// The best of those that are not chosen yet, in ascending order of places.
    std::vector<std::size_t> best(double optimism, std::size_t count, bool outside) const {
        std::vector<std::size_t> places;
        std::vector<Goals> values;
        std::vector<double> missed;
        for (std::size_t p = 0; p < facts_.prospects.size(); ++p) {
            const double by = excess(p, optimism);
            if (chosen_.count(p) == 0 && (outside || by == 0)) {
                places.push_back(p);
                values.push_back(at(p, optimism));
                missed.push_back(by);
            }
        }
        std::vector<std::size_t> best;
        for (const std::size_t position : best_within(values, missed, count)) {
            best.push_back(places[position]);
        }
        return best;
    }

    /// A little worse than everything, also beyond the limits, so that the ends of the front count.
    void set_worst() {
        std::vector<Goals> all = volume_;
        for (std::size_t p = 0; p < facts_.prospects.size(); ++p) {
            all.push_back(at(p, 0));
        }
        for (std::size_t g = 0; g < facts_.aims->goals.size(); ++g) {
            double low = std::numeric_limits<double>::infinity();
            double high = -low;
            for (const Goals& each : all) {
                low = std::min(low, each[g]);
                high = std::max(high, each[g]);
            }
            worst_.push_back(high + kMargin * std::max(high - low, kMargin));
        }
    }

    const RoundFacts& facts_;
    std::size_t count_;
    std::vector<Goals> volume_; ///< of the front and of what was chosen
    Goals worst_;
    std::set<std::size_t> chosen_; ///< prospects
};

} // namespace

std::vector<std::size_t> choose_round(const RoundFacts& facts, std::size_t count) {
    if (facts.prospects.empty()) {
        return {};
    }
    Choice choice(facts, count);
    if (facts.front.empty()) { // deviations say nothing yet
        choice.add_gains(0);
        choice.add_the_best();
    } else {
        choice.add_gains(kOptimism);
        choice.add_gains(kMostOptimism);
    }
    return choice.variants();
}

} // namespace degs::sim
