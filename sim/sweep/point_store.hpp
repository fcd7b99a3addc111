// SPDX-License-Identifier: Apache-2.0
// The folder of a study: a file for each finished point, written whole or not at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "sim/compare/run_summary.hpp"
#include "sim/failure.hpp"
#include "sim/output_folder.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {

/// What the runs of a point have found; the reports lie beside it.
struct StoredPoint {
    RunSummary frame;
    std::optional<RunSummary> path; ///< if the study has a camera path
};

/// Several processes may use the folder at once, on this machine or others: a point has the same
/// content whoever ran it.
class PointStore {
public:
    /// Creates the folder or goes on with it. Throws InputError if it holds another study, results
    /// of another kind, or cannot be written.
    PointStore(const std::string& folder, const StudyPlan& plan);

    const OutputFolder& folder() const { return folder_; }
    /// What is known of a point; empty if it has not been finished by this program and plan.
    std::optional<StoredPoint> read(std::size_t point) const;
    /// Why a point failed when it was last tried.
    std::optional<Failure> failure(std::size_t point) const;

    /// Writes the reports, then the point, which is finished with that.
    void keep(std::size_t point, const StoredPoint& found) const;
    void keep_failure(std::size_t point, const Failure& failure) const;
    /// The frame's report relative to the folder.
    static std::string report_of(std::size_t point);
    /// Removes what killed processes left half written. Nobody else may be writing.
    void sweep_up() const;

private:
    std::string heading() const;

    OutputFolder folder_, points_, reports_;
    std::string digest_;
};

} // namespace degs::sim
