// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "degs/degs_driver.h"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {

/// The registers of a host for the driver in C.
inline degs_device device_of(Host& host) {
    return {&host,
            [](void* to, std::uint32_t offset) {
                return static_cast<Host*>(to)->read(static_cast<Register>(offset));
            },
            [](void* to, std::uint32_t offset, std::uint32_t value) {
                static_cast<Host*>(to)->write(static_cast<Register>(offset), value);
            }};
}

} // namespace degs::test
