// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs::sim {

/// The command line program. Every failure is one sentence on stderr and a code other than 0.
int run_program(int argc, char* argv[]);

} // namespace degs::sim
