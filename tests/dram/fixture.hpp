// SPDX-License-Identifier: Apache-2.0
// The two speeds as nanoseconds of the standard, every gap between two commands derived from them
// once more, and a channel that is fed by hand.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "config/config_source.hpp"
#include "dram/channels.hpp"

namespace degs::test {

using Command = dram::Command;

inline dram::Config lpddr5_config(const std::string& name,
                                  const std::vector<std::string>& overrides = {}) {
    dram::Config memory;
    ConfigSource::from_file(std::string(DEGS_CONFIGS) + "/memory/" + name + ".yaml", overrides)
        .load(memory);
    return memory;
}

/// The faster memory, for dates in closed form.
inline dram::Config lpddr5_without_refresh(std::vector<std::string> overrides = {}) {
    overrides.emplace_back("controller.refresh=none");
    return lpddr5_config("lpddr5-6400x256", overrides);
}

/// How two commands lie to each other.
enum class Relation { SameBank, SameGroup, Other };

/// The durations from nanoseconds, and the gaps from the durations; shares no code with the model.
struct Lpddr5Reference {
    bool groups;
    double ck;
    int rl, wl, rtp, ccd_l;

    static Lpddr5Reference of(const std::string& name) {
        return name == "lpddr5-3200x128" ? Lpddr5Reference{false, 2.5, 9, 5, 4, 2}
                                         : Lpddr5Reference{true, 1.25, 17, 9, 8, 4};
    }
    int cycles(double ns, int least = 1) const {
        return std::max(least, static_cast<int>(std::ceil(ns / ck - 1e-9)));
    }
    int rcd() const { return cycles(18, 2); }
    int rp() const { return cycles(18, 2); }
    int ras() const { return cycles(42, 3); }
    int rc() const { return ras() + rp(); }
    int wr() const { return cycles(34, 3); }
    int wtr(bool same_group) const { return cycles(!groups || same_group ? 12 : 6.25, 4); }
    int faw() const { return cycles(20); }
    int rfc_ab() const { return cycles(210); }
    int rfc_pb() const { return cycles(120); }
    int refi() const { return cycles(32e6 / 8192); }

    static bool reads(Command c) { return c == Command::Rd || c == Command::RdA; }
    static bool writes(Command c) { return c == Command::Wr || c == Command::WrA; }

