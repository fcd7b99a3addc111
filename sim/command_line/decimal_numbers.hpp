// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/App.hpp>

namespace degs::sim {

/// Makes every option of `app` and its commands that takes a number read it in decimal: the
/// library would take 032 for 26 and 0x10 for 16, -1 for the largest unsigned number, and nan for a
/// real one. Leading zeros are allowed. To be called when all options have been added.
void require_decimal_numbers(CLI::App& app);

} // namespace degs::sim
