// SPDX-License-Identifier: Apache-2.0
// Bits of the ports of a module that Verilator has made. Ports are unsigned numbers, or arrays of
// 32-bit words, the lowest first.
#pragma once

#include <cstddef>
#include <cstdint>

namespace degs::rtl_test {

template <class Port>
std::uint64_t get(const Port& port, std::size_t low, std::size_t bits) {
    const auto* const bytes = reinterpret_cast<const unsigned char*>(&port);
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bits; ++i) {
        const std::size_t place = low + i;
        value |= std::uint64_t{bytes[place / 8] >> (place % 8) & 1U} << i;
    }
    return value;
}

template <class Port>
void set(Port& port, std::size_t low, std::size_t bits, std::uint64_t value) {
    auto* const bytes = reinterpret_cast<unsigned char*>(&port);
    for (std::size_t i = 0; i < bits; ++i) {
        const std::size_t place = low + i;
        const auto bit = static_cast<unsigned char>(1U << (place % 8));
        bytes[place / 8] = static_cast<unsigned char>(
            (value >> i & 1U) != 0 ? bytes[place / 8] | bit : bytes[place / 8] & ~bit);
    }
}

} // namespace degs::rtl_test
