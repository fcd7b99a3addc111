// SPDX-License-Identifier: Apache-2.0
#include "dram/energy.hpp"

namespace degs::dram {

void Energy::Config::describe(ConfigVisitor& visitor) {
    visitor.real("activate_nj", activate_nj, 0.0, 1000.0,
                 "nJ; ACT and PRE of a page, (IDD0 - standby) V tRC [derived]");
    visitor.real("read_pj_per_bit", read_pj_per_bit, 0.0, 1000.0,
                 "pJ/bit; with the drive of the pins; 3.75 by the maxima of IDD4R [derived]");
    visitor.real("write_pj_per_bit", write_pj_per_bit, 0.0, 1000.0,
                 "pJ/bit; DRAM side; 2.2 by the maxima of IDD4W [derived]");
    visitor.real("refresh_all_bank_nj", refresh_all_bank_nj, 0.0, 100000.0,
                 "nJ; per all-bank refresh, 8 Gb; 40 for 16 Gb; per-bank is an eighth [derived]");
    visitor.real("standby_open_mw", standby_open_mw, 0.0, 10000.0,
                 "mW per channel while a row is open; 47 by the maximum of IDD3N [derived]");
    visitor.real("standby_closed_mw", standby_closed_mw, 0.0, 10000.0,
                 "mW per channel while all are closed; 37 by the maximum of IDD2N [derived]");
}

void Energy::add(const Config& config, const Timing& timing, const Channel& channel, Ck elapsed) {
    const auto count = [&](Command command) {
        return static_cast<double>(of_kind(channel.stats().commands, command));
    };
    const double bits = 8.0 * timing.burst_bytes();
    constexpr double kNjPerPj = 1e-3;
    activate_nj += config.activate_nj * count(Command::Act1);
    read_nj +=
        kNjPerPj * config.read_pj_per_bit * bits * (count(Command::Rd) + count(Command::RdA));
    write_nj +=
        kNjPerPj * config.write_pj_per_bit * bits * (count(Command::Wr) + count(Command::WrA));
    refresh_nj += config.refresh_all_bank_nj *
                  (count(Command::RefAb) + count(Command::RefPb) / timing.refresh_steps());
    const auto open = static_cast<double>(channel.open_until(elapsed));
    const double closed = static_cast<double>(elapsed) - open;
    // mW x ns = pJ
    background_nj += kNjPerPj * timing.ck_ns() *
                     (config.standby_open_mw * open + config.standby_closed_mw * closed);
}

void Energy::describe(StatsVisitor& v) const {
    for (const EnergyClass& each : kEnergyClasses) {
        v.real(each.name, this->*each.nj, "nJ", each.sentence);
    }
    v.real("total", total_nj(), "nJ", "The sum.");
}

void Energy::describe_with_unit(StatsVisitor& v) const {
    for (const EnergyClass& each : kEnergyClasses) {
        v.real(each.name_with_unit, this->*each.nj, "nJ", each.sentence);
    }
    v.real("total_nj", total_nj(), "nJ", "The sum.");
}

} // namespace degs::dram
