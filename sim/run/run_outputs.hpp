// SPDX-License-Identifier: Apache-2.0
// The files of a run: kept from the start for it, written when its result is there.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "sim/run/run_options.hpp"
#include "sim/shell/output_folder.hpp"
#include "sim/simulation/run_result.hpp"

namespace degs::sim {

class RunOutputs {
public:
    /// Claims all files, with those of `images` images, before anything long starts. Throws
    /// InputError if one cannot be written.
    RunOutputs(const RunFiles& files, int images);
    /// What the run must record for them.
    Recording recording();
    /// The result of `simulate`, which sends the requests to memory to the listener, if there is
    /// one. All files are there when it is over, or those of the run before if it throws.
    RunResult write(const RunConfig& config,
                    const std::function<RunResult(RequestListener* requests)>& simulate);
    std::string image() const { return out_.path("image.exr"); }

private:
    RunResult traced(const RunConfig& config,
                     const std::function<RunResult(RequestListener* requests)>& simulate) const;
    void write(const RunConfig& config, const RunResult& result) const;

    RunFiles files_;
    int images_;
    OutputFolder out_;
    std::optional<OutputFolder> maps_;
    EventLog log_;
};

/// Files that an earlier run left in `out` and that a run of `images` images does not write:
/// further images, and maps of tiles, those in the folder `maps` among them if there is one.
std::vector<std::string> files_of_earlier_run(const OutputFolder& out,
                                              const std::optional<OutputFolder>& maps, int images);

} // namespace degs::sim
