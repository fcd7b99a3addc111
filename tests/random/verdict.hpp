// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/process/child_process.hpp"
#include "tests/random/trial.hpp"

namespace degs::trials {

struct Limits {
    int seconds = 20;               ///< of processor time per run; more is a hang
    std::uint64_t megabytes = 4096; ///< of address space per run; 0: no limit
};

/// What became of a trial.
struct Verdict {
    std::string kind;     ///< empty: nothing is wrong; else what kind of failure, one word
    std::string sentence; ///< what is wrong, with the numbers
    std::uint64_t cycles = 0;
};

/// Runs trials, each twice and each run in a process of its own: as usual with all checks, and
/// strictly, of which every number and pixel must be the same. `ended` is called per trial in the
/// order of their ends. False if a signal stopped it.
bool run_trials(const std::vector<Trial>& trials, const std::string& configs,
                const std::string& cameras, const Limits& limits, int jobs,
                const std::function<void(std::size_t, const Verdict&)>& ended);

} // namespace degs::trials
