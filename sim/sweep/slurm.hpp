// SPDX-License-Identifier: Apache-2.0
// A study as a job array of Slurm.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace degs::sim {

struct SlurmArray {
    std::string name;                 ///< of the job
    std::string command;              ///< "degs sweep ...", for a shell; each task adds its --shard
    std::vector<std::string> options; ///< of sbatch, one line each
    std::string logs;                 ///< folder
    std::size_t parts = 1;            ///< N of --shard K/N
    std::vector<std::size_t> tasks;   ///< the K that have something to do, ascending
    int processors = 1;               ///< of one task
};

/// Tasks as Slurm writes them: "1-3,7".
std::string task_list(const std::vector<std::size_t>& tasks);

/// A name of a file where Slurm expands patterns such as %a. Throws InputError for what no pattern
/// can say: a backslash, which turns all patterns off, and control characters.
std::string slurm_name(const std::string& name);

/// The script for sbatch. A task whose node is lost is put back into the queue. Throws InputError
/// for an option that is more than one line, and for a folder that Slurm cannot name.
std::string slurm_script(const SlurmArray& array);

/// Hands the script to sbatch and returns the number of the job. Throws FailureError with what
/// sbatch said.
std::string submit_script(const std::string& file);

} // namespace degs::sim
