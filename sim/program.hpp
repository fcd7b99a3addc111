// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs::sim {

constexpr int kSuccess = 0;
constexpr int kInternalError = 1; ///< the model or the machine failed
constexpr int kUserError = 2;     ///< command line, configuration, scene or output folder

/// The command line program. Every failure is one sentence on stderr and a code other than 0.
int run_program(int argc, char* argv[]);

} // namespace degs::sim
