// SPDX-License-Identifier: Apache-2.0
// Speed of a run against its error: every fidelity in every number set, measured against the run
// that leaves nothing out, `strict` in double precision.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "sim/design/run_config.hpp"
#include "sim/study/compare_request.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {

/// A design with a number set in place of its own.
struct SpeedDesign {
    std::string accelerator; ///< what the user calls the design
    std::string numbers;     ///< as pipeline.numbers says them
    RunConfig config;
};

struct SpeedRequest {
    /// The designs, one accelerator after the other; the first of each accelerator computes in
    /// `ideal`.
    std::vector<SpeedDesign> designs;
    std::vector<std::string> fidelities; ///< as SpeedFidelity reads them
    std::uint64_t seeds = 1;             ///< of each sample: 1 to this
    ViewRequest view;
};

/// "strict", "exact", "analytic", "sampled:10%" or "within:1%".
struct SpeedFidelity {
    std::string name;
    bool analytic = false; ///< no simulation
    Fidelity fidelity = Fidelity::Exact;
    std::optional<SamplingRequest> sampling;
};
/// Throws InputError.
SpeedFidelity speed_fidelity(const std::string& name);

/// The designs of all configurations, which are words as load_configs() reads them with their
/// overrides, in `ideal` and in every named set, or without names in `fp32` and in their own.
/// Throws InputError.
std::vector<SpeedDesign> speed_designs(const std::vector<std::string>& configs,
                                       const std::vector<std::string>& overrides,
                                       const std::vector<std::string>& numbers,
                                       const std::string& memory = "");

/// One run. Errors are those against the run of the same design in `strict` and `ideal`.
struct SpeedRow {
    std::string accelerator, fidelity, numbers;
    std::optional<std::uint64_t> seed; ///< of a sample
    double sim_s = 0;                  ///< host.run_s of the report
    double over_render = 0;     ///< sim_s over the time of the reference image on one processor
    double fragments_per_s = 0; ///< fragments of the reference image per second of sim_s
    double cycles = 0;
    double cycles_error = 0;          ///< relative
    double utilization_error = 0;     ///< difference of the shares
    std::optional<double> dram_error; ///< relative, of all bytes; empty with unlimited memory
    bool identical = false;           ///< the images are; psnr_db is empty then
    std::optional<double> psnr_db;    ///< empty without a whole image
    std::optional<double> share;      ///< of the tiles, if the numbers come from a sample
    std::optional<double> interval_low, interval_high; ///< 95 %, of the cycles
};

/// What all rows have in common.
struct SpeedView {
    std::string scene;
    int camera = 0, width = 0, height = 0;
    std::uint64_t fragments = 0; ///< of the reference image of the first design
};

struct SpeedResult {
    SpeedView view;
    std::vector<SpeedRow> rows;
};

/// One run after the other, each in a process of its own. Throws InputError for mistakes and
/// FailureError if a run fails.
SpeedResult measure_speed(const SpeedRequest& request);

/// The rows of one accelerator, fidelity and number set, which differ in the seed alone.
struct SpeedGroup {
    std::string accelerator, fidelity, numbers;
    std::size_t runs = 0, sampled = 0; ///< the others were exact in the place of a sample
    std::size_t held =
        0; ///< sampled runs whose interval holds the cycles of exact in the same numbers
    double over_render = 0, fragments_per_s = 0,
           cycles_error = 0;          ///< medians, the error without sign
    double utilization_error = 0;     ///< median, without sign
    std::optional<double> dram_error; ///< median, without sign
    bool identical = false;
    std::optional<double> psnr_db;
};
/// In the order of the rows.
std::vector<SpeedGroup> speed_groups(const std::vector<SpeedRow>& rows);

/// A table for terminals: a line per group.
std::string speed_table(const SpeedResult& result);
/// speed.json: the view, the rows, and what the intervals of each group held.
nlohmann::ordered_json speed_json(const SpeedResult& result);
/// Error of the cycles over the time of a run, a panel per accelerator, a line per number set.
std::string speed_svg(const SpeedResult& result);

} // namespace degs::sim
