// SPDX-License-Identifier: Apache-2.0
// The constants: the shipped file, and what refuses a row.
#include <gtest/gtest.h>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "cost/technology.hpp"

namespace degs::cost {
namespace {

const std::string kFile = std::string(DEGS_CONFIGS) + "/cost/28nm.yaml";

TEST(Technology, TheFileStatesEveryDefault) {
    const ConfigSource source = ConfigSource::from_file(kFile);
    Technology loaded;
    EXPECT_TRUE(source.load(loaded).empty());
    EXPECT_EQ(resolved(loaded).dump(2), resolved(Technology{}).dump(2));
    for (const KeyDoc& key : document(loaded)) {
        EXPECT_NE(source.place(key.path), "default") << key.path;
    }
}

TEST(Technology, ARowMustNotLeakMoreThanItsPower) {
    Technology technology;
    try {
        ConfigSource::from_overrides({"leakage_mw_per_mm2=26"}).load(technology);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("degs.span_buffer.power_w"), std::string::npos)
            << error.what();
    }
    ConfigSource::from_overrides({"leakage_mw_per_mm2=25"}).load(technology);
    EXPECT_NEAR(technology.energy_pj(technology.degs.span_buffer), 0, 1e-12);
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
