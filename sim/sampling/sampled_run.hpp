// SPDX-License-Identifier: Apache-2.0
// One frame from a sample of its tiles: preprocessing as it is, then groups of blocks of tiles
// until the estimate is good enough. docs/sampling.md explains the method.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/kit/accelerator/render_engine.hpp"
#include "sim/sampling/sampling_request.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

/// The 95 % interval of a number of the report.
struct ReportInterval {
    std::string path; ///< "timing.cycles"
    double low = 0, high = 0;
};

/// What a sampled run has simulated, and how far its numbers can be trusted.
struct SamplingFacts {
    SamplingRequest request;
    std::size_t tiles = 0;     ///< that list a splat
    std::size_t measured = 0;  ///< of them in the sample
    std::size_t simulated = 0; ///< with those that warm up the pipeline, which may come twice
    std::size_t groups = 0;
    std::size_t looks = 0; ///< at the interval; 0 if a share was asked for
    double reached = 0;    ///< half of the interval of request.measure over its value
    std::vector<ReportInterval> intervals;
    const ReportInterval* interval_of(const std::string& path) const; ///< null: there is none
    std::string refusal; ///< why there is no sample: a sentence, or empty
    std::string warning; ///< that the interval is wider than was asked for: a sentence, or empty
};

struct SampledResult {
    AcceleratorResult
        result; ///< of the whole frame, as estimated; the image of the simulated tiles
    SamplingFacts facts;
};

/// May be called once per process. A refusal comes before anything is simulated, and leaves a
/// result that must not be used.
SampledResult run_sampled(const AcceleratorConfig& config, const FrameWorkload& frame,
                          Fidelity fidelity, const BuildOptions& options,
                          const SamplingRequest& request, Progress& progress);

} // namespace degs::sim
