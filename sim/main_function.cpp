// SPDX-License-Identifier: Apache-2.0
// main() of every program of the library, `degs` and those with accelerators of their own, which
// have an sc_main().
#include <cstdlib>

#include <systemc>

#include "base/sanitizers.hpp"

#if DEGS_ADDRESS_SANITIZER
/// Asked by the leak sanitizer at exit. It cannot read the protected pages between the stacks of
/// SystemC's threads, so a program that has run a simulation is not searched for leaks.
extern "C" int __lsan_is_turned_off() { // NOLINT(bugprone-reserved-identifier)
    return sc_core::sc_start_of_simulation_invoked() ? 1 : 0;
}
#endif

// Replaces that of SystemC, which prints the kernel's banner before sc_main() could stop it.
int main(int argc, char* argv[]) {
    ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
    return sc_core::sc_elab_and_sim(argc, argv);
}
