// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "modules/kit/job/sram_ports.hpp"

namespace degs {

/// When a chunk of splats leaves its place in the Gaussian Buffer: once its last splat has been
/// taken by a Slicing Unit, or once the spans of all its splats have been made.
enum class ParameterLife { Sliced, Spans };

/// The Gaussian Buffer (paper Table I): lists being sorted, and sorted splats in front of the
/// Slicing Units.
struct GaussianBufferConfig {
    int bytes = 72 * 1024;
    double sort_share = 0.5; ///< of the buffer, for lists being sorted
    BankedSramPorts ports{{0}, 4};
    ParameterLife temporary = ParameterLife::Sliced;
    void describe(ConfigVisitor& visitor);
};

} // namespace degs
