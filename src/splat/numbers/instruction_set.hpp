// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <hwy/highway.h>

namespace degs {

/// What `dispatch`, which asks Highway for a kernel, gives for every instruction set that this
/// build has code for and this machine can run, the least first. For tests: who asks Highway
/// meanwhile may get a slower kernel, with the same results.
template <class Dispatch>
auto of_all_targets(const Dispatch& dispatch) {
    std::vector<decltype(dispatch())> functions;
    // Highway does not name the least set on machines without AES, which it would ask for.
    std::int64_t left = (hwy::SupportedTargets() & HWY_TARGETS) | HWY_STATIC_TARGET;
    for (; left != 0; left &= left - 1) { // the widest first
        hwy::GetChosenTarget().Update(left);
        functions.insert(functions.begin(), dispatch());
    }
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return functions;
}

} // namespace degs
