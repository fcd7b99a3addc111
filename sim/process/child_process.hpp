// SPDX-License-Identifier: Apache-2.0
// Work in processes of their own: SystemC elaborates once per process, and a fork shares scenes and
// workloads without copying them.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/process/failure.hpp"

namespace degs::sim {

class StoppingSignals;

struct ChildJob {
    std::string name;                  ///< for error messages: "degs-64, camera 2"
    std::function<std::string()> work; ///< called in the child; what it returns comes back
};

/// The result of a job: its output, or the reason why it has none.
struct ChildOutcome {
    std::string output;
    std::optional<Failure> failure; ///< the sentence begins with the name of the job
};

struct ChildWatcher {
    /// Called in this process when a job has ended, in the order of their ends.
    std::function<void(std::size_t job, ChildOutcome&& outcome)> ended;
    /// Called four times a second; may be empty.
    std::function<void(std::size_t jobs_ended, const std::vector<std::size_t>& running)> tick;
};

/// Runs jobs in forked children, a bounded number at a time. A child ends without running this
/// process's destructors, exit handlers and stream buffers; it is killed if this process dies. An
/// exception, a signal and a child that ends by itself become the failure of that job alone, and
/// the others go on. The caller has no other thread, since a fork copies only its own.
///
/// SIGINT and SIGTERM that arrive during a call kill the children and make it return false; jobs
/// that had not ended get no call of `ended`. Between calls they act as elsewhere.
class ChildPool {
public:
    /// At most `at_once` (at least 1) children at a time; `watcher` is called during the calls
    /// below.
    ChildPool(int at_once, ChildWatcher watcher);
    ~ChildPool(); ///< kills the children
    ChildPool(const ChildPool&) = delete;
    ChildPool& operator=(const ChildPool&) = delete;

    /// Waits until another child may start: what this process does then is one of the `at_once`
    /// things that are done at a time.
    bool make_room();
    /// Waits for room and starts the job, whose number is that of jobs started before. What the job
    /// refers to may change or go as soon as this returns: the child has a copy.
    bool start(const ChildJob& job);
    /// Waits for all children.
    bool finish();
    /// Kills the children, and makes this call and all later ones return false. For `watcher`,
    /// which is called during calls.
    void stop() { stopped_ = true; }

private:
    class Child;

    bool wait_for_fewer_than(std::size_t count, const StoppingSignals& signals);
    void take(std::size_t place);
    void tell_watcher() const;

    std::size_t at_once_;
    ChildWatcher watcher_;
    std::vector<std::unique_ptr<Child>> running_;
    std::size_t started_ = 0, ended_ = 0;
    bool stopped_ = false;
};

/// Runs every job in a pool of its own and returns when all have ended, or false after a signal.
bool run_children(const std::vector<ChildJob>& jobs, int at_once, const ChildWatcher& watcher);

} // namespace degs::sim
