// SPDX-License-Identifier: Apache-2.0
// The cache comes with the program, and so with SystemC, whose library asks for this function.
// Nothing here simulates.
#include <cstdlib>

#include <systemc>

int sc_main(int, char**) {
    std::abort();
}
