// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>

#include <systemc>

#include "sim/program.hpp"

int sc_main(int argc, char* argv[]) {
    return degs::sim::run_program(argc, argv);
}

// In place of the library's main(), which prints the kernel's banner before sc_main() could stop
// it.
int main(int argc, char* argv[]) {
    ::setenv("SYSTEMC_DISABLE_COPYRIGHT_MESSAGE", "1", 1);
    return sc_core::sc_elab_and_sim(argc, argv);
}
