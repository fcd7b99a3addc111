// SPDX-License-Identifier: Apache-2.0
// The constants, and what refuses a row.
#include <gtest/gtest.h>

#include "config/config_source.hpp"
#include "cost/technology.hpp"

namespace degs::cost {
namespace {

/// A technology with two rows, as the section of a design has it.
struct Section {
    Technology technology;
    UnitRow units{1, 1, 4};
    SramRow buffer{0.04, 0.001, 2048, 128};
    void describe(ConfigVisitor& visitor) {
        technology.describe(visitor);
        RowSection rows("rows", "rows of a test", technology, visitor);
        rows.row("units", units, "units");
        rows.row("buffer", buffer, "a buffer");
        rows.end();
    }
};

TEST(Technology, ARowMustNotLeakMoreThanItsPower) {
    Section section;
    try {
        ConfigSource::from_overrides({"leakage_mw_per_mm2=26"}).load(section);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("rows.buffer.power_w"), std::string::npos)
            << error.what();
    }
    ConfigSource::from_overrides({"leakage_mw_per_mm2=25"}).load(section);
    EXPECT_NEAR(section.technology.energy_pj(section.buffer), 0, 1e-12);
    ConfigSource::from_overrides({"rows.units.power_w=2"}).load(section);
    EXPECT_EQ(section.units.power_w, 2);
}

TEST(Technology, PesAreThoseOfTheTableUnlessTheRunDecides) {
    Technology technology;
    EXPECT_EQ(technology.pe_factors(Precision::Double).area, 1);
    technology.pe.numbers = PeNumbers::Run;
    EXPECT_EQ(technology.pe_factors(Precision::Half).area, 1);
    const PeFactors single = technology.pe_factors(Precision::Single);
    const PeFactors wide = technology.pe_factors(Precision::Double);
    EXPECT_NEAR(single.area, (7700.0 + 4184) / (1640 + 1360), 0.005);
    EXPECT_NEAR(single.energy, (3.7 + 0.9) / (1.1 + 0.4), 0.005);
    EXPECT_NEAR(wide.area, single.area * single.area, 0.05);
    EXPECT_NEAR(wide.energy, single.energy * single.energy, 0.05);
}

} // namespace
} // namespace degs::cost
