// SPDX-License-Identifier: Apache-2.0
// What the options --within, --fidelity sampled:P and --seed ask for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace degs::sim {

/// A run that simulates a sample of the tiles. Exactly one of `within` and `share` is not 0.
struct SamplingRequest {
    double within = 0; ///< half of the 95 % interval over the value: 0.01 is 1 %
    double share = 0;  ///< of the tiles
    std::string measure = "timing.cycles"; ///< that `within` is about, a path of the report
    std::uint64_t seed = 1;
};

/// "1%", or "MEASURE:1%" with one of the names that the message of any other lists. Throws
/// InputError.
SamplingRequest parse_within(const std::string& text);
/// "sampled:10%" asks for a share, "exact" and "strict" for none. Throws InputError for others.
std::optional<SamplingRequest> parse_sampled(const std::string& fidelity);

/// What the seed and one of the two options ask for; nothing if neither asks for a sample. Throws
/// InputError.
std::optional<SamplingRequest> sampling_of(const std::string& fidelity,
                                           const std::optional<std::string>& within,
                                           std::uint64_t seed);

} // namespace degs::sim
