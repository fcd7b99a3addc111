// SPDX-License-Identifier: Apache-2.0
// When a command may follow another on one channel of a DRAM: the parameters of one device and
// speed, the constraints as a table of rules, and the dates that follow from issued commands. The
// commands and their rules are those of LPDDR5; keys turn off what other DRAMs do without.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "config/config.hpp"

namespace degs::dram {

/// A date or a duration in cycles of the command clock CK (1.25 ns for LPDDR5 at 6400 MT/s). A
/// channel is plain arithmetic without SystemC.
using Ck = std::uint64_t;
/// Later than anything; half the range, so that adding a gap cannot wrap.
constexpr Ck kNoDate = ~Ck{0} / 2;

/// The commands of the bus. RdA and WrA close their bank by themselves (auto-precharge); PreAb and
/// RefAb mean all banks, RefPb a pair of them.
enum class Command : std::uint8_t { Act1, Act2, Rd, Wr, RdA, WrA, Pre, PreAb, RefAb, RefPb };
constexpr std::size_t kCommands = 10;
const char* command_name(Command command);
const char* command_sentence(Command command);
constexpr bool is_column(Command command) {
    return command >= Command::Rd && command <= Command::WrA;
}

constexpr unsigned kMostBanks = 32; ///< of a channel
constexpr unsigned kGroupBanks = 4; ///< of a bank group, in all DRAMs with groups
constexpr unsigned kMostGroups = kMostBanks / kGroupBanks;
constexpr unsigned kAccessBytes = 64; ///< what a controller queue's entry covers

/// The first bank of a mask that is not empty.
inline unsigned first_bank(std::uint32_t banks) {
    return __builtin_ctz(banks);
}

/// The element of one of several kinds, e.g. the counter of a command.
template <class PerKind, class Kind>
auto& of_kind(PerKind& each, Kind kind) {
    return each[static_cast<std::size_t>(kind)];
}

/// Organisation and timing of one channel. Durations in CK, rounded up; defaults are LPDDR5 at 6400
/// MT/s in BG mode with 8 Gb per channel (JESD209-5B as restated by public simulators, see
/// docs/lpddr5.md); docs/memories.md has others. Where a comment says so, 0 stands for another key.
/// Not modelled: 8B mode, start and stop of WCK (always running), power-down, ranks, DVFS.
struct Timing {
    enum class BankMode : std::uint8_t { Bg, Banks16 };
    int data_rate_mt_per_s = 6400;
    int pins = 16;
    int beats_per_ck = 8;
    BankMode bank_mode = BankMode::Bg;
    int banks = 16;
    int page_bytes = 2048;
    int burst_length = 16;
    int burst_data_bytes = 0; // 0: all bits of a burst
    int rows = 32768;
    int command_buses = 1;
    int command_ck = 1;
    int act_commands = 2;
    int rl = 17, wl = 9;
    int rcd = 15, rcd_wr = 0, rp_pb = 15, rp_ab = 17, ras = 34; // rcd_wr 0: rcd
    int rrd = 4, rrd_l = 0, faw = 16, aad = 8, ppd = 2;         // rrd_l 0: rrd
    int ccd_l = 4, ccd_l_wr = 0, bl_n_max = 0;                  // both 0: ccd_l
    int rtw = 0;                                                // 0: rl + BL/n + 2 - wl
    int wr = 28, wtr_s = 5, wtr_l = 10, rtp = 8;
    int refi = 3125, rfc_ab = 168, rfc_pb = 96, pbr2pbr = 72, pbr2act = 6;

    void describe(ConfigVisitor& visitor);

