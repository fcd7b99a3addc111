// SPDX-License-Identifier: Apache-2.0
#include "sim/sampling/sampling_request.hpp"

#include <array>
#include <charconv>
#include <cmath>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

struct MeasureName {
    const char* name;
    const char* path; ///< in the report
};
/// The names that people use. All but `cycles` are what else a comparison of designs shows.
constexpr std::array<MeasureName, 5> kSampledMeasures{{{"cycles", "timing.cycles"},
                                                       {"useful", "slots.useful"},
                                                       {"utilization", "slots.utilization"},
                                                       {"dram", "dram.bytes_read"},
                                                       {"energy", "energy.total_nj"}}};

std::string path_of(const std::string& name) {
    std::string names;
    for (const MeasureName& measure : kSampledMeasures) {
        if (name == measure.name) {
            return measure.path;
        }
        names += (names.empty() ? "" : ", ") + std::string(measure.name);
    }
    throw InputError("--within names the measure '" + name + "', but must name one of " + names +
                     ".");
}

/// A percentage as a share, or nothing.
std::optional<double> share_of(const std::string& text) {
    double value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end - 1 || *rest != '%' || !std::isfinite(value)) {
        return {};
    }
    return value / 100;
}

} // namespace

SamplingRequest parse_within(const std::string& text) {
    const std::size_t colon = text.find(':');
    SamplingRequest request;
    if (colon != std::string::npos) {
        request.measure = path_of(text.substr(0, colon));
    }
    constexpr double kLeastSampled = 0.0001, kMostSampled = 0.5;
    const std::optional<double> share =
        share_of(colon == std::string::npos ? text : text.substr(colon + 1));
    if (!share || !(*share >= kLeastSampled && *share <= kMostSampled)) {
        throw InputError("--within is '" + text +
                         "', but must be a percentage from 0.01% to 50%, as in 1% or useful:2%.");
    }
    request.within = *share;
    return request;
}

std::optional<SamplingRequest> parse_sampled(const std::string& fidelity) {
    if (fidelity == "exact" || fidelity == "strict") {
        return {};
    }
    const std::string prefix = "sampled:";
    const std::optional<double> share = fidelity.compare(0, prefix.size(), prefix) == 0
                                            ? share_of(fidelity.substr(prefix.size()))
                                            : std::nullopt;
    if (!share || !(*share > 0 && *share < 1)) {
        throw InputError(
            "--fidelity is '" + fidelity +
            "', but must be exact, strict, analytic, or sampled: with a percentage of the tiles "
            "above 0% and below 100%, as in sampled:10%.");
    }
    SamplingRequest request;
    request.share = *share;
    return request;
}

std::optional<SamplingRequest> sampling_of(const std::string& fidelity,
                                           const std::optional<std::string>& within,
                                           std::uint64_t seed) {
    std::optional<SamplingRequest> request = parse_sampled(fidelity);
    if (within) {
        request = parse_within(*within);
    }
    if (request) {
        request->seed = seed;
    }
    return request;
}

} // namespace degs::sim
