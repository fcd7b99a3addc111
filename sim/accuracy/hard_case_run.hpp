// SPDX-License-Identifier: Apache-2.0
// Runs the hard cases through the reference and the data path of every number set.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "accuracy/hard/hard_cases.hpp"

namespace degs::sim {

struct HardCaseRequest {
    std::vector<std::string> only;        ///< "H1" ...; empty: all
    std::vector<std::string> sets;        ///< as numbers_of() reads them
    std::vector<std::string> resolutions; ///< of image_size(); names are 16:9
    std::string span_ends;                ///< for every set; empty: each set's own
    int tile_size = 32;                   ///< px
};

/// One number set on one case in one viewport, all windows together.
struct HardMeasure {
    std::string set, resolution;
    double psnr_db = 0; ///< infinite if equal
    double alpha_error_max = 0, max_abs_error = 0;
    std::uint64_t pixels = 0, nonfinite = 0;
    std::uint64_t recounted = 0; ///< pixels with another number of updates than the reference's
    std::uint64_t beyond = 0;    ///< pixels further off than the formats explain
    double alpha_bound = 0;      ///< on a fragment's alpha, of the scene with the widest
    bool bounded = false;        ///< the set has a bound, see tolerance_of()
    std::vector<std::string> problems; ///< sentences; none: the expectation holds
};

struct HardResult {
    const HardCase* hard = nullptr;
    std::vector<std::string> problems; ///< before a number set comes in: counts, order, files
    std::vector<std::string> notes;    ///< counted flips
    std::vector<HardMeasure> measures; ///< by resolution, then by set
    /// The expectations that do not hold; empty if all do.
    std::vector<std::string> failures() const;
};

/// `folder` is for files that are written and removed. Throws InputError for names that are not
/// known.
std::vector<HardResult> run_hard_cases(const HardCaseRequest& request, const std::string& folder);

/// Table for terminals, with a sentence for every expectation that does not hold.
std::string hard_case_table(const std::vector<HardResult>& results);
/// The table of docs/numerical-stability.md.
std::string hard_case_markdown(const std::vector<HardResult>& results);
/// hard_cases.json: a list of objects, one per case.
nlohmann::ordered_json hard_case_json(const std::vector<HardResult>& results);

} // namespace degs::sim
