// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/limits.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace degs::bench {
namespace {

Options chosen;
constexpr const char* kRatio = "ratio";
constexpr const char* kLimit = "limit";

} // namespace

const Options& options() {
    return chosen;
}

std::string read_options(int& argc, char** argv) {
    int kept = 1;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--short") == 0) {
            chosen.shortened = true;
        } else if (std::strcmp(argv[i], "--slack") == 0) {
            char* end = nullptr;
            chosen.slack = i + 1 < argc ? std::strtod(argv[++i], &end) : 0;
            if (!(chosen.slack > 0) || *end != '\0') {
                return "--slack needs a number above 0, by which all limits are multiplied.";
            }
        } else {
            argv[kept++] = argv[i];
        }
    }
    argc = kept;
    return "";
}

void report_ratio(benchmark::State& state, double ratio, double limit) {
    state.counters[kRatio] = ratio;
    state.counters[kLimit] = limit * chosen.slack;
}

void add_ratio(const std::string& name, const std::function<void(benchmark::State&)>& run) {
    const auto guarded = [run](benchmark::State& state) {
        try {
            run(state);
        } catch (const std::exception& error) {
            state.SkipWithError(error.what());
        }
    };
    benchmark::RegisterBenchmark(name.c_str(), guarded)
        ->UseManualTime()
        ->Unit(benchmark::kSecond)
        ->Iterations(chosen.repetitions());
}

void LimitReporter::ReportRuns(const std::vector<Run>& runs) {
    ConsoleReporter::ReportRuns(runs);
    for (const Run& run : runs) {
        if (run.error_occurred) {
            failed_.push_back(run.benchmark_name() + ": " + run.error_message);
            continue;
        }
        const auto ratio = run.counters.find(kRatio);
        if (ratio == run.counters.end()) {
            continue;
        }
        const double limit = run.counters.at(kLimit);
        if (!(ratio->second <= limit)) { // NaN is no ratio either
            std::ostringstream sentence;
            sentence << run.benchmark_name() << ": " << ratio->second << " is above " << limit;
            missed_.push_back(sentence.str());
        }
    }
}

} // namespace degs::bench
