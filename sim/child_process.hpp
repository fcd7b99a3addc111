// SPDX-License-Identifier: Apache-2.0
// Work in processes of their own: SystemC elaborates once per process, and a fork shares scenes and
// workloads without copying them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/failure.hpp"

namespace degs::sim {

struct ChildJob {
    std::string name;                  ///< for error messages: "degs-64, camera 2"
    std::function<std::string()> work; ///< called in the child; what it returns comes back
};

/// What became of a job: its output, or why there is none.
struct ChildOutcome {
    std::string output;
    std::optional<Failure> failure; ///< its sentence begins with the name of the job
};

struct ChildWatcher {
    /// Called in this process when a job has ended, in the order of their ends.
    std::function<void(std::size_t job, ChildOutcome&& outcome)> ended;
    /// Called four times a second; may be empty.
    std::function<void(std::size_t jobs_ended, const std::vector<std::size_t>& running)> tick;
};

/// Runs every job in a forked child, at most `at_once` (at least 1) at a time, and returns when all
/// have ended. The child ends without running this process's destructors, exit handlers and stream
/// buffers; it is killed if this process dies. An exception, a signal and a child that ends by
/// itself become the failure of that job alone, and the others go on.
/// SIGINT and SIGTERM kill the children and make it return false; jobs that had not ended get no
/// call of `ended`. The caller has no other thread, since a fork copies only its own.
bool run_children(const std::vector<ChildJob>& jobs, int at_once, const ChildWatcher& watcher);

} // namespace degs::sim
