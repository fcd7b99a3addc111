// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/plot_svg.hpp"

#include <cmath>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/plot/log_axis.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/plot/svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++found;
    }
    return found;
}

/// All values of an attribute in elements of a kind whose text contains `with`.
std::vector<double> values(const std::string& svg, const std::string& element,
                           const std::string& attribute, const std::string& with = "") {
    std::vector<double> found;
    const std::regex tags("<" + element + " ([^>]*)/?>");
    for (std::sregex_iterator tag(svg.begin(), svg.end(), tags), end; tag != end; ++tag) {
        const std::string inside = " " + (*tag)[1].str();
        std::smatch match;
        if (inside.find(with) != std::string::npos &&
            std::regex_search(inside, match, std::regex(" " + attribute + "=\"([-0-9.]+)\""))) {
            found.push_back(std::stod(match[1].str()));
        }
    }
    return found;
}

/// Every element that is opened is closed, in order; no stray markup in texts.
void expect_well_formed(const std::string& svg) {
    std::vector<std::string> open;
    const std::regex tag("<(/?)([a-z]+)[^<>]*?(/?)>");
    std::string rest = std::regex_replace(svg, tag, "");
    EXPECT_THAT(rest, Not(HasSubstr("<")));
    EXPECT_TRUE(std::regex_replace(rest, std::regex("&(amp|lt|gt|quot);"), "").find('&') ==
                std::string::npos);
    for (std::sregex_iterator at(svg.begin(), svg.end(), tag), end; at != end; ++at) {
        if ((*at)[1].length() != 0) {
            ASSERT_FALSE(open.empty());
            EXPECT_EQ(open.back(), (*at)[2].str());
            open.pop_back();
        } else if ((*at)[3].length() == 0) {
            open.push_back((*at)[2].str());
        }
    }
    EXPECT_TRUE(open.empty());
}

const std::array<double, kSlotClasses.size()> kShares{0.5, 0.2,  0.1, 0.05, 0.05,
                                                      0.0, 0.05, 0.0, 0.05};

TEST(Svg, TextsOfUsersAreHarmless) {
    Svg svg;
    svg.text(1, 2, "<a href=\"x\">&\x01\xff</a>");
    const std::string file = svg.document(10, 10, "<&>");
    expect_well_formed(file);
    EXPECT_THAT(file, HasSubstr("&lt;a href=&quot;x&quot;&gt;&amp; \xEF\xBF\xBD&lt;/a&gt;"));
    EXPECT_THAT(file, HasSubstr("<title>&lt;&amp;&gt;</title>"));
}

TEST(Svg, LongWordsAreCutAtACharacter) {
    EXPECT_EQ(fitting("short", 10, 100), "short");
    const std::string words = "µµµµµµµµµµ"; // two bytes each
    for (double width = 0; width < 70; width += 3) {
        const std::string cut = fitting(words, 10, width);
        if (cut != words) {
            EXPECT_EQ(cut.substr(cut.size() - 3), "…");
            EXPECT_EQ((cut.size() - 3) % 2, 0U);
            EXPECT_TRUE(cut == "…" || text_width(cut, 10) <= width);
        }
    }
    EXPECT_EQ(characters("1920×1080"), 9U);
}

// Bars begin at 0, so that their heights are in the ratio of their values, and a gap stays empty.
TEST(RatiosPlot, BarsAreAsHighAsTheirRatios) {
    const std::string svg = ratios_svg("Title", {"first", "second"},
                                       {{"latency", {{"view", {1, 0.5}}, {"mean", {1, {}}}}}});
    expect_well_formed(svg);
    for (const char* words :
         {"Title", "latency", ">first<", ">second<", ">view<", ">mean<", ">1.00<", ">0.50<"}) {
        EXPECT_THAT(svg, HasSubstr(words));
    }
    const auto heights = [&](std::size_t design) {
        std::vector<double> all =
            values(svg, "rect", "height", std::string("fill=\"") + colour_of_line(design));
        all.erase(all.begin()); // of the legend
        return all;
    };
    ASSERT_EQ(heights(0).size(), 2U);
    ASSERT_EQ(heights(1).size(), 1U);
    EXPECT_NEAR(heights(0)[0], heights(0)[1], 0.01);
    EXPECT_NEAR(heights(1)[0], heights(0)[0] / 2, 0.02);
}

