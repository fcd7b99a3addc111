// SPDX-License-Identifier: Apache-2.0
// Designs from files, as a platform loads them.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "baselines/design.hpp"
#include "config/config_document.hpp"
#include "modules/degs/config.hpp"

namespace degs::test {
namespace {

using ::testing::HasSubstr;

std::string shipped(const std::string& name) {
    return std::string(DEGS_CONFIGS) + "/" + name + ".yaml";
}

std::string mistake_in(const std::string& text) {
    const std::string file = ::testing::TempDir() + "degs_design_test.yaml";
    std::ofstream(file) << text;
    try {
        load_design(file);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

TEST(Designs, EveryShippedFileIsADesignOfItsKind) {
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(DEGS_CONFIGS)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        const std::string stem = entry.path().stem().string();
        const Design design = load_design(entry.path().string());
        EXPECT_EQ(design.accelerator().name, stem);
        EXPECT_EQ(stem.compare(0, design.kind().size(), design.kind()), 0) << stem;
        EXPECT_EQ(design.problem(), "") << stem;
        ++files;
    }
    EXPECT_GE(files, 16);
}

TEST(Designs, OverridesChangeOneKey) {
    const Design design = load_design(shipped("degs-64"), {"array.writeback_cycles=3"});
    EXPECT_EQ(dynamic_cast<const DegsConfig&>(design.accelerator()).array.writeback_cycles, 3);
    EXPECT_EQ(design.accelerator().pes(), 64);
}

// The page of the platform says so: the structure of the paper's design in single precision.
TEST(Designs, TheDefaultsAreTheDesignOfThePaperInSinglePrecision) {
    const std::vector<KeyDoc> defaults = document(Design());
    const std::vector<KeyDoc> paper = document(load_design(shipped("degs-64")));
    ASSERT_EQ(defaults.size(), paper.size());
    std::vector<std::string> different;
    for (std::size_t i = 0; i < defaults.size(); ++i) {
        ASSERT_EQ(defaults[i].path, paper[i].path);
        if (defaults[i].default_value != paper[i].default_value) {
            different.push_back(defaults[i].path);
        }
    }
    EXPECT_THAT(different, ::testing::ElementsAre("pipeline.numbers", "pipeline.span_ends",
                                                  "pixel_buffer.state_bytes"));
    EXPECT_EQ(DegsConfig().pipeline.numbers, Arithmetic::Fp32);
}

TEST(HostileDesigns, MistakesAreOneSentenceThatNamesThePlace) {
    const std::string unknown = mistake_in("accelerator: degs\narray:\n  writeback_cycle: 4\n");
    EXPECT_THAT(unknown, HasSubstr("degs_design_test.yaml:3"));
    EXPECT_THAT(unknown, HasSubstr("writeback_cycles"));
    EXPECT_THAT(mistake_in("accelerator: gpu\n"), HasSubstr("gscore"));
    EXPECT_THAT(mistake_in("array: [\n"), HasSubstr("degs_design_test.yaml"));
    for (const char* text : {"accelerator: gpu\n", "array: [\n", "array:\n  pes_per_bank: 0\n"}) {
        const std::string sentence = mistake_in(text);
        ASSERT_FALSE(sentence.empty()) << text;
        EXPECT_EQ(sentence.back(), '.') << sentence;
        EXPECT_EQ(sentence.find('\n'), std::string::npos) << sentence;
    }
    EXPECT_THROW(load_design("/nowhere/design.yaml"), InputError);
}

} // namespace
} // namespace degs::test
