// SPDX-License-Identifier: Apache-2.0
// What bandwidth is worth to the designs of a study that varies it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/results/comparison.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// The bus with the largest bandwidth that a configuration can have takes no time for a frame.
constexpr double kUnlimitedGbPerS = 1e5;

/// A curve goes along one axis of memory, the first of these that the study varies: the bandwidth
/// of a bus; the channels, the data rate, or the file of an LPDDR5 memory; the keys of memory that
/// are linked with it change along, too. All other keys, and the model of the memory, are the same
/// in all of its points.

/// What 10 % more bandwidth gains, percent.
struct Elasticity {
    double gain = 0;
    /// 95 % interval if a neighbour was sampled, 90 % if both were estimated; empty: exact runs.
    std::optional<double> low{}, high{};
};

/// The elasticities of the rows: by interpolation between the neighbouring
/// points of the same design in the logarithms of bandwidth and latency, and empty at the ends.
/// Without any entry if the study does not vary the bandwidth, and empty in a line that has two
/// latencies at one bandwidth, because it is no function of it.
std::vector<std::optional<Elasticity>> elasticities(const StudyPlan& plan,
                                                    const Comparison& comparison);

/// One point of a curve.
struct BandwidthPoint {
    double gb_per_s = 0, latency_ms = 0;
    std::optional<double> preprocessing_ms, blending_ms;
    std::optional<Elasticity> elasticity; ///< as elasticities()
};

/// A design on a view, by bandwidth.
struct BandwidthCurve {
    std::string label;  ///< the design and the values of the keys by which the curves differ
    std::string memory; ///< its name, or the model if that changes along the curve
    std::size_t view = 0;
    std::vector<BandwidthPoint> points;         ///< from the least bandwidth to the most
    std::optional<double> unlimited_latency_ms; ///< with kUnlimitedGbPerS
    /// From which 10 % more gains less than 1 %, by interpolation between the points.
    std::optional<double> enough_gb_per_s;
};

/// The curves of at least two bandwidths.
std::vector<BandwidthCurve> bandwidth_curves(const StudyPlan& plan, const Comparison& comparison);

/// bandwidth.svg; empty if the study does not vary the bandwidth.
std::string bandwidth_picture(const StudyPlan& plan, const Comparison& comparison);

} // namespace degs::sim
