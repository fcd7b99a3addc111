// SPDX-License-Identifier: Apache-2.0
// The part of a study that a task of a job array has to run, as its scheduler tells.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

namespace degs::sim {

/// The k-th of n tasks, k from 1.
struct ArrayTask {
    std::size_t k = 1, n = 1;
};

/// The value of an environment variable, if it is set.
using Environment = std::function<std::optional<std::string>(const std::string&)>;

/// The variable with the number of tasks, for schedulers that do not tell it.
constexpr const char* kTasksVariable = "DEGS_TASKS";

/// The task of Slurm, Kubernetes, AWS Batch, PBS, SGE or LSF that this process is. Throws
/// InputError if it is none or seems to be one of two, and if its number or the number of tasks is
/// missing, is no number or does not fit the others.
ArrayTask array_task(const Environment& environment);
/// Reads the environment of this process.
ArrayTask array_task();

/// What --shard says: "2/5", or "auto" for the task that this process is. Throws InputError for
/// anything else, and for more parts than a study may have points.
ArrayTask parse_shard(const std::string& given);

} // namespace degs::sim
