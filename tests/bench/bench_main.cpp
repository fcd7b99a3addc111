// SPDX-License-Identifier: Apache-2.0
// degs_bench [--short] [--slack X] [options of Google Benchmark]: exit code 1 if a ratio is above
// its limit times X or a benchmark failed; 2 for a mistake in the arguments.
#include <cstdio>
#include <cstdlib>

#include <systemc>

#include "tests/bench/groups.hpp"
#include "tests/bench/limits.hpp"

namespace {
/// SystemC prints its banner before sc_main.
const int kNoBanner = ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
} // namespace

// The library of SystemC, which the channels of LPDDR5 come with, has the function main.
int sc_main(int argc, char* argv[]) {
    using namespace degs::bench;
    if (kNoBanner != 0) {
        return 2;
    }
    if (const std::string mistake = read_options(argc, argv); !mistake.empty()) {
        std::fprintf(stderr, "degs_bench: %s\n", mistake.c_str());
        return 2;
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    register_frames();
    register_memory();
    register_cache();
    LimitReporter reporter;
    if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) {
        return 2; // it has said that no benchmark matches
    }
    for (const auto* sentences : {&reporter.failed(), &reporter.missed()}) {
        for (const std::string& sentence : *sentences) {
            std::fprintf(stderr, "%s\n", sentence.c_str());
        }
    }
    std::fprintf(stderr, "%zu ratios are above their limits, %zu benchmarks failed.\n",
                 reporter.missed().size(), reporter.failed().size());
    return reporter.missed().empty() && reporter.failed().empty() ? 0 : 1;
}
