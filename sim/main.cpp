// SPDX-License-Identifier: Apache-2.0
#include <systemc>

#include "sim/program.hpp"

int sc_main(int argc, char* argv[]) {
    return degs::sim::run_program(argc, argv);
}
