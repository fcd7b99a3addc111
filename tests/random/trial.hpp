// SPDX-License-Identifier: Apache-2.0
// A drawn design with what it renders, in the words of `degs run`.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace degs::trials {

/// One `--set path=value`.
struct Change {
    std::string path, value;
};

struct Trial {
    std::string config; ///< name of a file in configs/
    std::vector<Change> changes;
    std::string scene; ///< synthetic:NAME,gaussians=N,seed=N
    int camera = 0;    ///< position in cameras.json of this folder
    int width = 1, height = 1;
    int frames = 1;
    double step_degrees = 0.5;
    std::optional<double> eyes; ///< distance, scene units: two views in each frame
    std::string foveation;      ///< as of --foveation; empty: none
    bool array_only = false;

    std::vector<std::string> overrides() const;
    /// Everything behind the name of the program that makes `degs run` do it, for a shell.
    std::string arguments() const;
};

} // namespace degs::trials
