// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <utility>

#include <systemc>

#include "tlm/has_process.hpp"

namespace degs::test {

/// One SC_THREAD that runs a lambda: the shortest way to a process in a test.
class Script : public sc_core::sc_module {
public:
    Script(const sc_core::sc_module_name& name, std::function<void()> body)
        : sc_core::sc_module(name), body_(std::move(body)) {
        DEGS_HAS_PROCESS(Script);
        SC_THREAD(run);
    }

private:
    void run() { body_(); }
    std::function<void()> body_;
};

/// Bits from numbers; for work times that two implementations must agree on.
inline std::uint64_t mix(std::uint64_t a, std::uint64_t b, std::uint64_t c, std::uint64_t d) {
    std::uint64_t h = 0x9E3779B97F4A7C15U;
    for (const std::uint64_t v : {a, b, c, d}) {
        h = (h ^ v) * 0xBF58476D1CE4E5B9U;
        h ^= h >> 29U;
    }
    return h ^ (h >> 32U);
}

} // namespace degs::test
