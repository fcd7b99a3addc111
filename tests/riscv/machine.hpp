// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "rv32.hpp"

namespace rv32::test {

constexpr std::uint32_t kHandler = 0x3000; ///< where tests let mtvec point

/// A core with 64 KiB of memory from address 0 on, and nothing behind it.
struct Machine : Memory {
    std::vector<unsigned char> bytes = std::vector<unsigned char>(65536);
    Core core{*this};

    bool fetch(std::uint32_t address, std::uint32_t& word) override {
        return load(address, 4, word);
    }
    bool load(std::uint32_t address, unsigned size, std::uint32_t& value) override {
        value = 0;
        if (address > bytes.size() - size) {
            return false;
        }
        std::memcpy(&value, &bytes[address], size); // a little-endian host
        return true;
    }
    bool store(std::uint32_t address, unsigned size, std::uint32_t value) override {
        if (address > bytes.size() - size) {
            return false;
        }
        std::memcpy(&bytes[address], &value, size);
        return true;
    }
    std::uint32_t csr(std::uint32_t which) const {
        std::uint32_t value = 0;
        return core.read_csr(which, value) ? value : 0xDEADBEEFU;
    }
    /// Executes one instruction at `pc`.
    void run(std::uint32_t word, std::uint32_t pc = 0x1000) {
        store(pc, 4, word);
        core.set_pc(pc);
        core.step();
    }
};

// Formats of instructions (volume I, 2.3). Registers: 0 to 31.
constexpr std::uint32_t r_type(std::uint32_t funct7, std::uint32_t funct3, std::uint32_t rd,
                               std::uint32_t rs1, std::uint32_t rs2) {
    return funct7 << 25U | rs2 << 20U | rs1 << 15U | funct3 << 12U | rd << 7U | 0x33U;
}
constexpr std::uint32_t i_type(std::uint32_t opcode, std::uint32_t funct3, std::uint32_t rd,
                               std::uint32_t rs1, std::int32_t immediate) {
    return static_cast<std::uint32_t>(immediate) << 20U | rs1 << 15U | funct3 << 12U | rd << 7U |
           opcode;
}
constexpr std::uint32_t s_type(std::uint32_t funct3, std::uint32_t rs1, std::uint32_t rs2,
                               std::int32_t immediate) {
    const auto i = static_cast<std::uint32_t>(immediate);
    return (i >> 5U & 127U) << 25U | rs2 << 20U | rs1 << 15U | funct3 << 12U | (i & 31U) << 7U |
           0x23U;
}
constexpr std::uint32_t b_type(std::uint32_t funct3, std::uint32_t rs1, std::uint32_t rs2,
                               std::int32_t offset) {
    const auto i = static_cast<std::uint32_t>(offset);
    return (i >> 12U & 1U) << 31U | (i >> 5U & 63U) << 25U | rs2 << 20U | rs1 << 15U |
           funct3 << 12U | (i >> 1U & 15U) << 8U | (i >> 11U & 1U) << 7U | 0x63U;
}
constexpr std::uint32_t j_type(std::uint32_t rd, std::int32_t offset) {
    const auto i = static_cast<std::uint32_t>(offset);
    return (i >> 20U & 1U) << 31U | (i >> 1U & 1023U) << 21U | (i >> 11U & 1U) << 20U |
           (i >> 12U & 255U) << 12U | rd << 7U | 0x6FU;
}

} // namespace rv32::test
