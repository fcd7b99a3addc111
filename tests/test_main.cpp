// SPDX-License-Identifier: Apache-2.0
// GoogleTest inside sc_main: tests of the module kit need the SystemC
// kernel, the others do not mind.
#include <cstdlib>

#include <gtest/gtest.h>
#include <systemc>

#include "base/sanitizers.hpp"

namespace {
/// SystemC prints its banner before sc_main; set early, it spares builds (test discovery) and
/// tests.
const int kNoBanner = ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
/// Tests neither find nor leave anything in the cache of whoever runs them.
const int kNoCache = ::setenv("DEGS_CACHE", "", 1);
} // namespace

#if DEGS_ADDRESS_SANITIZER
/// As in sim/main_function.cpp: the leak sanitizer cannot read the stacks of SystemC's threads.
extern "C" int __lsan_is_turned_off() { // NOLINT(bugprone-reserved-identifier)
    return sc_core::sc_start_of_simulation_invoked() ? 1 : 0;
}
#endif

int sc_main(int argc, char* argv[]) {
    ::testing::InitGoogleTest(&argc, argv);
    return kNoBanner != 0 || kNoCache != 0 ? 1 : RUN_ALL_TESTS();
}
