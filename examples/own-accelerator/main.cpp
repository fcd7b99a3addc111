// SPDX-License-Identifier: Apache-2.0
// The program `degs` with one more accelerator.
#include <systemc>

#include "baselines/accelerators.hpp"
#include "config.hpp"
#include "sim/program.hpp"

int sc_main(int argc, char* argv[]) {
    degs::add_accelerator<degs::row_sweep::Config>("row_sweep");
    return degs::sim::run_program(argc, argv);
}
