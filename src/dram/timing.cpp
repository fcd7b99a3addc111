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

const std::vector<Command> kReads{Command::Rd, Command::RdA};
const std::vector<Command> kWrites{Command::Wr, Command::WrA};

void add_bank_rules(RuleList& list, const Timing& t) {
    const int write_end = t.wl + t.burst();
    list.add("tRCD", Scope::Bank, {Command::Act1}, {Command::Rd, Command::Wr}, t.rcd);
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
    list.add("tRTW", Scope::Channel, kReads, {Command::Wr}, t.rl + burst + 2 - t.wl);
    list.add("tWTR_S", Scope::Channel, kWrites, {Command::Rd}, t.wl + burst + t.wtr_s);
    if (t.groups() > 1) { // the longer ones: BL/n_max in place of BL/n_min
        list.add("tCCD_L", Scope::Group, kReads, {Command::Rd}, t.ccd_l);
        list.add("tCCD_L", Scope::Group, kWrites, {Command::Wr}, t.ccd_l);
        list.add("tWTR_L", Scope::Group, kWrites, {Command::Rd}, t.wl + t.ccd_l + t.wtr_l);
    }
}

void add_row_rules(RuleList& list, const Timing& t) {
    const int write_end = t.wl + t.burst();
    list.add("tRRD", Scope::Channel, {Command::Act1}, {Command::Act1, Command::RefPb}, t.rrd);
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

void describe_organisation(Timing& t, ConfigVisitor& v) {
    v.integer("data_rate_mt_per_s", t.data_rate_mt_per_s, 533, 9600,
              "MT/s per pin; CK is an eighth of it (WCK:CK = 4:1); 6400 is the paper's memory");
    v.choice("bank_mode", t.bank_mode, {"bg", "16b"},
             "bg: 4 groups of 4 banks, needed above 3200 MT/s; 16b: 16 banks without groups");
    constexpr int kFastest16b = 3200; // JESD209-5B: 16 banks without groups end there
    v.require(t.bank_mode == Timing::BankMode::Bg || t.data_rate_mt_per_s <= kFastest16b,
              {"bank_mode", "must be bg above 3200 MT/s", "bg", {"data_rate_mt_per_s"}});
    v.integer("burst_length", t.burst_length, 16, 32,
              "beats of a column command: 16 = 32 B; 32 = 64 B, in 16b mode only here");
    v.require(t.burst_length == 16 || t.burst_length == 32,
              {"burst_length", "must be 16 or 32", ""});
    v.require(t.burst_length == 16 || t.bank_mode == Timing::BankMode::Banks16,
              {"burst_length",
               "must be 16 in bank mode bg, where a burst in two halves is not modelled",
               "",
               {"bank_mode"}});
    v.integer("rows", t.rows, 1024, 262144,
              "per bank, a power of two; 32768 = 8 Gb per x16 channel, 65536 = 16 Gb");
    v.require_power_of_two("rows", t.rows);
}

void describe_access(Timing& t, ConfigVisitor& v) {
    v.integer("rl", t.rl, 1, 200, "CK; RD to first beat, set by a mode register");
    v.integer("wl", t.wl, 1, 200, "CK; WR to first beat, set A of the mode register");
    const int read_end = t.rl + t.burst_length / 8 + 2;
    v.require(t.wl < read_end, {"wl",
                                "must be below rl + burst_length / 8 + 2",
                                std::to_string(std::min(read_end - 1, 200)),
                                {"rl", "burst_length"}});
    v.integer("rcd", t.rcd, 1, 200, "CK; ACT-1 to RD or WR, max(2 CK, 18 ns)");
    v.integer("rp_pb", t.rp_pb, 1, 200, "CK; PRE of a bank to ACT-1, max(2 CK, 18 ns)");
    v.integer("rp_ab", t.rp_ab, 1, 200, "CK; PRE of all banks to ACT-1, max(2 CK, 21 ns)");
    v.integer("ras", t.ras, 1, 500, "CK; ACT-1 to PRE, max(3 CK, 42 ns)");
    v.integer("rrd", t.rrd, 1, 200, "CK; ACT-1 to ACT-1 of any other bank, 5 ns");
    v.integer("faw", t.faw, 1, 500, "CK; window that holds four ACT-1 at most, 20 ns");
    v.integer("aad", t.aad, 3, 64, "CK; ACT-2 follows ACT-1 within this, 8 CK");
    v.integer("ppd", t.ppd, 1, 64, "CK; PRE to PRE, 2 CK");
    v.integer("ccd_l", t.ccd_l, 1, 64,
              "CK; column command to the next of its kind in a bank group, BL/n_max; bg mode only");
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
    const int steps = kRefreshSteps;
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
    return list.rules;
}

RuleTable::RuleTable(const Timing& timing)
    : group_shift_(timing.groups() == 1 ? 4 : 2), faw_(timing.faw) {
    for (const Rule& rule : rules(timing)) {
        Steps& steps = of_kind(of_kind(steps_, rule.previous), rule.scope);
        steps.step.at(steps.count++) = {static_cast<std::uint16_t>(rule.next),
                                        static_cast<std::uint16_t>(rule.gap)};
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
        apply(command, bank ^ kRefreshPartner, date);
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
