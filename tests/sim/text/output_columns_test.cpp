// SPDX-License-Identifier: Apache-2.0
// Lines that fit the terminal, and symbols that it can show.
#include <cstdlib>

#include <gtest/gtest.h>

#include "sim/text/output_columns.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

/// Characters of the longest line.
std::size_t longest(const std::string& text) {
    std::size_t most = 0;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        most = std::max(most, characters(line));
    }
    return most;
}

TEST(OutputColumns, BreaksAtSeparatorsFirst) {
    const std::string line =
        "frame   1920×1080 · 0.499 ms · 2010 fps · blending 413 k of 499 k cycles";
    EXPECT_EQ(folded(line, 200, 8), line);
    EXPECT_EQ(folded(line, 45, 8), "frame   1920×1080 · 0.499 ms · 2010 fps\n"
                                   "        blending 413 k of 499 k cycles");
    EXPECT_EQ(folded("useful 49.6 %  boundary 6.8  drain 0.0", 30, 2),
              "useful 49.6 %  boundary 6.8\n  drain 0.0");
}

TEST(OutputColumns, LeavesLinesAloneThatJustFit) {
    const std::string line = "one two · three";
    EXPECT_EQ(folded(line, 15, 2), line);
    EXPECT_EQ(folded(line, 14, 2), "one two\n  three");
}

TEST(OutputColumns, NeverBreaksANumberOrItsUnit) {
    for (std::size_t width = 1; width < 40; ++width) {
        const std::string text = folded("there are 210 422 Gaussians in 54.5 MB of memory", width);
        EXPECT_NE(text.find("210 422 Gaussians"), std::string::npos) << width << "\n" << text;
        EXPECT_NE(text.find("54.5 MB"), std::string::npos) << width << "\n" << text;
    }
    EXPECT_EQ(folded("unbreakable", 4), "unbreakable");
    EXPECT_EQ(folded("one line\nand one", 80), "one line\nand one");
}

/// Sets a variable for one test.
class Environment {
public:
    Environment(const char* name, const char* value) : name_(name) {
        const char* const before = std::getenv(name);
        before_ = before != nullptr ? before : "";
        value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    ~Environment() { before_.empty() ? ::unsetenv(name_) : ::setenv(name_, before_.c_str(), 1); }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    const char* name_;
    std::string before_;
};

TEST(OutputColumns, GoesOnBelowColumnByColumn) {
    TextTable table({"design", "cycles", "milliseconds", "frames"});
    table.add({"degs-64", "1 000 000", "1.00", "7"});
    {
        const Environment wide("COLUMNS", "200");
        EXPECT_EQ(table.text(), "design      cycles  milliseconds  frames\n"
                                "degs-64  1 000 000          1.00       7\n");
    }
    {
        const Environment just("COLUMNS", "40"); // 7 + 2 + 9 + 2 + 12 + 2 + 6
        EXPECT_EQ(table.text().find("\n\n"), std::string::npos);
    }
    const Environment narrow("COLUMNS", "34");
    EXPECT_EQ(table.text(), "design      cycles  milliseconds\n"
                            "degs-64  1 000 000          1.00\n"
                            "\n"
                            "design   frames\n"
                            "degs-64       7\n");
}

TEST(OutputColumns, ComparisonsAndRunsFitTheColumns) {
    const Environment narrow("COLUMNS", "80");
    const Folder folder;
    const std::vector<std::string> view{"--scene", "synthetic:object,gaussians=500", "--width",
                                        "96"};
    std::vector<std::string> words{"compare", config("degs-64"), config("gscore-64"), "--frames",
                                   "2"};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), {"--out", folder / "c"});
    const Outcome compared = degs(words);
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_LE(longest(compared.out), 80U) << compared.out;
    words = {"run", config("degs-64")};
    words.insert(words.end(), view.begin(), view.end());
    words.insert(words.end(), {"--out", folder / "r"});
    const Outcome run = degs(words);
    expect_success(run);
    EXPECT_LE(longest(run.out.substr(0, run.out.find("image "))), 80U) << run.out;
}

TEST(OutputColumns, WritesAsciiWhereTheLocaleHasNoOther) {
    const Folder folder;
    const std::vector<std::string> words{
        "run", config("degs-64"), "--scene",   "synthetic:object,gaussians=500", "--width",
        "96",  "--out",           folder / "r"};
    {
        const Environment locale("LC_ALL", "C");
        const Outcome run = degs(words);
        expect_success(run);
        EXPECT_TRUE(std::none_of(run.out.begin(), run.out.end(), [](char c) { return c < 0; }))
            << run.out;
        EXPECT_NE(run.out.find("96x72 - "), std::string::npos) << run.out;
    }
    const Environment locale("LC_ALL", "C.UTF-8");
    EXPECT_NE(degs(words).out.find("96×72 · "), std::string::npos);
}

} // namespace
} // namespace degs::sim_test
