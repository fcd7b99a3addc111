// SPDX-License-Identifier: Apache-2.0
#include "base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace degs {
namespace {

std::atomic<int> most_threads{0}; // 0: all processors

} // namespace

int host_threads() {
    const int most = most_threads;
    return most > 0 ? most : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void limit_host_threads(int most) {
    most_threads = std::max(most, 1);
}

void parallel_blocks(std::size_t blocks,
                     const std::function<void(std::size_t block, std::size_t worker)>& work) {
    const std::size_t workers = std::min<std::size_t>(blocks, host_threads());
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failing;
    const auto serve = [&](std::size_t worker) {
        try {
            for (std::size_t block = next++; block < blocks; block = next++) {
                work(block, worker);
            }
        } catch (...) {
            const std::lock_guard<std::mutex> lock(failing);
            failure = failure ? failure : std::current_exception();
            next = blocks;
        }
    };
    std::vector<std::thread> threads;
    for (std::size_t worker = 1; worker < workers; ++worker) {
        threads.emplace_back(serve, worker);
    }
    serve(0);
    for (std::thread& thread : threads) {
        thread.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

void parallel_ranges(std::size_t count,
                     const std::function<void(std::size_t begin, std::size_t end)>& work) {
    constexpr std::size_t kPart = std::size_t{1} << 13U;
    parallel_blocks((count + kPart - 1) / kPart, [&](std::size_t part, std::size_t /*worker*/) {
        work(part * kPart, std::min(count, (part + 1) * kPart));
    });
}

} // namespace degs
