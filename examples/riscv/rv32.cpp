// SPDX-License-Identifier: Apache-2.0
#include "rv32.hpp"

namespace rv32 {
namespace {

enum Opcode : std::uint32_t {
    kLoad = 0x03,
    kFence = 0x0F,
    kImmediate = 0x13,
    kAuipc = 0x17,
    kStore = 0x23,
    kRegister = 0x33,
    kLui = 0x37,
    kBranch = 0x63,
    kJalr = 0x67,
    kJal = 0x6F,
    kSystem = 0x73,
};
constexpr std::uint32_t kEcall = 0x00000073, kEbreak = 0x00100073, kMret = 0x30200073,
                        kWfi = 0x10500073;
constexpr std::uint32_t kLeast = 0x80000000U; // the least signed number

std::int32_t as_signed(std::uint32_t value) {
    return static_cast<std::int32_t>(value);
}

/// value / 2^by, rounded down, of a value whose sign is its bit 31. by: 0 to 31.
std::uint32_t arithmetic_shift(std::uint32_t value, std::uint32_t by) {
    return static_cast<std::uint32_t>(as_signed(value) >> by);
}

/// The upper half of a product whose factors have 33 bits with sign.
std::uint32_t high(std::int64_t a, std::int64_t b) {
    return static_cast<std::uint32_t>(static_cast<std::uint64_t>(a * b) >> 32U);
}

std::uint32_t multiply_or_divide(std::uint32_t kind, std::uint32_t a, std::uint32_t b) {
    const std::int64_t sa = as_signed(a), sb = as_signed(b), ua = a;
    const bool overflow = a == kLeast && b == ~0U;
    switch (kind) {
    case 0:
        return a * b;
    case 1:
        return high(sa, sb);
    case 2:
        return high(sa, b);
    case 3:
        return static_cast<std::uint32_t>((static_cast<std::uint64_t>(ua) * b) >> 32U);
    case 4:
        return b == 0 ? ~0U : overflow ? kLeast : static_cast<std::uint32_t>(sa / sb);
    case 5:
        return b == 0 ? ~0U : a / b;
    case 6:
        return b == 0 ? a : overflow ? 0 : static_cast<std::uint32_t>(sa % sb);
    default:
        return b == 0 ? a : a % b;
    }
}

std::uint32_t compute(std::uint32_t kind, bool alternative, std::uint32_t a, std::uint32_t b) {
    switch (kind) {
    case 0:
        return alternative ? a - b : a + b;
    case 1:
        return a << (b & 31U);
    case 2:
        return as_signed(a) < as_signed(b) ? 1 : 0;
    case 3:
        return a < b ? 1 : 0;
    case 4:
        return a ^ b;
    case 5:
        return alternative ? arithmetic_shift(a, b & 31U) : a >> (b & 31U);
    case 6:
        return a | b;
    default:
        return a & b;
    }
}

} // namespace

struct Core::Fields {
    std::uint32_t word;
    std::uint32_t opcode() const { return word & 0x7FU; }
    unsigned rd() const { return word >> 7U & 31U; }
    std::uint32_t funct3() const { return word >> 12U & 7U; }
    unsigned rs1() const { return word >> 15U & 31U; }
    unsigned rs2() const { return word >> 20U & 31U; }
    std::uint32_t funct7() const { return word >> 25U; }
    std::uint32_t i() const { return arithmetic_shift(word, 20); }
    std::uint32_t s() const { return (i() & ~31U) | rd(); }
    std::uint32_t b() const { return (s() & ~0x801U) | (word << 4U & 0x800U); }
    std::uint32_t u() const { return word & ~0xFFFU; }
    std::uint32_t j() const {
        return (arithmetic_shift(word, 11) & ~0xFFFFFU) | (word & 0xFF000U) |
               (word >> 9U & 0x800U) | (word >> 20U & 0x7FEU);
    }
};

void Core::set_external_interrupt(bool is_high) {
    mip_ = is_high ? mip_ | kExternalBit : mip_ & ~kExternalBit;
    waiting_ = waiting_ && !enabled_interrupt();
}

void Core::step() {
    if (waiting_) {
        return;
    }
    ++cycles_;
    if (enabled_interrupt() && (mstatus_ & kMieBit) != 0) {
        next_pc_ = pc_;
        enter_trap(kExternalInterrupt, 0);
        return;
    }
    std::uint32_t word = 0;
    next_pc_ = pc_ + 4;
    const bool done = memory_.fetch(pc_, word) ? execute(word) : exception(kFetchFault, pc_);
    if (done) {
        ++retired_;
        pc_ = next_pc_;
    }
}

void Core::enter_trap(std::uint32_t cause, std::uint32_t value) {
    trapped_without_vector_ = trapped_without_vector_ || !has_vector_;
    mepc_ = pc_;
    mcause_ = cause;
    mtval_ = value;
    mstatus_ = kMppBits | ((mstatus_ & kMieBit) != 0 ? kMpieBit : 0);
    const bool vectored = (mtvec_ & 1U) != 0 && (cause & kInterrupt) != 0;
    pc_ = (mtvec_ & ~3U) + (vectored ? 4 * (cause & ~kInterrupt) : 0);
}

bool Core::exception(std::uint32_t cause, std::uint32_t value) {
    enter_trap(cause, value);
    return false;
}

bool Core::execute(std::uint32_t word) {
    const Fields f{word};
    switch (f.opcode()) {
    case kLui:
        set_x(f.rd(), f.u());
        return true;
    case kAuipc:
        set_x(f.rd(), pc_ + f.u());
        return true;
    case kJal:
        if (!jump(pc_ + f.j())) {
            return false;
        }
        set_x(f.rd(), pc_ + 4);
        return true;
    case kJalr:
        if (f.funct3() != 0) {
            break;
        }
        if (!jump((x_[f.rs1()] + f.i()) & ~1U)) {
            return false;
        }
        set_x(f.rd(), pc_ + 4);
        return true;
    case kBranch:
        return branch(f);
    case kLoad:
        return load(f);
    case kStore:
        return store(f);
    case kImmediate:
    case kRegister:
        return arithmetic(f);
    case kFence: // accesses are in order, and no instruction is kept
        return f.funct3() <= 1 || exception(kIllegalInstruction, word);
    case kSystem:
        return system(f);
    default:
        break;
    }
    return exception(kIllegalInstruction, word);
}

bool Core::jump(std::uint32_t target) {
    if ((target & 3U) != 0) {
        return exception(kMisalignedFetch, target);
    }
    next_pc_ = target;
    return true;
}

bool Core::branch(const Fields& f) {
    const std::uint32_t a = x_[f.rs1()], b = x_[f.rs2()];
    const std::uint32_t relation = f.funct3() >> 1U;
    if (relation == 1) {
        return exception(kIllegalInstruction, f.word);
    }
    const bool holds = relation == 0 ? a == b : relation == 2 ? as_signed(a) < as_signed(b) : a < b;
    const bool negated = (f.funct3() & 1U) != 0;
    return holds == negated || jump(pc_ + f.b());
}

bool Core::load(const Fields& f) {
    const std::uint32_t size = f.funct3() & 3U;
    const bool is_signed = (f.funct3() & 4U) == 0;
    if (size == 3 || (size == 2 && !is_signed)) {
        return exception(kIllegalInstruction, f.word);
    }
    const std::uint32_t address = x_[f.rs1()] + f.i();
    const unsigned bytes = 1U << size;
    std::uint32_t value = 0;
    if (address % bytes != 0) {
        return exception(kMisalignedLoad, address);
    }
    if (!memory_.load(address, bytes, value)) {
        return exception(kLoadFault, address);
    }
    const std::uint32_t spare = 32 - 8 * bytes;
    value <<= spare;
    set_x(f.rd(), is_signed ? arithmetic_shift(value, spare) : value >> spare);
    return true;
}

bool Core::store(const Fields& f) {
    const unsigned bytes = 1U << (f.funct3() & 3U);
    if (f.funct3() > 2) {
        return exception(kIllegalInstruction, f.word);
    }
    const std::uint32_t address = x_[f.rs1()] + f.s();
    if (address % bytes != 0) {
        return exception(kMisalignedStore, address);
    }
    return memory_.store(address, bytes, x_[f.rs2()]) || exception(kStoreFault, address);
}

bool Core::arithmetic(const Fields& f) {
    const bool immediate = f.opcode() == kImmediate;
    const std::uint32_t a = x_[f.rs1()], b = immediate ? f.i() : x_[f.rs2()];
    const bool shift = f.funct3() == 1 || f.funct3() == 5;
    const bool checked = !immediate || shift; // other immediates fill the bits of funct7
    const bool alternative = checked && f.funct7() == 0x20;
    if (!immediate && f.funct7() == 1) {
        set_x(f.rd(), multiply_or_divide(f.funct3(), a, b));
        return true;
    }
    const bool may_be = f.funct3() == 5 || (f.funct3() == 0 && !immediate);
    if (checked && f.funct7() != 0 && !(alternative && may_be)) {
        return exception(kIllegalInstruction, f.word);
    }
    set_x(f.rd(), compute(f.funct3(), alternative, a, b));
    return true;
}

bool Core::system(const Fields& f) {
    switch (f.word) {
    case kEcall:
        return exception(kMachineCall, 0);
    case kEbreak:
        return exception(kBreakpoint, pc_);
    case kMret:
        next_pc_ = mepc_;
        mstatus_ = kMppBits | kMpieBit | ((mstatus_ & kMpieBit) != 0 ? kMieBit : 0);
        return true;
    case kWfi:
        waiting_ = !enabled_interrupt();
        return true;
    default:
        return change_csr(f);
    }
}

bool Core::change_csr(const Fields& f) {
    const std::uint32_t kind = f.funct3() & 3U, csr = f.word >> 20U;
    const std::uint32_t operand = (f.funct3() & 4U) != 0 ? f.rs1() : x_[f.rs1()];
    std::uint32_t old = 0;
    if (kind == 0 || !read_csr(csr, old)) {
        return exception(kIllegalInstruction, f.word);
    }
    const bool writes = kind == 1 || f.rs1() != 0;
    const std::uint32_t value = kind == 1 ? operand : kind == 2 ? old | operand : old & ~operand;
    if (writes && !write_csr(csr, value)) {
        return exception(kIllegalInstruction, f.word);
    }
    set_x(f.rd(), old);
    return true;
}

} // namespace rv32
