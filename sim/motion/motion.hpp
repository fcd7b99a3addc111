// SPDX-License-Identifier: Apache-2.0
// What a head that moves sees of the latencies of single frames. docs/motion.md is the manual.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace degs::sim {

/// Frames of a path on a display of one refresh rate. Whoever renders takes the newest pose at a
/// refresh and begins, also if it is the pose of the frame before; the image appears with the first
/// refresh at which it is ready, and the next frame begins then.
struct DisplayResult {
    double hz = 0;
    int frames = 0;    ///< rendered while the path lasts
    int missed = 0;    ///< of these, not ready at the next refresh
    int refreshes = 0; ///< while the path lasts
    int repeated = 0;  ///< of these, with the image of a pose that was shown before
    // From the date of the pose to the middle of the refresh that shows it, ms.
    double photon_mean_ms = 0, photon_p95_ms = 0, photon_worst_ms = 0;

    /// Share of the refreshes.
    double new_images() const { return 1 - 1.0 * repeated / refreshes; }
};

/// Latencies of a design that so many percent of the frames do not exceed (nearest rank), ms.
struct LatencyRanks {
    double p50 = 0, p95 = 0, p99 = 0, worst = 0;
    std::size_t worst_frame = 0;
};

struct DesignMotion {
    std::string name;
    std::vector<std::optional<double>> ms;      ///< latency of each frame; none: its run has failed
    std::vector<std::optional<double>> bytes{}; ///< that each frame reads and writes; none:
                                                ///< likewise, or memory without limit
    std::optional<LatencyRanks> ranks{};        ///< of the frames that there are
    std::vector<DisplayResult> displays{};      ///< by rate; empty if a frame is missing
};

struct Motion {
    std::vector<double> times_s; ///< of the frames' poses, from 0 on, rising
    std::vector<double> rates_hz;
    std::vector<DesignMotion> designs;
};

/// The mean of the values that there are; nothing if there is none.
std::optional<double> mean_of_frames(const std::vector<std::optional<double>>& values);

/// The value that `share` of the values do not exceed; 0 < share <= 1. There is one at least.
double nearest_rank(std::vector<double> values, double share);

/// Ranks and displays of all designs, from the latencies.
void judge_motion(Motion& motion);

} // namespace degs::sim
