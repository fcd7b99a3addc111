// SPDX-License-Identifier: Apache-2.0
// Sentences of statistics that are formulas give the number in its unit.
#include <regex>

#include "sim/report/report.hpp"
#include "stats/statistics_document.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

/// The number of a name that a formula uses: a key beside the statistic, or of the whole document.
std::optional<double> operand(const json& document, const std::string& path,
                              const std::string& word) {
    if (word.find_first_not_of("0123456789") == std::string::npos) {
        return std::stod(word);
    }
    std::string section = path;
    for (;;) {
        const std::size_t dot = section.rfind('.');
        section = dot == std::string::npos ? "" : section.substr(0, dot);
        std::string place = (section.empty() ? "" : "/" + section) + "/" + word;
        std::replace(place.begin(), place.end(), '.', '/');
        const json::json_pointer pointer(place);
        if (document.contains(pointer) && document[pointer].is_number()) {
            return document[pointer].get<double>();
        }
        if (section.empty()) {
            return {};
        }
    }
}

/// Compares every statistic of the list whose sentence is "A / B" or "A / B / C" of known numbers.
int check_formulas(const std::string& list, const json& document) {
    // A path at the margin, its unit in brackets, the sentence below it.
    const std::regex entry(R"(([\w.]+) \[[^\]]*\]\n    ([\w.]+) / ([\w.]+?)( / (\d+))?\.\n)");
    int checked = 0;
    for (std::sregex_iterator at(list.begin(), list.end(), entry), end; at != end; ++at) {
        const std::string path = (*at)[1];
        const auto value = operand(document, "", path);
        const auto part = operand(document, path, (*at)[2]);
        const auto whole = operand(document, path, (*at)[3]);
        if (value && part && whole) {
            const double divisor = (*at)[5].length() > 0 ? std::stod((*at)[5]) : 1;
            EXPECT_NEAR(*value, *part / *whole / divisor, 1e-6 * *value) << at->str();
            ++checked;
        }
    }
    return checked;
}

TEST(Formulas, OfAMemoryGiveTheNumberInItsUnit) {
    const Folder folder;
    const Outcome list = degs({"config", "--stats", "--of", "memory"});
    expect_success(degs({"memory", config("memory/lpddr5-3200x128"), "--no-curve", "--requests",
                         "20000", "--out", folder / "o"}));
    const json document = json::parse(read_file(folder / "o/memory.json"));
    EXPECT_GE(check_formulas(list.out, document), 2) << list.out;
}

TEST(Formulas, OfARunGiveTheNumberInItsUnit) {
    const Folder folder;
    const Outcome list = degs({"config", config("degs-16"), "--stats"});
    expect_success(degs({"run", config("degs-16"), "--scene", "synthetic:object,gaussians=300",
                         "--width", "64", "--out", folder / "o"}));
    EXPECT_GE(check_formulas(list.out, report_in(folder / "o")), 1) << list.out;
}

} // namespace
} // namespace degs::sim_test
