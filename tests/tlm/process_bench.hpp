// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "tlm/dated_fifo.hpp"

namespace degs::test {

/// A ring whose two sides are processes of the same test.
struct ProcessBench {
    explicit ProcessBench(Fidelity fidelity = Fidelity::Exact) : time{ClockDomain(1.0), fidelity} {}
    std::unique_ptr<DatedFifo<int>> ring(const char* name, std::size_t depth, Cycle forward = 1) {
        return std::make_unique<DatedFifo<int>>(name, time, depth, forward);
    }
    Timebase time;
};

inline auto both_fidelities() {
    return ::testing::Values(Fidelity::Exact, Fidelity::Strict);
}

inline std::string fidelity_name(const ::testing::TestParamInfo<Fidelity>& fidelity) {
    return fidelity.param == Fidelity::Exact ? "Exact" : "Strict";
}

} // namespace degs::test