    unsigned groups() const { return bank_mode == BankMode::Bg ? banks / kGroupBanks : 1; }
    double ck_ns() const { return 1000.0 * beats_per_ck / data_rate_mt_per_s; }
    /// The bytes of a burst that are data; LPDDR6 carries others beside them.
    unsigned burst_bytes() const {
        return burst_data_bytes != 0 ? burst_data_bytes : pins * burst_length / 8;
    }
    /// BL/n: CK of data bus that a burst takes.
    int burst() const { return burst_length / beats_per_ck; }
    int rc() const { return ras + rp_pb; }
    int read_to_write() const { return rtw != 0 ? rtw : rl + burst() + 2 - wl; }
    int read_latency() const { return rl + burst(); }  ///< RD to its last beat
    int write_latency() const { return wl + burst(); } ///< WR to its last beat
    bool has_act2() const { return act_commands == 2; }
    /// A per-bank refresh takes bank b together with b + refresh_steps().
    unsigned refresh_steps() const { return banks / 2; }
    /// The peak bandwidth of a channel, 1e9 B/s.
    double peak_gb_per_s() const {
        return 1.0 * burst_bytes() * data_rate_mt_per_s / burst_length / 1000.0;
    }
};

/// The commands that a rule looks back at.
enum class Scope : std::uint8_t { Bank, Group, Channel };
constexpr std::size_t kScopes = 3;

/// `next` may come `gap` CK after `previous` of the same scope at the earliest. `next` is never RdA
/// or WrA: these follow the rules of Rd and Wr.
struct Rule {
    Command previous, next;
    Scope scope;
    Ck gap;
    const char* name;
};

/// Every constraint between two commands. Two constraints are not of this kind: tFAW, and one
/// command at a time on a bus that all share.
std::vector<Rule> rules(const Timing& timing);

/// The rules sorted by what has been issued; made once, shared by all channels.
class RuleTable {
public:
    struct Step {
        std::uint16_t next = 0;
        std::uint16_t gap = 0;
    };
    struct Steps { // contiguous, since every command walks three of them
        std::uint32_t count = 0;
        std::array<Step, kCommands> step{}; // one per `next` at most
        const Step* begin() const { return step.data(); }
        const Step* end() const { return step.data() + count; }
        void add(const Step& added);
    };

    explicit RuleTable(const Timing& timing);
    const Steps& after(Command previous, Scope scope) const {
        return of_kind(of_kind(steps_, previous), scope);
    }
    unsigned group_of(unsigned bank) const { return bank >> group_shift_; }
    unsigned banks() const { return banks_; }
    unsigned refresh_partner(unsigned bank) const { return bank ^ refresh_distance_; }
    Ck faw() const { return faw_; }

private:
    std::array<std::array<Steps, kScopes>, kCommands> steps_;
    unsigned banks_, group_shift_, refresh_distance_;
    Ck faw_;
};

/// The earliest legal date of every command of one channel, given those issued so far. It does not
/// check the state of banks: the caller issues a Rd only to an open row.
class Dates {
public:
    explicit Dates(const RuleTable& table) : table_(&table) {}

    Ck earliest(Command command, unsigned bank) const {
        return std::max(of_bank(command, bank), of_others(command, table_->group_of(bank)));
    }
    /// The two parts of it. The part of the bank changes only with commands to the bank.
    Ck of_bank(Command command, unsigned bank) const { return bank_[kind(command)][bank]; }
    Ck of_others(Command command, unsigned group) const {
        const std::size_t c = kind(command);
        const Ck date = std::max(group_[c][group], channel_[c]);
        return command == Command::Act1 ? std::max(date, window_[oldest_]) : date;
    }
    unsigned group_of(unsigned bank) const { return table_->group_of(bank); }
    const RuleTable& table() const { return *table_; }
    void issue(Command command, unsigned bank, Ck date);

private:
    static std::size_t kind(Command command) {
        return static_cast<std::size_t>(command == Command::RdA   ? Command::Rd
                                        : command == Command::WrA ? Command::Wr
                                                                  : command);
    }
    void apply(Command command, unsigned bank, Ck date);

    const RuleTable* table_;
    std::array<std::array<Ck, kMostBanks>, kCommands> bank_{};
    std::array<std::array<Ck, kMostGroups>, kCommands> group_{};
    std::array<Ck, kCommands> channel_{};
    std::array<Ck, 4> window_{}; // tFAW after each of the last four activations
    unsigned oldest_ = 0;        // of them
};

} // namespace degs::dram
