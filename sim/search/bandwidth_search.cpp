// SPDX-License-Identifier: Apache-2.0
#include "sim/search/bandwidth_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/grouped_number.hpp"
#include "config/config_document.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kBandwidthStep = 1.1; ///< from one bandwidth to the next
constexpr double kLittleGain = 1;      ///< percent that 10 % more gain where memory limits no more
constexpr double kMostBandwidthTimes = 64; ///< of the design's own bandwidth, and its inverse
constexpr std::size_t kEstimated = 3;      ///< one bandwidth in so many is estimated
constexpr std::size_t kMostJump = 16;      ///< steps
constexpr std::size_t kUsualJump = 4;      ///< where estimates do not say how far it is

/// The keys of a design by path, with their values as YAML has them.
std::map<std::string, std::string> values_of(const RunConfig& design) {
    std::map<std::string, std::string> values;
    for (const KeyDoc& key : document(design)) {
        values[key.path] = key.default_value;
    }
    return values;
}

/// GB/s of an LPDDR5 memory at 1 MT/s; see Timing::peak_gb_per_s().
double peak_per_data_rate(const std::map<std::string, std::string>& values) {
    const auto number = [&values](const std::string& key) {
        return std::strtod(values.at("memory.lpddr5." + key).c_str(), nullptr);
    };
    const double length = number("timing.burst_length"), data = number("timing.burst_data_bytes");
    const double bytes = data > 0 ? data : number("timing.pins") * length / 8;
    return number("channels") * bytes / length / 1000;
}

/// Percent that each of the steps from one position to another gains.
double gain(double before, double after, std::size_t steps) {
    return 100 * (std::pow(before / after, 1.0 / static_cast<double>(steps)) - 1);
}

/// By position, as far as two latencies are known that lie `apart` steps from each other.
std::map<std::size_t, double> gains_of(const std::map<std::size_t, double>& latencies,
                                       std::size_t apart) {
    std::map<std::size_t, double> gains;
    for (const auto& [position, latency] : latencies) {
        const auto next = latencies.find(position + apart);
        if (next != latencies.end()) {
            gains[position] = gain(latency, next->second, apart);
        }
    }
    return gains;
}

/// The last position that gains much, and the first behind it that does not.
struct Bracket {
    std::optional<std::size_t> much, little;
};

Bracket bracket_of(const std::map<std::size_t, double>& gains) {
    Bracket bracket;
    for (const auto& [position, percent] : gains) {
        if (percent >= kLittleGain) {
            bracket = {position, std::nullopt};
        } else if (!bracket.little) {
            bracket.little = position;
        }
    }
    return bracket;
}

} // namespace

BandwidthSteps bandwidth_steps(const RunConfig& design) {
    const std::map<std::string, std::string> values = values_of(design);
    const bool bus = values.at("memory.model") != "lpddr5";
    const std::string key =
        bus ? "memory.bandwidth_gb_per_s" : "memory.lpddr5.timing.data_rate_mt_per_s";
    BandwidthSteps steps;
    steps.axis = {key, "'degs bandwidth'", {key}, {}};
    const double own = std::strtod(values.at(key).c_str(), nullptr);
    const double per_unit = bus ? 1 : peak_per_data_rate(values);
    constexpr double kLeast = 533, kMost = 32000; // MT/s, of the key
    const int most = static_cast<int>(std::log(kMostBandwidthTimes) / std::log(kBandwidthStep));
    for (int i = -most; i <= most; ++i) {
        const double wanted = own * std::pow(kBandwidthStep, i);
        const double value = bus ? std::round(wanted * 1e4) / 1e4 : std::round(wanted);
        if (bus ? value <= 0 || value > 1e5 : value < kLeast || value > kMost) {
            continue;
        }
        steps.gb_per_s.push_back(value * per_unit);
        steps.axis.positions.push_back({AxisValue{steps.axis.place, decimal_text(value), {}, {}}});
    }
    return steps;
}

BandwidthSearch::BandwidthSearch(DesignSpace& space, const StudyPlan& plan,
                                 const BandwidthSteps& steps)
    : space_(space), plan_(plan), steps_(steps) {}

std::optional<std::size_t> BandwidthSearch::variant_of(std::size_t position) {
    return space_.add({0, position}).variant;
}

/// With all positions that ran before it in this way.
Step BandwidthSearch::step_of(const std::vector<std::size_t>& positions, PartRuns runs) {
    asked_.clear();
    const Latencies& before = runs == PartRuns::Estimates ? estimated_ : found_;
    for (const auto& [position, latency] : before) {
        asked_[variant_of(position).value()] = position;
    }
    for (const std::size_t position : positions) {
        if (const std::optional<std::size_t> variant = variant_of(position)) {
            asked_[*variant] = position;
        }
    }
    Step step;
    step.runs = runs;
    step.folder = runs == PartRuns::Estimates && !plan_.request.analytic ? "estimates" : "";
    step.variants = {plan_.baseline};
    for (const auto& [variant, position] : asked_) {
        step.variants.push_back(variant);
    }
    std::sort(step.variants.begin(), step.variants.end());
    step.variants.erase(std::unique(step.variants.begin(), step.variants.end()),
                        step.variants.end());
    return step;
}

