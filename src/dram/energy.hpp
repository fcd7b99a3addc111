// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "config/config.hpp"
#include "dram/channel.hpp"
#include "stats/statistics.hpp"

namespace degs::dram {

/// Energy of the DRAM by class of event, nJ. It does not include the controller and PHY of the SoC.
struct Energy {
    double activate_nj = 0, read_nj = 0, write_nj = 0, refresh_nj = 0, background_nj = 0;
    double total_nj() const {
        return activate_nj + read_nj + write_nj + refresh_nj + background_nj;
    }

    void describe(StatsVisitor& v) const;
    /// Describes the energies under names that end in the unit.
    void describe_with_unit(StatsVisitor& v) const;

    Energy operator-(const Energy& earlier) const {
        return {activate_nj - earlier.activate_nj, read_nj - earlier.read_nj,
                write_nj - earlier.write_nj, refresh_nj - earlier.refresh_nj,
                background_nj - earlier.background_nj};
    }

    /// Energy per event. Vendors publish no currents beside timings, so the values are derived from
    /// the maxima of a 16 Gb LPDDR5X sheet and lowered to typical parts; see docs/lpddr5.md.
    struct Config {
        double activate_nj = 1.0;
        double read_pj_per_bit = 2.75, write_pj_per_bit = 1.75;
        double refresh_all_bank_nj = 30.0;
        double standby_open_mw = 30.0, standby_closed_mw = 22.0;
        void describe(ConfigVisitor& visitor);
    };

    /// Adds the energy of one channel in its first `elapsed` CK.
    void add(const Config& config, const Timing& timing, const Channel& channel, Ck elapsed);
};

/// One class of events and what it means. Its name stands alone where a section says the unit.
struct EnergyClass {
    const char* name;
    const char* name_with_unit;
    double Energy::*nj;
    const char* sentence;
};
inline constexpr std::array<EnergyClass, 5> kEnergyClasses{{
    {"activate", "activate_nj", &Energy::activate_nj, "Opening and closing rows."},
    {"read", "read_nj", &Energy::read_nj, "Read bursts."},
    {"write", "write_nj", &Energy::write_nj, "Write bursts."},
    {"refresh", "refresh_nj", &Energy::refresh_nj, "Refreshes."},
    {"background", "background_nj", &Energy::background_nj, "Standby, whatever happens."},
}};

} // namespace degs::dram
