// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "base/ratio.hpp"
#include "stats/statistics.hpp"

namespace degs {

/// Durations in ns, kept as counts: the mean is exact, percentiles are right to 1/32 of their value
/// (and to 1/32 ns below one). Adding a sample costs one increment.
class LatencyHistogram {
public:
    void add(double ns) {
        ++counts_[bucket_of(ns)];
        ++samples_;
        sum_ns_ += ns;
        largest_ns_ = ns > largest_ns_ ? ns : largest_ns_;
    }
    void add(const LatencyHistogram& other) {
        for (std::size_t b = 0; b < kBuckets; ++b) {
            counts_[b] += other.counts_[b];
        }
        samples_ += other.samples_;
        sum_ns_ += other.sum_ns_;
        largest_ns_ = other.largest_ns_ > largest_ns_ ? other.largest_ns_ : largest_ns_;
    }
    std::uint64_t samples() const { return samples_; }
    double mean_ns() const { return mean_of(sum_ns_, samples_); }
    double largest_ns() const { return largest_ns_; }
    /// The smallest value that `share` (0 .. 1) of the samples do not exceed; 0 without samples.
    double percentile_ns(double share) const {
        const std::uint64_t wanted = std::llround(std::ceil(share * static_cast<double>(samples_)));
        std::uint64_t seen = 0;
        for (std::size_t b = 0; b < kBuckets; ++b) {
            seen += counts_[b];
            if (counts_[b] != 0 && seen >= wanted) {
                const double upper = upper_end(b);
                return upper < largest_ns_ ? upper : largest_ns_;
            }
        }
        return largest_ns_;
    }
    /// The two numbers that stand for the whole: mean and 95th percentile.
    void describe_summary(StatsVisitor& v) const {
        v.real("mean", mean_ns(), "ns", "Mean.");
        v.real("p95", percentile_ns(0.95), "ns", "95th percentile, right to 1/32 of its value.");
    }
    void describe(StatsVisitor& v) const {
        v.real("mean", mean_ns(), "ns", "Mean.");
        v.real("p50", percentile_ns(0.5), "ns", "Median, right to 1/32 of its value.");
        v.real("p95", percentile_ns(0.95), "ns", "95th percentile, right to 1/32 of its value.");
        v.real("p99", percentile_ns(0.99), "ns", "99th percentile, right to 1/32 of its value.");
        v.real("max", largest_ns(), "ns", "Longest.");
        v.count("samples", samples(), "requests", "Requests that were measured.");
    }

private:
    // 32 buckets per power of two of 1/32 ns.
    static constexpr unsigned kSubBits = 5;
    static constexpr int kPerNs = 32;
    static constexpr std::size_t kBuckets = (64 - kSubBits) << kSubBits;

    static std::size_t bucket_of(double ns) {
        const auto value = static_cast<std::uint64_t>(ns * kPerNs);
        if (value < (std::uint64_t{1} << kSubBits)) {
            return value;
        }
        const unsigned top = 63U - __builtin_clzll(value);
        const unsigned shift = top - kSubBits;
        return (std::size_t{shift} << kSubBits) + (value >> shift);
    }
    static double upper_end(std::size_t bucket) {
        if (bucket < (std::size_t{2} << kSubBits)) {
            return ratio_of(bucket + 1, kPerNs);
        }
        const int shift = static_cast<int>(bucket >> kSubBits) - 1;
        const std::size_t mantissa = bucket - (shift << kSubBits) + 1;
        return std::ldexp(ratio_of(mantissa, kPerNs), shift);
    }

    std::array<std::uint64_t, kBuckets> counts_{};
    std::uint64_t samples_ = 0;
    double sum_ns_ = 0;
    double largest_ns_ = 0;
};

} // namespace degs