    /// CK that must pass from `a` to `b`; 1 if only the command bus parts them.
    int gap(Command a, Command b, Relation relation) const {
        const bool bank = relation == Relation::SameBank;
        const bool group = groups && relation != Relation::Other;
        const bool activates = b == Command::Act1 || b == Command::RefPb || b == Command::RefAb;
        const bool everywhere = b == Command::PreAb || b == Command::RefAb;
        switch (a) {
        case Command::Act1:
            return after_activate(b, bank, everywhere);
        case Command::Rd:
        case Command::RdA:
            if (reads(b)) {
                return group ? ccd_l : 2;
            }
            if (writes(b)) {
                return rl + 2 + 2 - wl;
            }
            if (b == Command::PreAb || (b == Command::Pre && bank)) {
                return rtp;
            }
            return a == Command::RdA && activates && (bank || everywhere) ? rtp + rp() : 1;
        case Command::Wr:
        case Command::WrA:
            if (writes(b)) {
                return group ? ccd_l : 2;
            }
            if (reads(b)) {
                return wl + (group ? ccd_l : 2) + wtr(group);
            }
            if (b == Command::PreAb || (b == Command::Pre && bank)) {
                return wl + 2 + wr();
            }
            return a == Command::WrA && activates && (bank || everywhere) ? wl + 2 + wr() + rp()
                                                                          : 1;
        case Command::Pre:
            if (b == Command::Pre || b == Command::PreAb) {
                return 2;
            }
            return activates && (bank || everywhere) ? rp() : 1;
        case Command::PreAb:
            return activates ? cycles(21, 2) : 1;
        case Command::RefAb:
            return activates ? rfc_ab() : 1;
        case Command::RefPb:
            return after_refresh_pb(b, bank);
        default:
            return 1;
        }
    }

private:
    int after_activate(Command b, bool bank, bool everywhere) const {
        if (reads(b) || writes(b)) {
            return bank ? rcd() : 1;
        }
        if (b == Command::Act1 || b == Command::RefPb) {
            return bank ? rc() : cycles(5);
        }
        if (b == Command::RefAb) {
            return rc();
        }
        return b == Command::PreAb || (b == Command::Pre && (bank || everywhere)) ? ras() : 1;
    }
    int after_refresh_pb(Command b, bool bank) const {
        switch (b) {
        case Command::Act1:
            return bank ? rfc_pb() : cycles(7.5);
        case Command::RefPb:
            return bank ? rfc_pb() : cycles(90);
        case Command::RefAb:
            return rfc_pb();
        default:
            return 1;
        }
    }
};

/// 0 .. `end` - 1, the same everywhere.
inline unsigned below(std::mt19937& random, unsigned end) {
    return static_cast<unsigned>(random()) % end;
}

/// A channel that is fed by hand and remembers every command and answer.
class ChannelBench {
public:
    explicit ChannelBench(const dram::Config& config)
        : timing_(config.timing), rules_(timing_), channel(timing_, rules_, config.controller) {
        channel.observe([this](const dram::Issued& issued) { trace.push_back(issued); });
    }
    ChannelBench(const ChannelBench&) = delete;
    ChannelBench& operator=(const ChannelBench&) = delete;
    ~ChannelBench() = default;
    std::uint32_t push(dram::Ck date, unsigned bank, unsigned row, bool write = false,
                       unsigned bursts = 1, unsigned block = 0, bool urgent = false,
                       unsigned qos = 0) {
        dram::Access access;
        access.date = date;
        access.id = next_id_++;
        access.bank = static_cast<std::uint8_t>(bank);
        access.row = row;
        access.block = static_cast<std::uint8_t>(block);
        access.bursts = static_cast<std::uint8_t>(bursts);
        access.write = write;
        access.urgent = urgent;
        access.qos = static_cast<std::uint8_t>(qos);
        channel.push(access);
        return access.id;
    }
    void run(dram::Ck until) {
        dram::Outcome outcome;
        channel.run(until, outcome);
        for (const dram::Answer& answer : outcome.answers) {
            EXPECT_EQ(answers.count(answer.id), 0U) << "answered twice";
            answers[answer.id] = answer.date;
        }
    }
    void run_out() {
        while (!channel.idle()) {
            run(channel.next_date());
        }
    }
    std::uint32_t pushed() const { return next_id_; }

private:
    dram::Timing timing_;
    dram::RuleTable rules_;
    std::uint32_t next_id_ = 0;

public:
    dram::Channel channel;
    std::vector<dram::Issued> trace;
    std::map<std::uint32_t, dram::Ck> answers;
};

/// Every rule, checked on a trace by looking at all pairs that are near enough to matter.
inline void check_trace(const std::vector<dram::Issued>& trace, const Lpddr5Reference& reference) {
    constexpr dram::Ck kLongest = 200; // above the longest gap, tRFCab
    for (std::size_t i = 0; i < trace.size(); ++i) {
        const dram::Issued& b = trace[i];
        for (std::size_t j = i; j-- > 0 && trace[j].date + kLongest > b.date;) {
            const dram::Issued& a = trace[j];
            const bool pair = a.command == Command::RefPb || b.command == Command::RefPb;
            const bool same_bank = a.bank == b.bank || (pair && (a.bank ^ 8U) == b.bank);
            const Relation relation = same_bank                  ? Relation::SameBank
                                      : a.bank / 4 == b.bank / 4 ? Relation::SameGroup
                                                                 : Relation::Other;
            const int gap = reference.gap(a.command, b.command, relation);
            ASSERT_GE(b.date, a.date + static_cast<dram::Ck>(gap))
                << dram::command_name(a.command) << " of bank " << a.bank << " at " << a.date
                << ", " << dram::command_name(b.command) << " of bank " << b.bank << " at "
                << b.date;
        }
    }
    std::vector<dram::Ck> activations;
    for (const dram::Issued& issued : trace) {
        if (issued.command == Command::Act1) {
            activations.push_back(issued.date);
        }
    }
    for (std::size_t i = 4; i < activations.size(); ++i) {
        ASSERT_GE(activations[i], activations[i - 4] + static_cast<dram::Ck>(reference.faw()));
    }
}

/// The state of the rows: ACT-2 follows ACT-1 within tAAD, columns find their row open, refreshes
/// find theirs closed.
inline void check_rows(const std::vector<dram::Issued>& trace) {
    struct Bank {
        bool open = false, activating = false;
        unsigned row = 0;
        dram::Ck act1 = 0;
    };
    std::vector<Bank> banks(16);
    for (const dram::Issued& issued : trace) {
        Bank& bank = banks[issued.bank];
        switch (issued.command) {
        case Command::Act1:
            ASSERT_FALSE(bank.open || bank.activating);
            bank = {false, true, issued.row, issued.date};
            break;
        case Command::Act2:
            ASSERT_TRUE(bank.activating);
            ASSERT_LE(issued.date, bank.act1 + 8);
            bank.activating = false;
            bank.open = true;
            break;
        case Command::Pre:
            ASSERT_TRUE(bank.open);
            bank.open = false;
            break;
        case Command::PreAb:
        case Command::RefAb:
            for (Bank& each : banks) {
                ASSERT_FALSE(each.activating);
                ASSERT_TRUE(issued.command == Command::PreAb || !each.open);
                each.open = false;
            }
            break;
        case Command::RefPb:
            for (const unsigned b : {issued.bank, issued.bank ^ 8U}) {
                ASSERT_FALSE(banks[b].open || banks[b].activating);
            }
            break;
        default:
            ASSERT_TRUE(bank.open);
            ASSERT_EQ(bank.row, issued.row);
            bank.open = issued.command == Command::Rd || issued.command == Command::Wr;
        }
    }
}

} // namespace degs::test
