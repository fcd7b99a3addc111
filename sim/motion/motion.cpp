// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs::sim {
namespace {

// Dates of refreshes and poses are quotients: equal ones may differ by rounding.
constexpr double kDateRounding = 1e-9;

/// The newest pose at a time.
std::size_t pose_before(const std::vector<double>& times, double time_s) {
    const auto later = std::upper_bound(times.begin(), times.end(), time_s + kDateRounding);
    return later == times.begin() ? 0 : later - times.begin() - 1;
}

/// How long the path lasts: the last pose stays as long as the one before.
double duration_of(const std::vector<double>& times) {
    const std::size_t count = times.size();
    return count < 2 ? 0 : times.back() + (times.back() - times[count - 2]);
}

DisplayResult shown_at(const std::vector<double>& times, const std::vector<double>& ms, double hz) {
    DisplayResult result;
    result.hz = hz;
    const double period_ms = 1e3 / hz;
    const double refreshes = std::floor(duration_of(times) * hz + kDateRounding);
    result.refreshes = std::max(1, static_cast<int>(refreshes));
    std::vector<double> photons;
    std::optional<std::size_t> shown;
    int images = 0; // of poses that were not shown before
    for (double refresh = 0; refresh < result.refreshes;) {
        const std::size_t pose = pose_before(times, refresh / hz);
        const double age_ms = std::max(refresh / hz - times[pose], 0.0) * 1e3;
        const double latency = ms[pose];
        const double periods = std::max(std::ceil(latency / period_ms - kDateRounding), 1.0);
        ++result.frames;
        result.missed += periods > 1 ? 1 : 0;
        photons.push_back(age_ms + (periods + 0.5) * period_ms);
        images += shown == pose ? 0 : 1;
        shown = pose;
        refresh += periods;
    }
    result.repeated = result.refreshes - images;
    for (const double photon : photons) {
        result.photon_mean_ms += photon / result.frames;
    }
    result.photon_p95_ms = nearest_rank(photons, 0.95);
    result.photon_worst_ms = nearest_rank(photons, 1);
    return result;
}

void judge(DesignMotion& design, const Motion& motion) {
    std::vector<double> known;
    LatencyRanks ranks;
    for (std::size_t frame = 0; frame < design.ms.size(); ++frame) {
        if (design.ms[frame]) {
            known.push_back(*design.ms[frame]);
            if (known.back() > ranks.worst) {
                ranks.worst = known.back();
                ranks.worst_frame = frame;
            }
        }
    }
    design.ranks.reset();
    design.displays.clear();
    if (known.empty()) {
        return;
    }
    ranks.p50 = nearest_rank(known, 0.5);
    ranks.p95 = nearest_rank(known, 0.95);
    ranks.p99 = nearest_rank(known, 0.99);
    design.ranks = ranks;
    if (known.size() == motion.times_s.size()) {
        for (const double hz : motion.rates_hz) {
            design.displays.push_back(shown_at(motion.times_s, known, hz));
        }
    }
}

} // namespace

std::optional<double> mean_of_frames(const std::vector<std::optional<double>>& values) {
    double sum = 0;
    std::size_t count = 0;
    for (const std::optional<double>& value : values) {
        sum += value.value_or(0);
        count += value ? 1 : 0;
    }
    return count == 0 ? std::nullopt : std::optional(sum / real_of(count));
}

double nearest_rank(std::vector<double> values, double share) {
    const long rank = std::lround(std::ceil(share * real_of(values.size()) - kDateRounding));
    const auto place = values.begin() + (std::max(rank, 1L) - 1);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

void judge_motion(Motion& motion) {
    for (DesignMotion& design : motion.designs) {
        judge(design, motion);
    }
}

} // namespace degs::sim
