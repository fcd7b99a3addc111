// SPDX-License-Identifier: Apache-2.0
#include "rv32.hpp"

namespace rv32 {
namespace {

constexpr std::uint32_t kIsa = 1U << 30U | 1U << 8U | 1U << 12U; // misa: 32 bits, I and M

std::uint32_t low(std::uint64_t value) {
    return static_cast<std::uint32_t>(value);
}

} // namespace

bool Core::read_csr(std::uint32_t csr, std::uint32_t& value) const {
    switch (csr) {
    case kMstatus:
        value = mstatus_;
        return true;
    case kMisa:
        value = kIsa;
        return true;
    case kMie:
        value = mie_;
        return true;
    case kMip:
        value = mip_;
        return true;
    case kMtvec:
        value = mtvec_;
        return true;
    case kMscratch:
        value = mscratch_;
        return true;
    case kMepc:
        value = mepc_;
        return true;
    case kMcause:
        value = mcause_;
        return true;
    case kMtval:
        value = mtval_;
        return true;
    case kMcycle:
        value = low(cycles_);
        return true;
    case kMcycleHigh:
        value = low(cycles_ >> 32U);
        return true;
    case kMinstret:
        value = low(retired_);
        return true;
    case kMinstretHigh:
        value = low(retired_ >> 32U);
        return true;
    default:
        value = 0; // vendor, architecture, implementation and hart are number 0
        return csr >= kMvendorid && csr <= kMhartid;
    }
}

bool Core::write_csr(std::uint32_t csr, std::uint32_t value) {
    switch (csr) {
    case kMstatus:
        mstatus_ = kMppBits | (value & (kMieBit | kMpieBit));
        return true;
    case kMie:
        mie_ = value & kExternalBit;
        return true;
    case kMtvec:
        mtvec_ = value & ~2U;
        has_vector_ = true;
        return true;
    case kMscratch:
        mscratch_ = value;
        return true;
    case kMepc:
        mepc_ = value & ~3U;
        return true;
    case kMcause:
        mcause_ = value;
        return true;
    case kMtval:
        mtval_ = value;
        return true;
    default: // misa has no other value, mip only follows the line, and counters cannot be set
        return csr == kMisa || csr == kMip;
    }
}

} // namespace rv32
