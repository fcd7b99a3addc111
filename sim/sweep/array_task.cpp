// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/array_task.hpp"

#include <charconv>
#include <cstdlib>
#include <vector>

#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "sim/sweep/study_plan.hpp"

namespace degs::sim {
namespace {

/// How a scheduler numbers the tasks of an array: from `first` to `last` in steps. Fields are names
/// of variables; those that a scheduler does not have are empty.
struct Scheduler {
    const char* name;
    const char* index;
    const char* first;  ///< number of the first task; empty: `origin`
    const char* last;   ///< number of the last task
    const char* step;   ///< between two numbers; empty or not set: 1
    const char* count;  ///< how many tasks there are
    const char* nobody; ///< the index of a job that is no array
    std::size_t origin;
};

// docs/studies.md says what each of them sets.
const std::vector<Scheduler>& schedulers() {
    static const std::vector<Scheduler> all{
        {"Slurm", "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX",
         "SLURM_ARRAY_TASK_STEP", "SLURM_ARRAY_TASK_COUNT", "", 0},
        {"Kubernetes", "JOB_COMPLETION_INDEX", "", "", "", kTasksVariable, "", 0},
        {"AWS Batch", "AWS_BATCH_JOB_ARRAY_INDEX", "", "", "", "AWS_BATCH_JOB_ARRAY_SIZE", "", 0},
        {"PBS", "PBS_ARRAY_INDEX", "", "", "", kTasksVariable, "", 1},
        {"SGE", "SGE_TASK_ID", "SGE_TASK_FIRST", "SGE_TASK_LAST", "SGE_TASK_STEPSIZE", "",
         "undefined", 1},
        {"LSF", "LSB_JOBINDEX", "", "LSB_JOBINDEX_END", "LSB_JOBINDEX_STEP", "", "0", 1},
    };
    return all;
}

constexpr const char* kInstead = "; --shard K/N names the part without a scheduler.";

std::string shown(const Environment& environment, const std::string& variable) {
    return variable + " is " + config_words::quote(environment(variable).value_or(""));
}

/// A variable that must be there and a number.
std::size_t number_of(const Environment& environment, const Scheduler& scheduler,
                      const std::string& variable) {
    const std::optional<std::string> text = environment(variable);
    if (!text) {
        const bool ours = variable == kTasksVariable;
        throw InputError("--shard auto: " + std::string(scheduler.index) + " of " + scheduler.name +
                         " is set, but " + variable + " is not" +
                         (ours ? ", which has to be the number of tasks, because " +
                                     std::string(scheduler.name) + " does not tell it"
                               : "") +
                         kInstead);
    }
    std::size_t number = 0;
    const char* const end = text->data() + text->size();
    const auto [stop, error] = std::from_chars(text->data(), end, number);
    if (error != std::errc() || stop != end) {
        throw InputError("--shard auto: " + shown(environment, variable) +
                         ", but must be a number in decimal digits" + kInstead);
    }
    return number;
}

/// The scheduler that has set its index.
const Scheduler& found_scheduler(const Environment& environment) {
    const Scheduler* found = nullptr;
    std::string indices;
    for (const Scheduler& scheduler : schedulers()) {
        indices += (indices.empty() ? "" : ", ") + std::string(scheduler.index);
        const std::optional<std::string> index = environment(scheduler.index);
        if (!index || (*scheduler.nobody != '\0' && *index == scheduler.nobody)) {
            continue;
        }
        if (found != nullptr) {
            throw InputError("--shard auto: " + std::string(found->index) + " of " + found->name +
                             " and " + scheduler.index + " of " + scheduler.name +
                             " are both set, so the part is not clear" + kInstead);
        }
        found = &scheduler;
    }
    if (found == nullptr) {
        throw InputError("--shard auto needs a task of a job array, but none of " + indices +
                         " is set" + kInstead);
    }
    return *found;
}

} // namespace

ArrayTask array_task(const Environment& environment) {
    const Scheduler& scheduler = found_scheduler(environment);
    const auto number = [&](const char* variable) {
        return number_of(environment, scheduler, variable);
    };
    const std::size_t index = number(scheduler.index);
    const std::size_t first = *scheduler.first == '\0' ? scheduler.origin : number(scheduler.first);
    const bool stepped = *scheduler.step != '\0' && environment(scheduler.step).has_value();
    const std::size_t step = stepped ? number(scheduler.step) : 1;
    const bool counted = *scheduler.count != '\0';
    std::size_t n = counted ? number(scheduler.count) : 0;
    std::string all = shown(environment, scheduler.index);
    for (const char* variable :
         {scheduler.first, scheduler.last, scheduler.step, scheduler.count}) {
        if (*variable != '\0' && environment(variable)) {
            all += ", " + shown(environment, variable);
        }
    }
    bool fits = step > 0 && index >= first && (index - first) % step == 0;
    if (fits && *scheduler.last != '\0') {
        const std::size_t last = number(scheduler.last);
        fits = last >= index;
        const std::size_t span = fits ? (last - first) / step + 1 : 0;
        if (fits && counted && span != n) {
            throw InputError("--shard auto: " + all + ": the array of " + scheduler.name +
                             " has gaps, so the position of a task is not known" + kInstead);
        }
        n = span;
    }
    if (!fits || (index - first) / step >= n) {
        throw InputError("--shard auto: " + all + ": a task of " + scheduler.name +
                         " has a number from " + std::to_string(first) + " to the last one" +
                         kInstead);
    }
    return {(index - first) / step + 1, n};
}

ArrayTask array_task() {
    return array_task([](const std::string& variable) -> std::optional<std::string> {
        const char* value = std::getenv(variable.c_str());
        return value == nullptr ? std::nullopt : std::optional<std::string>(value);
    });
}

ArrayTask parse_shard(const std::string& given) {
    if (given == "auto") {
        const ArrayTask task = array_task();
        if (task.n > kMostPoints) {
            throw InputError("--shard auto: the job array has " + std::to_string(task.n) +
                             " tasks, but at most " + std::to_string(kMostPoints) +
                             " parts are possible.");
        }
        return task;
    }
    ArrayTask task{0, 0};
    const char* const end = given.data() + given.size();
    const auto [slash, bad_k] = std::from_chars(given.data(), end, task.k);
    const bool split = bad_k == std::errc() && slash != end && *slash == '/';
    const auto [rest, bad_n] = std::from_chars(split ? slash + 1 : end, end, task.n);
    if (!split || bad_n != std::errc() || rest != end || task.k < 1 || task.k > task.n ||
        task.n > kMostPoints) {
        throw InputError(
            "--shard is " + config_words::quote(given) +
            ", but must be K/N: the K-th of N parts, from 1/N to N/N, or auto in a task of a "
            "job array.");
    }
    return task;
}

} // namespace degs::sim
