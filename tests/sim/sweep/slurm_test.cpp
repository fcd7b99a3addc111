// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/slurm.hpp"
#include "sim/text/shell_word.hpp"

#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using testing::HasSubstr;

TEST(SlurmArrays, ListTasksAsRanges) {
    EXPECT_EQ(task_list({1}), "1");
    EXPECT_EQ(task_list({1, 2, 3, 7}), "1-3,7");
    EXPECT_EQ(task_list({2, 4, 5}), "2,4-5");
}

TEST(SlurmArrays, QuoteWhatAShellWouldChange) {
    EXPECT_EQ(shell_word("a/b-1.yaml"), "a/b-1.yaml");
    EXPECT_EQ(shell_word(""), "''");
    EXPECT_EQ(shell_word("a b"), "'a b'");
    EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
}

TEST(SlurmArrays, EachTaskRunsItsPart) {
    SlurmArray array;
    array.name = "degs-x";
    array.command = "/bin/degs sweep 'my study.yaml'";
    array.options = {"--partition=short --time=60"};
    array.logs = "o/slurm";
    array.parts = 9;
    array.tasks = {1, 2, 9};
    array.processors = 4;
    const std::string script = slurm_script(array);
    EXPECT_EQ(script.rfind("#!/bin/sh\n#SBATCH --job-name=degs-x\n#SBATCH --array=1-2,9\n", 0), 0U);
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --cpus-per-task=4\n#SBATCH --requeue\n"));
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --partition=short --time=60\nexec "));
    EXPECT_THAT(script, HasSubstr("exec /bin/degs sweep 'my study.yaml' --shard "
                                  "\"$SLURM_ARRAY_TASK_ID/9\"\n"));
}

TEST(HostileSlurm, Mistakes) {
    using sim_test::degs;
    const sim_test::Folder folder;
    const auto mistake = [&folder](const std::vector<std::string>& more, const std::string& words) {
        std::vector<std::string> arguments{"sweep",    sim_test::config("studies/ablation"),
                                           "--scene",  "synthetic:single",
                                           "--camera", "0",
                                           "--width",  "64",
                                           "--out",    folder / "o",
                                           "--slurm"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_mistake(degs(arguments, [] { ::setenv("PATH", "/nowhere", 1); }), words);
    };
    mistake({"--sbatch", "--time=1\nrm"}, "must be one line of options");
    mistake({"--sbatch", "long"}, "must be one line of options");
    mistake({"--tasks", "0"}, "--tasks");
    mistake({"--collect"}, "--collect");
    EXPECT_FALSE(sim_test::fs::exists(folder / "o"));
    mistake({}, "sbatch did not take the script");
    EXPECT_THAT(sim_test::read_file(folder / "o/slurm.sh"), HasSubstr("#SBATCH --array=1-4\n"));
}

} // namespace
} // namespace degs::sim
