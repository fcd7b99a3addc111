// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include <systemc>

#include "sim/program.hpp"

int sc_main(int argc, char* argv[]) {
    return degs::sim::run_program(argc, argv);
}

#ifdef __SANITIZE_ADDRESS__
/// Asked by the leak sanitizer at exit. It cannot read the protected pages between the stacks of
/// SystemC's threads, so a program that has run a simulation is not searched for leaks.
extern "C" int __lsan_is_turned_off() { // NOLINT(bugprone-reserved-identifier)
    return sc_core::sc_start_of_simulation_invoked() ? 1 : 0;
}
#endif

// Replaces the library's main(), which prints the kernel's banner before sc_main() could stop
// it.
int main(int argc, char* argv[]) {
    ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
    return sc_core::sc_elab_and_sim(argc, argv);
}
