// SPDX-License-Identifier: Apache-2.0
// Designs from files, as a platform loads them.
#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config_document.hpp"
#include "degs/design.hpp"
#include "degs/error.hpp"
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
    EXPECT_EQ(DegsConfig().pipeline.numbers.base, Arithmetic::Fp32);
}

/// Remembers the keys, and multiplies every integer that `raise` names by two.
class Keys : public KeyVisitor {
public:
    explicit Keys(std::string raise = "") : raise_(std::move(raise)) {}
    void integer(const std::string& path, std::int64_t& value, std::int64_t low, std::int64_t high,
                 const std::string& doc) override {
        see(path, doc);
        EXPECT_LE(low, value) << path;
        EXPECT_GE(high, value) << path;
        value *= path == raise_ ? 2 : 1;
    }
    void real(const std::string& path, double& value, double low, double high,
              const std::string& doc) override {
        see(path, doc);
        EXPECT_LE(low, value) << path;
        EXPECT_GE(high, value) << path;
    }
    void boolean(const std::string& path, bool& /*value*/, const std::string& doc) override {
        see(path, doc);
    }
    void text(const std::string& path, std::string& /*value*/, const std::string& doc) override {
        see(path, doc);
    }
    void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                const std::string& doc) override {
        see(path, doc);
        EXPECT_LT(std::size_t(value), names.size()) << path;
    }
    std::vector<std::string> paths;

private:
    void see(const std::string& path, const std::string& doc) {
        EXPECT_FALSE(doc.empty()) << path;
        paths.push_back(path);
    }
    std::string raise_;
};

TEST(DesignKeys, AreThoseOfTheManualForEveryAccelerator) {
    for (const char* name : {"degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o4"}) {
        Design design = load_design(shipped(name));
        Keys keys;
        design.visit(keys);
        std::vector<std::string> documented;
        for (const KeyDoc& key : document(design)) {
            if (key.type != "section") {
                documented.push_back(key.path);
            }
        }
        EXPECT_EQ(keys.paths, documented) << name;
        for (const std::string& path : keys.paths) {
            EXPECT_NO_THROW(design.get(path)) << path;
        }
    }
}

TEST(DesignKeys, AreSetTogetherAndReadByName) {
    Design design;
    EXPECT_THAT(design.set({"scheduler.banks=4", "packing.bytes=4KiB", "clock_ghz=0.5",
                            "scheduler.scoreboard=false", "scheduler.scan=oldest", "name=mine"}),
                ::testing::IsEmpty());
    EXPECT_EQ(design.get("scheduler.banks"), "4");
    EXPECT_EQ(design.get("packing.bytes"), "4096");
    EXPECT_EQ(design.get("clock_ghz"), "0.5");
    EXPECT_EQ(design.get("scheduler.scoreboard"), "false");
    EXPECT_EQ(design.get("scheduler.scan"), "oldest");
    EXPECT_EQ(design.get("accelerator"), "degs");
    EXPECT_EQ(design.name(), "mine");
    EXPECT_EQ(design.pes(), 32);
    const std::vector<std::string> advice = design.set("slicing.rows_per_cycle", "1");
    ASSERT_EQ(advice.size(), 1U);
    EXPECT_THAT(advice[0], HasSubstr("slicing.rows_per_cycle"));
    EXPECT_EQ(design.set("accelerator", "gbu").size(), 0U);
    EXPECT_EQ(design.kind(), "gbu");
    EXPECT_EQ(design.get("engines.count"), "2");
}

TEST(DesignKeys, AVisitorChangesValuesAndRulesAreCheckedAfterwards) {
    Design design;
    Keys doubled("array.pes_per_bank");
    design.visit(doubled);
    EXPECT_EQ(design.get("array.pes_per_bank"), "16");
    EXPECT_EQ(design.problem(), "");
    Keys too_many("tile_size");
    design.visit(too_many);
    EXPECT_THAT(design.problem(), HasSubstr("pixel_buffer.bytes"));
}

/// Gives one choice an index that it does not have.
class WrongChoice : public Keys {
public:
    explicit WrongChoice(std::string path, int index) : path_(std::move(path)), index_(index) {}
    void choice(const std::string& path, int& value, const std::vector<std::string>& names,
                const std::string& doc) override {
        Keys::choice(path, value, names, doc);
        value = path == path_ ? index_ : value;
    }

private:
    std::string path_;
    int index_;
};

TEST(HostileDesignKeys, AVisitorCannotChooseWhatDoesNotExist) {
    for (const char* path : {"accelerator", "scheduler.scan", "memory.model"}) {
        for (const int index : {-1, 1000}) {
            Design design;
            WrongChoice visitor(path, index);
            EXPECT_THROW(design.visit(visitor), InputError) << path;
            EXPECT_EQ(design.problem(), "") << path;
        }
    }
}

TEST(HostileDesignKeys, ARefusedValueLeavesTheDesignAsItWas) {
    Design design;
    for (const char* assignment : {"scheduler.banks=0", "scheduler.banks=x", "scheduler.bank=4",
                                   "scheduler=4", "packing.bytes=1", "scheduler.scan=newest",
                                   "no assignment", "=", "packing.bytes=16KB/s"}) {
        EXPECT_THROW(design.set({"clock_ghz=2", assignment}), InputError) << assignment;
        EXPECT_EQ(design.get("clock_ghz"), "1") << assignment;
        EXPECT_EQ(design.problem(), "") << assignment;
    }
    try {
        design.get("scheduler.bank");
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_STREQ(error.what(),
                     "key 'scheduler.bank' is unknown, did you mean 'scheduler.banks'?");
    }
    EXPECT_THROW(design.get(""), InputError);
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
