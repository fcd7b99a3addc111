// SPDX-License-Identifier: Apache-2.0
// Requests of 64 B to LPDDR5-6400 x 256 bit, and as a yardstick copies of lines of 64 B by the host
// in the same pattern.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "dram/channels.hpp"
#include "tests/bench/groups.hpp"
#include "tests/bench/limits.hpp"
#include "tests/bench/program.hpp"

namespace degs::bench {
namespace {

constexpr std::size_t kLineBytes = 64;

struct Line {
    alignas(kLineBytes) unsigned char bytes[kLineBytes];
};

/// Numbers without order: a linear congruential generator modulo 2^64, its upper bits.
class RandomNumbers {
public:
    std::uint64_t next() {
        state_ = state_ * 6364136223846793005U + 1442695040888963407U;
        return state_ >> 31U;
    }

private:
    std::uint64_t state_ = 1;
};

/// Seconds that the host takes to copy a line from one half of an array to the other, line after
/// line or at random. The array is larger than its caches. The smallest of a few rounds.
double seconds_per_line(bool random) {
    const std::size_t bytes = options().shortened ? 64U << 20U : 512U << 20U;
    std::vector<Line> lines(bytes / kLineBytes);
    const std::size_t half = lines.size() / 2;
    double best = std::numeric_limits<double>::infinity();
    for (int round = 0; round < 3; ++round) {
        RandomNumbers numbers;
        const auto start = std::chrono::steady_clock::now();
        for (std::size_t i = 0; i < half; ++i) {
            const std::size_t from = random ? numbers.next() % half : i;
            const std::size_t to = half + (random ? numbers.next() % half : i);
            std::memcpy(&lines[to], &lines[from], sizeof(Line));
            benchmark::ClobberMemory();
        }
        const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
        best = std::min(best, time.count() / static_cast<double>(half));
    }
    return best;
}

/// `degs memory`: the SystemC module behind its TLM sockets, saturated. The limit is in copied
/// lines.
void through_sockets(benchmark::State& state, const std::string& pattern, double limit) {
    const std::string requests = options().shortened ? "50000" : "2000000";
    double fastest = 0;
    for (auto iteration : state) {
        (void)iteration;
        const nlohmann::json result =
            run_program({"memory", std::string(DEGS_CONFIGS) + "/memory/lpddr5-6400x256.yaml",
                         "--pattern", pattern, "--requests", requests, "--no-curve"},
                        "memory.json");
        fastest = std::max(fastest, result["host"]["requests_per_s"].get<double>());
        state.SetIterationTime(result["host"]["sim_s"].get<double>());
    }
    const double line_s = seconds_per_line(pattern == "random");
    report_ratio(state, 1 / (fastest * line_s), limit);
    state.counters["M requests/s"] = 1e-6 * fastest;
    state.counters["M lines/s"] = 1e-6 / line_s;
}

/// The channels without SystemC, at a load that they can follow: as many requests per CK as given.
void channels_alone(benchmark::State& state, bool random, int requests_per_ck) {
    const dram::Config config;
    dram::Channels channels(config);
    const std::uint64_t places = channels.mapping().capacity() / kLineBytes;
    RandomNumbers numbers;
    std::vector<std::uint32_t> free;
    std::uint32_t ids = 0;
    std::uint64_t requests = 0;
    dram::Ck date = 0;
    for (auto iteration : state) {
        (void)iteration;
        ++date;
        for (int i = 0; i < requests_per_ck; ++i, ++requests) {
            dram::Request request;
            request.date = date;
            request.address = kLineBytes * ((random ? numbers.next() : requests) % places);
            request.bytes = kLineBytes;
            request.id = free.empty() ? ids++ : free.back();
            if (!free.empty()) {
                free.pop_back();
            }
            channels.push(request);
        }
        if (channels.due() <= date) {
            channels.run(date);
            for (const dram::Answer& answer : channels.completed()) {
                free.push_back(answer.id);
            }
            channels.completed().clear();
            channels.admitted().clear();
        }
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(requests));
    if (ids > 10000) {
        state.SkipWithError("The channels do not follow the load, so that requests wait for ever.");
    }
}

void add_pattern(const std::string& pattern, double limit, int requests_per_ck) {
    add_ratio("LPDDR5 request over copied line/" + pattern,
              [=](benchmark::State& state) { through_sockets(state, pattern, limit); });
    benchmark::RegisterBenchmark(("LPDDR5 channels alone, one CK/" + pattern).c_str(),
                                 [=](benchmark::State& state) {
                                     channels_alone(state, pattern == "random", requests_per_ck);
                                 })
        ->MinTime(options().shortened ? 0.02 : 1.0);
}

} // namespace

void register_memory() {
    add_pattern("stream", 60, 3); // 75 % of the peak
    add_pattern("random", 40, 1);
}

} // namespace degs::bench
