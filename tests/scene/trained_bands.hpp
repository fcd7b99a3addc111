// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "scene/scene_statistics.hpp"

namespace degs::test {

/// One measured number of a scene, e.g. "overview.fragments_per_pixel".
struct Measured {
    std::string name;
    double value;
};

inline void append(std::vector<Measured>& out, const std::string& name, const Quantiles& q) {
    out.push_back({name + ".p10", q.p10});
    out.push_back({name + ".p50", q.p50});
    out.push_back({name + ".p90", q.p90});
    out.push_back({name + ".p99", q.p99});
}

/// The numbers of docs/synthetic-scenes.md, in its order.
inline std::vector<Measured> measure_all(const Scene& scene) {
    std::vector<Measured> out;
    const SceneStatistics statistics = measure_scene(scene.cloud, scene.dropped);
    append(out, "anisotropy", statistics.anisotropy);
    append(out, "elongation", statistics.elongation);
    append(out, "opacity", statistics.opacity);
    out.push_back({"opaque", statistics.opaque_share});
    for (const Camera& camera : scene.cameras) {
        const ViewStatistics view = measure_view(scene.cloud, camera);
        out.push_back({camera.name + ".fragments", view.fragments_per_pixel});
        out.push_back({camera.name + ".candidates", view.candidates_per_pixel});
        out.push_back({camera.name + ".covered", view.covered_share});
        append(out, camera.name + ".footprint", view.footprint);
    }
    return out;
}

/// Smallest and largest value of a number among the trained scenes that a profile stands for.
struct Band {
    const char* name;
    double low, high;
};

/// skull, st-peter and guitar: captured objects on an empty background.
inline const std::vector<Band> kObjectBands{
    {"anisotropy.p10", 6.188, 11.95},
    {"anisotropy.p50", 34.27, 1.175e+05},
    {"anisotropy.p90", 332.5, 1.112e+06},
    {"anisotropy.p99", 1.54e+04, 2.538e+06},
    {"elongation.p10", 1.482, 1.567},
    {"elongation.p50", 4.128, 5.444},
    {"elongation.p90", 15.85, 23},
    {"elongation.p99", 60.24, 720.5},
    {"opacity.p10", 0.02745, 0.0549},
    {"opacity.p50", 0.1647, 0.302},
    {"opacity.p90", 0.7804, 0.9765},
    {"opacity.p99", 0.9569, 1},
    {"opaque", 0.04409, 0.1751},
    {"overview.fragments", 7.912, 17.81},
    {"overview.candidates", 17.72, 36.31},
    {"overview.covered", 0.08715, 0.2055},
    {"overview.footprint.p10", 3.531, 4.854},
    {"overview.footprint.p50", 5.575, 8.631},
    {"overview.footprint.p90", 12.34, 18.02},
    {"overview.footprint.p99", 25.39, 38.67},
    {"near.fragments", 6.442, 32.47},
    {"near.candidates", 17.25, 51.59},
    {"near.covered", 0.06961, 0.3071},
    {"near.footprint.p10", 4.653, 7.821},
    {"near.footprint.p50", 9.468, 16.13},
    {"near.footprint.p90", 24.83, 39.19},
    {"near.footprint.p99", 59.79, 89.26},
    {"closeup.fragments", 17.03, 72.51},
    {"closeup.candidates", 26.47, 157.2},
    {"closeup.covered", 0.2296, 0.7761},
    {"closeup.footprint.p10", 7.649, 15.81},
    {"closeup.footprint.p50", 17.54, 42.34},
    {"closeup.footprint.p90", 43.02, 125.3},
    {"closeup.footprint.p99", 122.5, 263.5},
};

/// flowers and seal: outdoors, with surroundings.
inline const std::vector<Band> kOutdoorBands{
    {"anisotropy.p10", 4.535, 5.59},
    {"anisotropy.p50", 19.12, 20.63},
    {"anisotropy.p90", 71.78, 88.12},
    {"anisotropy.p99", 252.8, 307.9},
    {"elongation.p10", 1.372, 1.481},
    {"elongation.p50", 2.937, 4.228},
    {"elongation.p90", 9.025, 17.98},
    {"elongation.p99", 26.92, 46.9},
    {"opacity.p10", 0.1294, 0.302},
    {"opacity.p50", 0.4196, 0.8471},
    {"opacity.p90", 0.9569, 0.9961},
    {"opacity.p99", 0.9961, 0.9961},
    {"opaque", 0.156, 0.4318},
    {"overview.fragments", 13.27, 17.42},
    {"overview.candidates", 23.74, 30.55},
    {"overview.covered", 0.2927, 0.3351},
    {"overview.footprint.p10", 3.808, 3.844},
    {"overview.footprint.p50", 4.917, 6.382},
    {"overview.footprint.p90", 8.217, 13.8},
    {"overview.footprint.p99", 15.79, 37.01},
    {"near.fragments", 17.52, 19.1},
    {"near.candidates", 27.44, 36.32},
    {"near.covered", 0.3165, 0.4018},
    {"near.footprint.p10", 5.105, 5.206},
    {"near.footprint.p50", 8.183, 11.26},
    {"near.footprint.p90", 17.07, 30.12},
    {"near.footprint.p99", 39.84, 81.58},
    {"closeup.fragments", 26.27, 26.4},
    {"closeup.candidates", 41.05, 56.54},
    {"closeup.covered", 0.3905, 0.597},
    {"closeup.footprint.p10", 10.89, 11.05},
    {"closeup.footprint.p50", 24.5, 24.81},
    {"closeup.footprint.p90", 67.31, 78.76},
    {"closeup.footprint.p99", 145.3, 220.2},
};

} // namespace degs::test
