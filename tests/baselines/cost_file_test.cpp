// SPDX-License-Identifier: Apache-2.0
// configs/cost/28nm.yaml has the rows of all accelerators, and serves each of them.
#include <gtest/gtest.h>

#include "baselines/accelerators.hpp"
#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "degs/design.hpp"

namespace degs {
namespace {

/// A design of this kind that includes the shipped file; `more` are lines of the section of costs.
std::string design_with(const std::string& kind, const std::string& more = "") {
    return "accelerator: " + kind + "\ncost:\n  include: " + std::string(DEGS_CONFIGS) +
           "/cost/28nm.yaml\n" + more;
}

ConfigSource source_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
    return ConfigSource::from_text("design.yaml", text, overrides);
}

Design standard_design(const std::string& kind) {
    Design design;
    source_of("accelerator: " + kind).load(design);
    return design;
}

std::string refusal_of(const ConfigSource& source) {
    Design design;
    try {
        source.load(design);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(CostFile, StatesEveryDefaultOfEveryAccelerator) {
    for (const AcceleratorKind& kind : accelerator_kinds()) {
        const ConfigSource source = source_of(design_with(kind.name));
        Design loaded;
        EXPECT_TRUE(source.load(loaded).empty()) << kind.name;
        Design standard = standard_design(kind.name);
        EXPECT_EQ(resolved(loaded).dump(2), resolved(standard).dump(2));
        bool rows = false;
        for (const KeyDoc& key : document(standard)) {
            if (key.path.rfind("cost.", 0) == 0) {
                EXPECT_NE(source.place(key.path), "default") << key.path;
                rows = rows || key.path.rfind(std::string("cost.") + kind.name + ".", 0) == 0;
            }
        }
        EXPECT_TRUE(rows) << kind.name << " has no rows of its own";
    }
}

TEST(CostFile, RowsOfAnotherAcceleratorAreNotRead) {
    Design design;
    EXPECT_TRUE(source_of("accelerator: degs\ncost:\n  gscore:\n    sram:\n      bytes: many\n")
                    .load(design)
                    .empty());
    const std::vector<std::string> warnings =
        source_of(design_with("gbu"), {"cost.gscore.sram.area_mm2=2"}).load(design);
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0], "--set cost.gscore.sram.area_mm2=2: key 'cost.gscore.sram.area_mm2' has "
                           "no effect, because it belongs to another accelerator.");
}

TEST(CostFile, OtherSectionsAreRefused) {
    EXPECT_NE(refusal_of(source_of(design_with("degs", "  nobody:\n    sram: 1\n")))
                  .find("design.yaml:4: key 'cost.nobody' is unknown"),
              std::string::npos);
    EXPECT_NE(
        refusal_of(source_of(design_with("degs"), {"cost.nobody.sram.bytes=1"})).find("is unknown"),
        std::string::npos);
    EXPECT_NE(refusal_of(source_of("accelerator: degs\ncost:\n  gscore: 5\n"))
                  .find("design.yaml:3: key 'cost.gscore'"),
              std::string::npos);
    EXPECT_NE(refusal_of(source_of("accelerator: degs\ngscore:\n  sram: 1\n"))
                  .find("key 'gscore' is unknown"),
              std::string::npos);
    EXPECT_NE(refusal_of(source_of(design_with("gscore"), {"cost.gscore=1"})).find("is a section"),
              std::string::npos);
}

} // namespace
} // namespace degs
