// SPDX-License-Identifier: Apache-2.0
// Linked into a test program, this file adds the accelerator of examples/own-accelerator to it.
#include "baselines/accelerators.hpp"
#include "config.hpp"

namespace {

/// Before sc_main(), because the program itself names no accelerator.
const bool kAdded = [] {
    degs::add_accelerator<degs::row_sweep::Config>("row_sweep");
    return true;
}();

} // namespace