std::optional<Step> BandwidthSearch::next() {
    const bool has_model =
        plan_.request.configs[plan_.baseline].config.accelerator().analytic() != nullptr;
    if (estimated_.empty() && found_.empty() && !estimating_ && has_model &&
        !plan_.request.array_only) {
        estimating_ = true;
        std::vector<std::size_t> positions;
        for (std::size_t p = 0; p < steps_.gb_per_s.size(); p += kEstimated) {
            positions.push_back(p);
        }
        return step_of(positions, PartRuns::Estimates);
    }
    estimating_ = false;
    return next_simulations();
}

std::optional<Step> BandwidthSearch::run_at(std::size_t position) {
    const std::size_t most = steps_.gb_per_s.size() - 1;
    std::vector<std::size_t> positions{std::min(position, most - 1)};
    positions.push_back(positions.front() + 1);
    if (found_.empty() && positions.back() < most) {
        positions.push_back(positions.back() + 1); // the threshold is likely to lie between
    }
    const bool is_new = std::any_of(positions.begin(), positions.end(),
                                    [this](std::size_t p) { return tried_.insert(p).second; });
    if (!is_new) {
        threshold_.none =
            "Simulations at " + three_digits(steps_.gb_per_s[positions.front()]) + " GB/s failed.";
        return {};
    }
    return step_of(positions, PartRuns::AsPlanned);
}

std::optional<Step> BandwidthSearch::next_simulations() {
    const std::size_t last = steps_.gb_per_s.size() - 2; // from which a step leads on
    const std::map<std::size_t, double> estimates = gains_of(estimated_, kEstimated);
    const Bracket expected = bracket_of(estimates);
    // By what part gains fall with each step where the estimates cross the line.
    double fall = 0;
    if (expected.much && expected.little) {
        const double before = estimates.at(*expected.much);
        const double after = std::max(estimates.at(*expected.little), kLittleGain / 100);
        fall = std::log(before / after) / static_cast<double>(*expected.little - *expected.much);
        const double part = std::log(before / kLittleGain) / std::log(before / after);
        const double apart = static_cast<double>(*expected.little - *expected.much);
        // A gain over several steps belongs to their middle.
        threshold_.estimated = steps_.gb_per_s[*expected.much] *
                               std::pow(kBandwidthStep, 0.5 * kEstimated + part * apart);
    }
    const std::map<std::size_t, double> gains = gains_of(found_, 1);
    if (gains.empty()) {
        if (!found_.empty()) {
            threshold_.none = "Simulations failed.";
            return {};
        }
        std::size_t start = last / 2;
        if (threshold_.estimated) {
            const auto at = std::lower_bound(steps_.gb_per_s.begin(), steps_.gb_per_s.end(),
                                             *threshold_.estimated / kBandwidthStep);
            start = static_cast<std::size_t>(at - steps_.gb_per_s.begin());
        } else if (!estimates.empty()) {
            start = expected.much ? last : 0;
        }
        return run_at(std::min(start, last));
    }
    const Bracket found = bracket_of(gains);
    const auto jump = [&](double percent) {
        const double steps = fall > 0
                                 ? std::abs(std::log(std::max(percent, 0.1) / kLittleGain)) / fall
                                 : static_cast<double>(kUsualJump);
        return static_cast<std::size_t>(
            std::clamp(std::round(steps), 1.0, static_cast<double>(kMostJump)));
    };
    if (found.much && found.little) {
        if (*found.little == *found.much + 1) {
            conclude(*found.much, *found.little);
            return {};
        }
        return run_at((*found.much + *found.little) / 2);
    }
    const std::string gain_words = " GB/s, 10 % more bandwidth gain ";
    if (found.much) {
        if (*found.much == last) {
            threshold_.none =
                "Even at " + three_digits(steps_.gb_per_s[last]) + gain_words + "1 % or more.";
            return {};
        }
        return run_at(std::min(last, *found.much + jump(gains.at(*found.much))));
    }
    if (*found.little == 0) {
        threshold_.none =
            "Already at " + three_digits(steps_.gb_per_s[0]) + gain_words + "less than 1 %.";
        return {};
    }
    const std::size_t back = jump(gains.at(*found.little));
    return run_at(*found.little > back ? *found.little - back : 0);
}

/// The gain of a step belongs to its middle, in the logarithm of the bandwidth.
void BandwidthSearch::conclude(std::size_t low, std::size_t high) {
    const std::map<std::size_t, double> gains = gains_of(found_, 1);
    const double part = (gains.at(low) - kLittleGain) / (gains.at(low) - gains.at(high));
    const double middle = std::sqrt(kBandwidthStep);
    threshold_.low = steps_.gb_per_s[low] * middle;
    threshold_.high = steps_.gb_per_s[high] * middle;
    threshold_.gb_per_s = threshold_.low * std::pow(threshold_.high / threshold_.low, part);
    threshold_.latency_ms = found_.at(high);
}

void BandwidthSearch::take(const StepResults& results) {
    Latencies& latencies = estimating_ ? estimated_ : found_;
    for (const Candidate& candidate : results.candidates) {
        const auto asked = asked_.find(candidate.variant);
        if (asked != asked_.end() && candidate.verdict.goals.front()) {
            latencies[asked->second] = *candidate.verdict.goals.front();
        }
    }
    threshold_.simulated = found_.size();
    if (!estimating_) {
        results_ = results;
    }
}

} // namespace degs::sim
