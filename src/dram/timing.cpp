// SPDX-License-Identifier: Apache-2.0
#include "dram/timing.hpp"

#include <algorithm>

namespace degs::dram {
namespace {

/// Collects rules; commands that share one are given together.
class RuleList {
public:
    void add(const char* name, Scope scope, const std::vector<Command>& previous,
             const std::vector<Command>& next, int gap) {
        for (const Command before : previous) {
            for (const Command after : next) {
                const Ck least = std::max(gap, 1);
                rules.push_back({before, after, scope, least, name});
            }
        }
    }
    std::vector<Rule> rules;
};

int or_else(int value, int other) {
    return value != 0 ? value : other;
}

const std::vector<Command> kReads{Command::Rd, Command::RdA};
const std::vector<Command> kWrites{Command::Wr, Command::WrA};

void add_bank_rules(RuleList& list, const Timing& t) {
    const int write_end = t.wl + t.burst();
    list.add("tRCD", Scope::Bank, {Command::Act1}, {Command::Rd}, t.rcd);
    list.add("tRCD", Scope::Bank, {Command::Act1}, {Command::Wr}, or_else(t.rcd_wr, t.rcd));
    list.add("tRC", Scope::Bank, {Command::Act1}, {Command::Act1, Command::RefPb}, t.ras + t.rp_pb);
    list.add("tRAS", Scope::Bank, {Command::Act1}, {Command::Pre}, t.ras);
    list.add("tRTP", Scope::Bank, kReads, {Command::Pre}, t.rtp);
    list.add("tWR", Scope::Bank, kWrites, {Command::Pre}, write_end + t.wr);
    list.add("tRPpb", Scope::Bank, {Command::Pre}, {Command::Act1, Command::RefPb}, t.rp_pb);
    list.add("tRTP+tRPpb", Scope::Bank, {Command::RdA}, {Command::Act1, Command::RefPb},
             t.rtp + t.rp_pb);
    list.add("tWR+tRPpb", Scope::Bank, {Command::WrA}, {Command::Act1, Command::RefPb},
             write_end + t.wr + t.rp_pb);
    list.add("tRFCpb", Scope::Bank, {Command::RefPb}, {Command::Act1, Command::RefPb}, t.rfc_pb);
}

void add_column_rules(RuleList& list, const Timing& t) {
    const int burst = t.burst();
    list.add("tCCD_S", Scope::Channel, kReads, {Command::Rd}, burst);
    list.add("tCCD_S", Scope::Channel, kWrites, {Command::Wr}, burst);
    list.add("tRTW", Scope::Channel, kReads, {Command::Wr}, t.read_to_write());
    list.add("tWTR_S", Scope::Channel, kWrites, {Command::Rd}, t.wl + burst + t.wtr_s);
    if (t.groups() > 1) { // the longer ones: BL/n_max in place of BL/n_min
        list.add("tCCD_L", Scope::Group, kReads, {Command::Rd}, t.ccd_l);
        list.add("tCCD_L", Scope::Group, kWrites, {Command::Wr}, or_else(t.ccd_l_wr, t.ccd_l));
        list.add("tWTR_L", Scope::Group, kWrites, {Command::Rd},
                 t.wl + or_else(t.bl_n_max, t.ccd_l) + t.wtr_l);
    }
}

void add_row_rules(RuleList& list, const Timing& t) {
    const int write_end = t.wl + t.burst();
    list.add("tRRD", Scope::Channel, {Command::Act1}, {Command::Act1, Command::RefPb}, t.rrd);
    if (t.groups() > 1 && t.rrd_l != 0) {
        list.add("tRRD_L", Scope::Group, {Command::Act1}, {Command::Act1}, t.rrd_l);
    }
    list.add("tPPD", Scope::Channel, {Command::Pre}, {Command::Pre, Command::PreAb}, t.ppd);
    list.add("tRAS", Scope::Channel, {Command::Act1}, {Command::PreAb}, t.ras);
    list.add("tRTP", Scope::Channel, kReads, {Command::PreAb}, t.rtp);
    list.add("tWR", Scope::Channel, kWrites, {Command::PreAb}, write_end + t.wr);
    list.add("tRPab", Scope::Channel, {Command::PreAb},
             {Command::Act1, Command::RefAb, Command::RefPb}, t.rp_ab);
}

void add_refresh_rules(RuleList& list, const Timing& t) {
    const int write_end = t.wl + t.burst();
    list.add("tRC", Scope::Channel, {Command::Act1}, {Command::RefAb}, t.ras + t.rp_pb);
    list.add("tRPpb", Scope::Channel, {Command::Pre}, {Command::RefAb}, t.rp_pb);
    list.add("tRTP+tRPpb", Scope::Channel, {Command::RdA}, {Command::RefAb}, t.rtp + t.rp_pb);
    list.add("tWR+tRPpb", Scope::Channel, {Command::WrA}, {Command::RefAb},
             write_end + t.wr + t.rp_pb);
    list.add("tRFCab", Scope::Channel, {Command::RefAb},
             {Command::Act1, Command::RefAb, Command::RefPb}, t.rfc_ab);
    list.add("tRFCpb", Scope::Channel, {Command::RefPb}, {Command::RefAb}, t.rfc_pb);
    list.add("tpbR2act", Scope::Channel, {Command::RefPb}, {Command::Act1}, t.pbr2act);
    list.add("tpbR2pbR", Scope::Channel, {Command::RefPb}, {Command::RefPb}, t.pbr2pbr);
}

// A bus of their own for row commands holds one at a time, too.
void add_bus_rules(RuleList& list, const Timing& t) {
    const std::vector<Command> rows{Command::Act1,  Command::Act2,  Command::Pre,
                                    Command::PreAb, Command::RefAb, Command::RefPb};
    if (t.command_buses == 2) {
        list.add("bus", Scope::Channel, rows, rows, t.command_ck);
    }
}

/// The burst length that is proposed; empty if there is none.
std::string beats_for_32_bytes(const Timing& t) {
    constexpr int kBits = 256;
    const int beats = t.pins > 0 ? kBits / t.pins : 0;
    const bool fits = beats * t.pins == kBits && beats >= 8 && beats % t.beats_per_ck == 0;
    return fits && t.burst_data_bytes == 0 ? std::to_string(beats) : "";
}

void describe_burst(Timing& t, ConfigVisitor& v) {
    v.integer("burst_length", t.burst_length, 8, 64,
              "beats of a column command: 16 = 32 B of LPDDR5; 32 = 64 B, in 16b mode only here");
    v.require(t.burst_length % t.beats_per_ck == 0, {"burst_length",
                                                     "must be a multiple of beats_per_ck",
                                                     beats_for_32_bytes(t),
                                                     {"beats_per_ck"}});
    v.integer("burst_data_bytes", t.burst_data_bytes, 0, 64,
              "bytes of data in a burst, 32 or 64; 0: pins * burst_length / 8; less of LPDDR6, "
              "whose bursts carry 4 B beside 32");
    v.require(t.burst_data_bytes % 32 == 0, {"burst_data_bytes", "must be 0, 32 or 64", "0"});
    const unsigned bytes = t.burst_bytes();
    v.require(bytes == 32 || bytes == 64,
              {"burst_length",
               "must make bursts of 32 or 64 bytes with the pins (or burst_data_bytes)",
               beats_for_32_bytes(t),
               {"pins", "burst_data_bytes"}});
    v.require(8 * t.burst_data_bytes <= t.pins * t.burst_length,
              {"burst_data_bytes", "must fit pins * burst_length / 8", "0", {"pins"}});
    const bool halves = t.bank_mode == Timing::BankMode::Bg && t.burst_length == 32 && t.pins == 16;
    v.require(!halves, {"burst_length",
                        "must be 16 in bank mode bg, where a burst in two halves is not modelled",
                        "",
                        {"bank_mode"}});
}

void describe_commands(Timing& t, ConfigVisitor& v) {
    v.integer("command_buses", t.command_buses, 1, 2,
              "1: all commands in turn; 2: row and column commands beside each other (HBM)");
    v.integer("command_ck", t.command_ck, 1, 4, "CK that a command holds its bus; 2 in LPDDR6");
    v.integer("act_commands", t.act_commands, 1, 2,
              "of an activation: 2 are ACT-1 and ACT-2 of LPDDR, 1 the ACT of other DRAMs");
}

void describe_organisation(Timing& t, ConfigVisitor& v) {
    v.integer("data_rate_mt_per_s", t.data_rate_mt_per_s, 533, 32000,
              "MT/s per pin; 6400 is the paper's memory");
    v.integer("pins", t.pins, 8, 64, "data pins of a channel: x16");
    v.integer("beats_per_ck", t.beats_per_ck, 2, 8,
              "beats of data in a CK, a power of two: 8 with WCK:CK = 4:1 of LPDDR5");
    v.require_power_of_two("beats_per_ck", t.beats_per_ck);
    v.choice("bank_mode", t.bank_mode, {"bg", "16b"},
             "bg: 4 groups of 4 banks, needed above 3200 MT/s; 16b: 16 banks without groups");
    constexpr int kFastest16b = 3200; // JESD209-5B: 16 banks without groups end there
    v.require(t.bank_mode == Timing::BankMode::Bg || t.data_rate_mt_per_s <= kFastest16b,
              {"bank_mode", "must be bg above 3200 MT/s", "bg", {"data_rate_mt_per_s"}});
    v.integer("banks", t.banks, 16, kMostBanks, "of a channel, a power of two");
    v.require_power_of_two("banks", t.banks);
    v.require(t.banks == 16 || t.bank_mode == Timing::BankMode::Bg,
              {"banks", "must be 16 without groups", "16", {"bank_mode"}});
    v.integer("page_bytes", t.page_bytes, 1024, 8192, "of a row, a power of two");
    v.require_power_of_two("page_bytes", t.page_bytes);
    describe_burst(t, v);
    describe_commands(t, v);
    v.integer("rows", t.rows, 1024, 262144,
              "per bank, a power of two; 32768 = 8 Gb per x16 channel, 65536 = 16 Gb");
    v.require_power_of_two("rows", t.rows);
}

void describe_access(Timing& t, ConfigVisitor& v) {
    v.integer("rl", t.rl, 1, 200, "CK; RD to first beat, set by a mode register");
    v.integer("wl", t.wl, 1, 200, "CK; WR to first beat, set A of the mode register");
    const int read_end = t.rl + t.burst() + 2;
    v.require(t.wl < read_end || t.rtw != 0,
              {"wl",
               "must be below rl + burst_length / beats_per_ck + 2 where rtw is 0",
               std::to_string(std::min(read_end - 1, 200)),
               {"rl", "burst_length"}});
    v.integer("rtw", t.rtw, 0, 200, "CK; RD to WR; 0: rl + BL/n + 2 - wl");
    v.integer("rcd", t.rcd, 1, 200, "CK; ACT-1 to RD or WR, max(2 CK, 18 ns)");
    v.integer("rcd_wr", t.rcd_wr, 0, 200, "CK; ACT-1 to WR where it is another; 0: rcd");
    v.integer("rp_pb", t.rp_pb, 1, 200, "CK; PRE of a bank to ACT-1, max(2 CK, 18 ns)");
    v.integer("rp_ab", t.rp_ab, 1, 200, "CK; PRE of all banks to ACT-1, max(2 CK, 21 ns)");
    v.integer("ras", t.ras, 1, 500, "CK; ACT-1 to PRE, max(3 CK, 42 ns)");
    v.integer("rrd", t.rrd, 1, 200, "CK; ACT-1 to ACT-1 of any other bank, 5 ns");
    v.integer("rrd_l", t.rrd_l, 0, 200, "CK; the same in a bank group; 0: rrd; bg mode only");
    v.integer("faw", t.faw, 1, 500, "CK; window that holds four ACT-1 at most, 20 ns");
    v.integer("aad", t.aad, 3, 64, "CK; ACT-2 follows ACT-1 within this, 8 CK");
    v.integer("ppd", t.ppd, 1, 64, "CK; PRE to PRE, 2 CK");
    v.integer("ccd_l", t.ccd_l, 1, 64,
              "CK; column command to the next of its kind in a bank group, BL/n_max; bg mode only");
    v.integer("ccd_l_wr", t.ccd_l_wr, 0, 200, "CK; the same of WR; 0: ccd_l; bg mode only");
    v.integer("bl_n_max", t.bl_n_max, 0, 64,
              "CK; end of write data in its group, for wtr_l; 0: ccd_l, as in LPDDR5");
    v.integer("wr", t.wr, 1, 500, "CK; end of write data to PRE, max(3 CK, 34 ns)");
    v.integer("wtr_s", t.wtr_s, 1, 200,
              "CK; end of write data to RD, other group: max(4 CK, 6.25 ns); 16b mode: 12 ns");
    v.integer("wtr_l", t.wtr_l, 1, 200,
              "CK; the same in one bank group, max(4 CK, 12 ns); bg mode only");
    v.integer("rtp", t.rtp, 1, 200, "CK; RD to PRE; the longer of two readings of 7.5 ns");
}

void describe_refresh(Timing& t, ConfigVisitor& v) {
    v.integer("refi", t.refi, 100, 1000000, "CK; all-bank refreshes come this often: 32 ms / 8192");
    v.integer("rfc_ab", t.rfc_ab, 1, 4000, "CK; all-bank refresh: 210 ns at 8 Gb, 280 at 16 Gb");
    v.integer("rfc_pb", t.rfc_pb, 1, 4000, "CK; per-bank refresh: 120 ns at 8 Gb, 140 at 16 Gb");
    v.integer("pbr2pbr", t.pbr2pbr, 1, 4000, "CK; per-bank refresh to the next, 90 ns");
    v.integer("pbr2act", t.pbr2act, 1, 1000, "CK; per-bank refresh to ACT-1 elsewhere, 7.5 ns");
    const auto steps = static_cast<int>(t.refresh_steps());
    v.require_at_least(
        "refi", t.refi,
        std::max(t.rfc_ab + t.rp_ab + t.ras + t.wl + t.wr + 1, steps * (t.pbr2pbr + 1)),
        "to leave time between two refreshes, all-bank and per-bank",
        {"rfc_ab", "rp_ab", "ras", "wl", "wr", "pbr2pbr"});
}

struct CommandText {
    const char* name;
    const char* sentence;
};

constexpr CommandText kCommandTexts[kCommands] = {
    {"act1", "ACT-1: first half of the activation of a row."},
    {"act2", "ACT-2: second half; the row is open after it."},
    {"rd", "RD: reads a burst."},
    {"wr", "WR: writes a burst."},
    {"rda", "RDA: reads a burst, then closes the row (auto-precharge)."},
    {"wra", "WRA: writes a burst, then closes the row (auto-precharge)."},
    {"pre", "PRE: closes the row of a bank."},
    {"pre_ab", "PREab: closes the rows of all banks."},
    {"ref_ab", "REFab: refreshes all banks."},
    {"ref_pb", "REFpb: refreshes a pair of banks."},
};

} // namespace

const char* command_name(Command command) {
    return of_kind(kCommandTexts, command).name;
}

const char* command_sentence(Command command) {
    return of_kind(kCommandTexts, command).sentence;
}

void Timing::describe(ConfigVisitor& visitor) {
    describe_organisation(*this, visitor);
    describe_access(*this, visitor);
    describe_refresh(*this, visitor);
}

std::vector<Rule> rules(const Timing& timing) {
    RuleList list;
    add_bank_rules(list, timing);
    add_column_rules(list, timing);
    add_row_rules(list, timing);
    add_refresh_rules(list, timing);
    add_bus_rules(list, timing);
    return list.rules;
}

// The longest of several gaps to the same command counts.
void RuleTable::Steps::add(const Step& added) {
    Step* const last = step.data() + count;
    Step* const same =
        std::find_if(step.data(), last, [&](const Step& s) { return s.next == added.next; });
    if (same != last) {
        same->gap = std::max(same->gap, added.gap);
    } else {
        step.at(count++) = added;
    }
}

RuleTable::RuleTable(const Timing& timing)
    : banks_(timing.banks), group_shift_(timing.groups() == 1 ? 4 : 2),
      refresh_distance_(timing.refresh_steps()), faw_(timing.faw) {
    static_assert(kGroupBanks == 1U << 2);
    for (const Rule& rule : rules(timing)) {
        of_kind(of_kind(steps_, rule.previous), rule.scope)
            .add({static_cast<std::uint16_t>(rule.next), static_cast<std::uint16_t>(rule.gap)});
    }
}

void Dates::apply(Command command, unsigned bank, Ck date) {
    for (const auto& step : table_->after(command, Scope::Bank)) {
        Ck& next = bank_[step.next][bank];
        next = std::max(next, date + step.gap);
    }
}

void Dates::issue(Command command, unsigned bank, Ck date) {
    apply(command, bank, date);
    if (command == Command::RefPb) {
        apply(command, table_->refresh_partner(bank), date);
    }
    const unsigned group = table_->group_of(bank);
    for (const auto& step : table_->after(command, Scope::Group)) {
        Ck& next = group_[step.next][group];
        next = std::max(next, date + step.gap);
    }
    for (const auto& step : table_->after(command, Scope::Channel)) {
        Ck& next = channel_[step.next];
        next = std::max(next, date + step.gap);
    }
    if (command == Command::Act1) {
        window_[oldest_] = date + table_->faw();
        oldest_ = (oldest_ + 1) % 4;
    }
}

} // namespace degs::dram
