// SPDX-License-Identifier: Apache-2.0
// How far a comparison is: a status line on a terminal, else a line per finished run.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/process/stopwatch.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {

class RunProgress {
public:
    /// `what` is counted: "run" or "point".
    explicit RunProgress(std::string what = "run") : what_(std::move(what)) {}
    /// Counts as ended what earlier sessions have done.
    void resume(std::size_t ended) { ended_ = before_ = ended; }

    /// Adds runs that are going to be made.
    void plan(std::size_t runs) { planned_ += runs; }
    /// Takes back runs that are not possible.
    void drop(std::size_t runs) { planned_ -= runs; }
    /// Scenes whose number of runs is not known before they have been loaded.
    void set_unknown_scenes(std::size_t scenes) { unknown_scenes_ = scenes; }

    /// A run has ended after `seconds`; printed if there is no terminal.
    void ended(const std::string& name, double seconds, bool good);
    /// Shown if there is a terminal; at least one run is running.
    void show(const std::vector<std::string>& running);
    /// Removes the line from the terminal until it is shown again.
    void clear() { line_.clear(); }
    /// "3 of 12 runs", or "3 of at least 12 runs".
    std::string words() const;

private:
    std::string left() const;

    std::string what_;
    std::size_t planned_ = 0;
    std::size_t before_ = 0; ///< ended in earlier sessions
    std::size_t ended_ = 0;
    std::size_t unknown_scenes_ = 0;
    Stopwatch clock_;
    StatusLine line_;
};

} // namespace degs::sim
