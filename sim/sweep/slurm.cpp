// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/slurm.hpp"

#include <array>
#include <cstdio>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/process/failure.hpp"
#include "sim/text/shell_word.hpp"

namespace degs::sim {
namespace {

/// What a shell command printed, errors included; `good` is whether it succeeded.
std::string output_of(const std::string& command, bool& good) {
    good = false;
    std::FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
    if (pipe == nullptr) {
        return "no process could be started";
    }
    std::string text;
    std::array<char, 4096> part;
    for (std::size_t n = 1; n != 0;) {
        n = std::fread(part.data(), 1, part.size(), pipe);
        text.append(part.data(), n);
    }
    good = ::pclose(pipe) == 0;
    return text.substr(0, text.find_last_not_of("\r\n") + 1);
}

} // namespace

std::string task_list(const std::vector<std::size_t>& tasks) {
    std::string text;
    for (std::size_t i = 0; i < tasks.size();) {
        std::size_t last = i;
        while (last + 1 < tasks.size() && tasks[last + 1] == tasks[last] + 1) {
            ++last;
        }
        text += (text.empty() ? "" : ",") + std::to_string(tasks[i]);
        text += last == i ? "" : "-" + std::to_string(tasks[last]);
        i = last + 1;
    }
    return text;
}

std::string slurm_name(const std::string& name) {
    std::string pattern;
    for (const char c : name) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '\\' || code < 0x20 || code == 0x7f) {
            throw InputError("The output folder " + config_words::quote(name) +
                             " has a backslash or a control character in its name, with which "
                             "Slurm cannot name the files of its tasks; choose another with "
                             "--out.");
        }
        pattern += c == '%' ? "%%" : std::string(1, c);
    }
    return pattern;
}

std::string slurm_script(const SlurmArray& array) {
    std::string text = "#!/bin/sh\n"
                       "#SBATCH --job-name=" +
                       array.name + "\n#SBATCH --array=" + task_list(array.tasks) +
                       "\n#SBATCH --cpus-per-task=" + std::to_string(array.processors) +
                       "\n#SBATCH --requeue\n#SBATCH --open-mode=append\n#SBATCH --output=" +
                       shell_word(slurm_name(array.logs) + "/%a.log") + "\n";
    for (const std::string& option : array.options) {
        if (option.find_first_of("\r\n") != std::string::npos || option.rfind('-', 0) != 0) {
            throw InputError("--sbatch is " + config_words::quote(option) +
                             ", but must be one line of options of sbatch, such as "
                             "'--partition=short --time=60'.");
        }
        text += "#SBATCH " + option + "\n";
    }
    return text + "exec " + array.command + " --shard \"$SLURM_ARRAY_TASK_ID/" +
           std::to_string(array.parts) + "\"\n";
}

std::string submit_script(const std::string& file) {
    bool good = false;
    const std::string said = output_of("sbatch --parsable " + shell_word(file), good);
    if (!good) {
        throw FailureError(
            {kUserError, "sbatch did not take the script '" + file + "': " + said + "."});
    }
    const std::size_t line = said.rfind('\n') + 1;         // warnings may come before
    return said.substr(line, said.find(';', line) - line); // "id;cluster"
}

} // namespace degs::sim
