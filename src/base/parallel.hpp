// SPDX-License-Identifier: Apache-2.0
// Work on the host's processors. Results must not depend on how many there are: a block of work
// writes to places of its own, and who needs an order puts the blocks together in theirs.
#pragma once

#include <cstddef>
#include <functional>

namespace degs {

/// Threads that parallel_blocks() uses, at least 1: the processors that this process may run on, or
/// what limit_host_threads() allowed.
int host_threads();
/// For processes beside which others work. `most` below 1 is 1.
void limit_host_threads(int most);

/// Calls work(block, worker) once for each block 0 .. blocks - 1, in any order; worker is in
/// 0 .. host_threads() - 1, and a worker does one block at a time. Returns when all are done;
/// throws the first exception of a block, after which no further block begins. With one thread or
/// one block it starts none.
void parallel_blocks(std::size_t blocks,
                     const std::function<void(std::size_t block, std::size_t worker)>& work);

/// Calls work(begin, end) for neighbouring parts of 0 .. count - 1, in the same way. Parts are long
/// against the start of a thread if an item takes some 100 ns.
void parallel_ranges(std::size_t count,
                     const std::function<void(std::size_t begin, std::size_t end)>& work);

} // namespace degs
