// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/array_task.hpp"

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs::sim {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Variables = std::map<std::string, std::string>;

Environment holding(const Variables& variables) {
    return [variables](const std::string& name) -> std::optional<std::string> {
        const auto found = variables.find(name);
        return found == variables.end() ? std::nullopt : std::optional(found->second);
    };
}

void expect_task(const Variables& variables, std::size_t k, std::size_t n) {
    const ArrayTask task = array_task(holding(variables));
    EXPECT_EQ(task.k, k);
    EXPECT_EQ(task.n, n);
}

template <class Matcher>
void expect_refusal(const Variables& variables, const Matcher& words) {
    try {
        array_task(holding(variables));
        FAIL() << "nothing was refused";
    } catch (const InputError& error) {
        EXPECT_THAT(error.what(), words);
        EXPECT_THAT(error.what(), HasSubstr("--shard K/N names the part"));
    }
}

Variables slurm(const char* id, const char* low, const char* high, const char* count) {
    return {{"SLURM_ARRAY_TASK_ID", id},
            {"SLURM_ARRAY_TASK_MIN", low},
            {"SLURM_ARRAY_TASK_MAX", high},
            {"SLURM_ARRAY_TASK_COUNT", count}};
}

Variables with(Variables variables, const std::string& name, const std::string& value) {
    variables[name] = value;
    return variables;
}

TEST(ArrayTask, IsThatOfSlurm) {
    expect_task(slurm("1", "1", "8", "8"), 1, 8);
    expect_task(slurm("7", "0", "7", "8"), 8, 8);
    expect_task(with(slurm("9", "5", "11", "4"), "SLURM_ARRAY_TASK_STEP", "2"), 3, 4);
    expect_task(slurm("3", "3", "3", "1"), 1, 1);
}

TEST(ArrayTask, OfSlurmIsRefusedIfTheArrayHasGaps) {
    expect_refusal(slurm("7", "1", "7", "4"), AllOf(HasSubstr("SLURM_ARRAY_TASK_COUNT is '4'"),
                                                    HasSubstr("the array of Slurm has gaps")));
    Variables without = slurm("1", "1", "8", "8");
    without.erase("SLURM_ARRAY_TASK_COUNT");
    expect_refusal(without, HasSubstr("SLURM_ARRAY_TASK_ID of Slurm is set, but "
                                      "SLURM_ARRAY_TASK_COUNT is not"));
}

TEST(ArrayTask, IsThatOfKubernetes) {
    expect_task({{"JOB_COMPLETION_INDEX", "0"}, {"DEGS_TASKS", "5"}}, 1, 5);
    expect_task({{"JOB_COMPLETION_INDEX", "4"}, {"DEGS_TASKS", "5"}}, 5, 5);
    expect_refusal({{"JOB_COMPLETION_INDEX", "5"}, {"DEGS_TASKS", "5"}},
                   HasSubstr("JOB_COMPLETION_INDEX is '5', DEGS_TASKS is '5'"));
    expect_refusal({{"JOB_COMPLETION_INDEX", "0"}},
                   HasSubstr("DEGS_TASKS is not, which has to be the number of tasks, because "
                             "Kubernetes does not tell it"));
}

TEST(ArrayTask, IsThatOfAwsBatch) {
    expect_task({{"AWS_BATCH_JOB_ARRAY_INDEX", "2"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "10"}}, 3, 10);
    expect_refusal({{"AWS_BATCH_JOB_ARRAY_INDEX", "2"}},
                   HasSubstr("AWS_BATCH_JOB_ARRAY_SIZE is not; "));
}

TEST(ArrayTask, IsThatOfPbs) {
    expect_task({{"PBS_ARRAY_INDEX", "4"}, {"DEGS_TASKS", "4"}}, 4, 4);
    expect_refusal({{"PBS_ARRAY_INDEX", "0"}, {"DEGS_TASKS", "4"}},
                   HasSubstr("a task of PBS has a number from 1"));
    expect_refusal({{"PBS_ARRAY_INDEX", "1"}}, HasSubstr("because PBS does not tell it"));
}

TEST(ArrayTask, IsThatOfSge) {
    const Variables third{{"SGE_TASK_ID", "7"},
                          {"SGE_TASK_FIRST", "3"},
                          {"SGE_TASK_LAST", "10"},
                          {"SGE_TASK_STEPSIZE", "2"}};
    expect_task(third, 3, 4); // 3, 5, 7, 9
    expect_refusal(with(third, "SGE_TASK_ID", "6"), HasSubstr("SGE_TASK_STEPSIZE is '2'"));
    expect_refusal(with(third, "SGE_TASK_STEPSIZE", "0"), HasSubstr("SGE_TASK_STEPSIZE is '0'"));
    expect_refusal(with(third, "SGE_TASK_ID", "undefined"), HasSubstr("needs a task of a job"));
}

TEST(ArrayTask, IsThatOfLsf) {
    expect_task({{"LSB_JOBINDEX", "2"}, {"LSB_JOBINDEX_END", "6"}}, 2, 6);
    expect_task({{"LSB_JOBINDEX", "5"}, {"LSB_JOBINDEX_END", "9"}, {"LSB_JOBINDEX_STEP", "2"}}, 3,
                5);
    expect_refusal({{"LSB_JOBINDEX", "0"}, {"LSB_JOBINDEX_END", "0"}},
                   HasSubstr("none of SLURM_ARRAY_TASK_ID, JOB_COMPLETION_INDEX"));
}

TEST(ArrayTask, IsRefusedIfNoneOrTwoSchedulersAreThere) {
    expect_refusal({}, HasSubstr("needs a task of a job array, but none of SLURM_ARRAY_TASK_ID"));
    expect_refusal(with(slurm("1", "1", "2", "2"), "JOB_COMPLETION_INDEX", "0"),
                   HasSubstr("SLURM_ARRAY_TASK_ID of Slurm and JOB_COMPLETION_INDEX of Kubernetes "
                             "are both set"));
}

TEST(ArrayTask, IsRefusedIfANumberIsNone) {
    for (const char* text : {"", "x", "-1", "1.5", " 1", "99999999999999999999999"}) {
        expect_refusal({{"AWS_BATCH_JOB_ARRAY_INDEX", text}, {"AWS_BATCH_JOB_ARRAY_SIZE", "4"}},
                       HasSubstr("but must be a number in decimal digits"));
    }
    expect_refusal({{"AWS_BATCH_JOB_ARRAY_INDEX", "0"}, {"AWS_BATCH_JOB_ARRAY_SIZE", "0"}},
                   HasSubstr("AWS_BATCH_JOB_ARRAY_SIZE is '0'"));
    expect_refusal(slurm("3", "5", "8", "4"), HasSubstr("SLURM_ARRAY_TASK_MIN is '5'"));
    expect_refusal(slurm("9", "5", "8", "4"), HasSubstr("SLURM_ARRAY_TASK_MAX is '8'"));
}

} // namespace
} // namespace degs::sim
