// SPDX-License-Identifier: Apache-2.0
// Ratios that benchmarks measure, and the limits that they must not exceed.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

namespace degs::bench {

/// What the command line asks for.
struct Options {
    bool shortened = false; ///< small views, one repetition
    double slack = 1;       ///< limits are multiplied by it
    int repetitions() const { return shortened ? 1 : 3; }
};
const Options& options();
/// Takes what it knows out of the arguments and leaves the rest. Returns a mistake as a sentence,
/// or nothing.
std::string read_options(int& argc, char** argv);

/// Reports `ratio` and its `limit` as counters of the benchmark.
void report_ratio(benchmark::State& state, double ratio, double limit);

/// Adds a benchmark that measures a ratio from runs of the program: `run` calls SetIterationTime().
/// An exception ends it as failed.
void add_ratio(const std::string& name, const std::function<void(benchmark::State&)>& run);

/// Prints like Google Benchmark and remembers what went wrong.
class LimitReporter : public benchmark::ConsoleReporter {
public:
    LimitReporter() : ConsoleReporter(OO_Tabular) {}
    void ReportRuns(const std::vector<Run>& runs) override;

    /// Sentences: ratios above their limits, and benchmarks that failed.
    const std::vector<std::string>& missed() const { return missed_; }
    const std::vector<std::string>& failed() const { return failed_; }

private:
    std::vector<std::string> missed_, failed_;
};

} // namespace degs::bench