TEST(RatiosPlot, ManyViewsTakeSeveralRows) {
    std::vector<RatioGroup> groups;
    for (int v = 0; v < 40; ++v) {
        groups.push_back({"a view with a long name " + std::to_string(v), {1, 2.5, 0.01, 1e3}});
    }
    const std::string svg = ratios_svg("Title", {"a", "b", "c", "d"}, {{"latency", groups}});
    expect_well_formed(svg);
    for (const double x : values(svg, "rect", "x", "fill=\"#0072b2")) {
        EXPECT_LT(x, kPlotWidth);
    }
    EXPECT_EQ(values(svg, "rect", "x", "fill=\"#0072b2").size(), 41U);
}

// The second design of the first view takes twice as long as the first, and begins late.
TEST(SlotsPlot, BarsAreAsLongAsTheirFrames) {
    const SlotBar quick{"a", "", kShares, 0, 1, 1};
    const SlotBar slow{"b", "64 PEs", kShares, 0.5, 1.5, 2};
    const SlotBar alone{"a", "", {1, 0, 0, 0, 0, 0, 0, 0}, 0, 10, 10};
    const std::string svg =
        slots_svg("Title", {{"first view", {quick, slow}}, {"second view", {alone}}});
    expect_well_formed(svg);
    for (const char* words : {"Title", "first view", "second view", "64 PEs", ">0 ms<", ">1.5<",
                              ">50.0<", ">before the first task<", ">after the last<"}) {
        EXPECT_THAT(svg, HasSubstr(words));
    }
    const auto bars = [&](const char* name, const std::string& colour) {
        return values(svg, "rect", name, "height=\"24\" fill=\"" + colour + "\"");
    };
    const std::vector<double> useful = bars("width", "#009e73");
    const std::vector<double> boundary = bars("width", "#e69f00");
    ASSERT_EQ(useful.size(), 3U);
    ASSERT_EQ(boundary.size(), 2U);
    const double hair = 0.75; // of white between neighbours
    const double all = useful[2] + hair;
    EXPECT_NEAR(useful[0] + hair, all / 4, 0.01); // half of half the time
    EXPECT_NEAR(useful[1] + hair, all / 4, 0.01);
    EXPECT_NEAR(boundary[0] + hair, all / 10, 0.01);
    EXPECT_NEAR(bars("width", "#d9d9d9").at(0) + hair, all / 4, 0.01);
    EXPECT_NEAR(bars("width", "#bdbdbd").at(0) + hair, all / 4, 0.01);
    const double left = bars("x", "#009e73").at(0);
    EXPECT_NEAR(bars("x", "#009e73").at(1), left + all / 4, 0.01);
    EXPECT_NEAR(bars("x", "#bdbdbd").at(0), left + all * 3 / 4, 0.01);
    // A class without slots has no rectangle; the legend has one of each class in their order.
    EXPECT_TRUE(values(svg, "rect", "width", "height=\"24\" fill=\"#0072b2\"").empty());
    std::size_t before = 0;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        if (kSlotClasses[c].rare && kShares[c] == 0) {
            EXPECT_THAT(svg, ::testing::Not(HasSubstr(kSlotClasses[c].name)));
            continue;
        }
        const std::size_t at = svg.find(std::string(">") + kSlotClasses[c].name + "<");
        ASSERT_NE(at, std::string::npos) << kSlotClasses[c].name;
        EXPECT_GT(at, before);
        before = at;
        EXPECT_EQ(
            values(svg, "rect", "x", std::string("height=\"13\" fill=\"") + kSlotColours[c]).size(),
            1U);
    }
}

// A share is written with one decimal, or not at all where that does not fit.
TEST(SlotsPlot, RoundsNoShareToAWholePercent) {
    for (const double share : {0.059, 0.0996, 0.096, 0.5}) {
        for (const double end_ms : {1.0, 1.5, 2.0, 2.5, 3.0}) {
            const SlotBar bar{"a", "", {share, 1 - share, 0, 0, 0, 0, 0, 0}, 0, 1, end_ms};
            const std::string svg = slots_svg("T", {{"v", {bar}}});
            const auto whole = std::to_string(std::lround(100 * share));
            EXPECT_THAT(svg, ::testing::Not(HasSubstr(">" + whole + "<")))
                << share << " " << end_ms;
        }
    }
}

TEST(SlotsPlot, StaysInsideThePage) {
    const std::string longest(200, 'w');
    const std::string svg = slots_svg("T", {{longest, {{longest, longest, kShares, 0, 1, 1}}}});
    expect_well_formed(svg);
    const std::vector<double> x = values(svg, "rect", "x");
    const std::vector<double> width = values(svg, "rect", "width");
    EXPECT_EQ(values(svg, "svg", "width"), std::vector<double>{800});
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_GE(x[i], 0);
        EXPECT_LE(x[i] + width[width.size() - x.size() + i], 800);
    }
}

