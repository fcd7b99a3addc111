// SPDX-License-Identifier: Apache-2.0
// The groups of benchmarks. Each function registers those that the options and the machine allow.
#pragma once

namespace degs::bench {

/// Exact simulation against the double-precision reference, and how its time grows with image and
/// array.
void register_frames();
/// LPDDR5 against copies of lines of a cache.
void register_memory();
/// The second run on a view against the first.
void register_cache();

} // namespace degs::bench