TEST(UtilizationPlot, PlacesPointsOnALogAxis) {
    const UtilizationLine degs{"degs", {{64, 0.8}, {16, 1.0}, {1024, 0.0}}};
    const UtilizationLine one{"other", {{64, 0.5}}};
    const std::string svg = utilization_svg("T", {{"view", {degs, one}}});
    expect_well_formed(svg);
    const std::vector<double> x = values(svg, "circle", "cx");
    const std::vector<double> y = values(svg, "circle", "cy");
    ASSERT_EQ(x.size(), 4U);                             // the legend's, then by PEs
    EXPECT_NEAR((x[3] - x[1]) / (x[2] - x[1]), 3, 0.01); // 6 octaves against 2
    EXPECT_NEAR((y[3] - y[2]) / (y[2] - y[1]), 4, 0.05); // 80 % against 20 %
    EXPECT_EQ(count(svg, "<polyline"), 1U);              // one point makes no line
    for (const char* words :
         {">16<", ">64<", ">1024<", "PEs", "utilization, %", ">degs<", ">other<", ">view<"}) {
        EXPECT_THAT(svg, HasSubstr(words));
    }
}

// The axis ends with a power of two on either side of all numbers.
TEST(UtilizationPlot, HasRoomForNumbersBetweenPowersOfTwo) {
    const std::string svg = utilization_svg("T", {{"view", {{"a", {{48, 0.8}, {96, 0.5}}}}}});
    for (const char* words : {">32<", ">64<", ">128<"}) {
        EXPECT_THAT(svg, HasSubstr(words));
    }
}

TEST(LogAxis, HasAllRoundValuesInside) {
    const LogAxis axis{std::log10(0.45), std::log10(55.0), 0, 100};
    const std::vector<double> ticks = axis.ticks();
    const std::vector<double> expected{0.5, 1, 2, 5, 10, 20, 50};
    ASSERT_EQ(ticks.size(), expected.size());
    for (std::size_t i = 0; i < ticks.size(); ++i) {
        EXPECT_NEAR(ticks[i], expected[i], 1e-12);
    }
}

TEST(Ticks, AreTheNextRoundNumberThatNeedsNoMoreLines) {
    EXPECT_EQ(tick_of(5), 1);
    EXPECT_EQ(tick_of(5.1), 2);
    EXPECT_EQ(tick_of(10), 2);
    EXPECT_EQ(tick_of(26), 10);
    EXPECT_EQ(tick_of(8, 8), 1);
}

TEST(UtilizationPlot, ManyPanelsAndNone) {
    const UtilizationPanel panel{"view", {{"a", {{1, 0.5}, {1 << 20, 0.6}}}, {"b", {}}}};
    for (std::size_t panels : {0U, 1U, 2U, 5U}) {
        const std::string svg = utilization_svg("T", std::vector<UtilizationPanel>(panels, panel));
        expect_well_formed(svg);
        EXPECT_EQ(count(svg, ">view<"), panels);
        EXPECT_EQ(count(svg, "<polyline"), panels);
        for (double x : values(svg, "circle", "cx")) {
            EXPECT_LT(x, 800);
        }
    }
}

// Three goals make three charts; designs lie in each of them, and one outside the limits is named.
TEST(FrontPairs, HaveAChartForEveryPairOfGoals) {
    std::vector<ManyGoals> designs{{{1, 20, 3e6}, {true, false, true}},
                                   {{2, 10, 4e6}, {false, true, true}}};
    const auto count = [](const std::string& text, const std::string& part) {
        std::size_t found = 0;
        for (std::size_t at = text.find(part); at != std::string::npos;
             at = text.find(part, at + 1)) {
            ++found;
        }
        return found;
    };
    const std::vector<std::string> labels{"first (smaller is better)", "second", "third"};
    const std::string within = front_pairs_svg("a & b", labels, designs);
    EXPECT_EQ(count(within, "<circle"), 3U + 1U); // one in the legend
    EXPECT_EQ(count(within, "breaks a limit"), 0U);
    EXPECT_EQ(count(within, "third"), 1U);
    EXPECT_EQ(count(within, "first (smaller is better)"), 1U);
    EXPECT_NE(within.find("a &amp; b"), std::string::npos);
    EXPECT_NE(within.find("M</text>"), std::string::npos);
    designs.push_back({{3, 30, 5e6}, {false, false, false}});
    const std::string outside = front_pairs_svg("a", labels, designs);
    EXPECT_EQ(count(outside, "breaks a limit"), 1U);
    EXPECT_EQ(count(outside, "#b0b0b0"), 3U + 1U);
    EXPECT_FALSE(front_pairs_svg("none", labels, {}).empty());
}

} // namespace
} // namespace degs::sim
