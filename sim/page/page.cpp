// SPDX-License-Identifier: Apache-2.0
#include "sim/page/page.hpp"

#include <map>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "base/number_json.hpp"
#include "sim/page/page_assets.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/report/report.hpp"
#include "sim/results/result_words.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

using nlohmann::ordered_json;

/// Bytes that are not UTF-8 become U+FFFD, and nothing in it ends the element that holds it.
std::string embedded(const ordered_json& json) {
    std::string text = dump_json(json);
    for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at)) {
        text.replace(at, 1, "\\u003c");
    }
    return text;
}

ordered_json measures_json() {
    const std::vector<Statistic> report =
        document_statistics([](StatsVisitor& visitor) { describe(RunResult(), visitor); });
    ordered_json list = ordered_json::array();
    for (const Statistic& measure : measure_statistics(report)) {
        const Measure named = measure_named(measure.path, "The page");
        if (!is_of_host(named)) {
            list.push_back({{"name", measure.path},
                            {"unit", measure.unit},
                            {"sentence", measure.sentence},
                            {"better", direction_words(direction_of(named))}});
        }
    }
    return list;
}

ordered_json run_of(const PageFacts& facts, const Comparison& comparison, std::size_t r) {
    const ComparisonRow& row = comparison.rows[r];
    ordered_json run = {{"point", facts.points[r]}, {"variant", row.config}, {"view", row.view}};
    run["measures"] = ordered_json::array();
    for_each_measure([&](Measure m) {
        if (!is_of_host(m)) {
            run["measures"].push_back(number_json(row.measures[m]));
        }
    });
    run["limited_by"] = row.limited_by;
    run["stages"] = ordered_json::object();
    for (const auto& [name, busy] : row.stages) {
        run["stages"][name] = busy;
    }
    run["parts"] = ordered_json::object();
    for (const auto& [name, value] : row.parts) {
        run["parts"][name] = value;
    }
    run["report"] = row.report;
    return run;
}

ordered_json variant_of(const PageFacts& facts, const Comparison& comparison, std::size_t v) {
    ordered_json values = ordered_json::array();
    for (const std::optional<std::string>& value : facts.variants[v].values) {
        values.push_back(value_or_null(value));
    }
    const PageFacts::Variant& variant = facts.variants[v];
    ordered_json json = {
        {"name", comparison.configs[v].name}, {"design", variant.design},
        {"values", std::move(values)},        {"pes", value_or_null(comparison.configs[v].pes)},
        {"within", variant.within},           {"front", variant.on_front},
        {"goals", ordered_json::array()}};
    for (const std::optional<double>& goal : variant.goals) {
        json["goals"].push_back(number_json(goal));
    }
    return json;
}

ordered_json axes_json(const PageFacts& facts) {
    ordered_json json = ordered_json::array();
    for (const PageFacts::Axis& axis : facts.axes) {
        json.push_back({{"name", axis.name}, {"keys", axis.keys}});
    }
    return json;
}

ordered_json sentences_json(const std::vector<std::pair<std::string, std::string>>& list) {
    ordered_json json = ordered_json::array();
    for (const auto& [name, why] : list) {
        json.push_back({{"name", name}, {"why", why}});
    }
    return json;
}

ordered_json data_of(const PageFacts& facts, const Comparison& comparison) {
    ordered_json json = {{"version", tool_json()["version"]},
                         {"baseline", comparison.baseline},
                         {"swept", facts.swept},
                         {"estimated", comparison.is_estimated()},
                         {"array_only", comparison.array_only},
                         {"missing", facts.missing},
                         {"spent", facts.spent},
                         {"keys", facts.keys},
                         {"axes", axes_json(facts)},
                         {"measures", measures_json()},
                         {"skipped", sentences_json(facts.skipped)},
                         {"failed", sentences_json(facts.failed)}};
    json["limited"] = facts.limited;
    for (const char* list : {"slots", "goals", "variants", "views", "runs"}) {
        json[list] = ordered_json::array();
    }
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        json["slots"].push_back({{"name", kSlotClasses[c].name}, {"colour", kSlotColours[c]}});
    }
    for (const PageFacts::Goal& goal : facts.goals) {
        json["goals"].push_back({{"name", goal.name}, {"larger", goal.larger_is_better}});
    }
    for (std::size_t v = 0; v < comparison.configs.size(); ++v) {
        json["variants"].push_back(variant_of(facts, comparison, v));
    }
    for (const ComparedView& view : comparison.views) {
        json["views"].push_back({{"words", view_words(view)}});
    }
    for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
        json["runs"].push_back(run_of(facts, comparison, r));
    }
    return json;
}

/// Replaces each @name@ that has a part; parts may contain anything.
std::string filled(const std::string& page, const std::map<std::string, std::string>& parts) {
    std::string text;
    for (std::size_t at = 0; at < page.size();) {
        const std::size_t begin = page.find('@', at);
        const std::size_t end = begin == std::string::npos ? begin : page.find('@', begin + 1);
        if (end == std::string::npos) {
            return text + page.substr(at);
        }
        text += page.substr(at, begin - at);
        const auto part = parts.find(page.substr(begin + 1, end - begin - 1));
        text += part == parts.end() ? page.substr(begin, end - begin + 1) : part->second;
        at = end + 1;
    }
    return text;
}

} // namespace

std::string html_escaped(const std::string& text) {
    std::string html;
    for (const char c : text) {
        html += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
    }
    return html;
}

std::string study_page(const PageFacts& facts, const Comparison& comparison) {
    using namespace page_assets;
    return filled(
        kPage,
        {{"title", html_escaped(facts.title + (comparison.is_estimated() ? " (estimates)" : ""))},
         {"css", kStyle},
         {"bandwidth", facts.picture.empty() ? ""
                                             : "<section><h2>Latency over the bandwidth of "
                                               "memory</h2>\n" +
                                                   facts.picture + "</section>"},
         {"data", embedded(data_of(facts, comparison))},
         {"d3", kD3},
         {"plot", kPlot},
         {"js", kScript}});
}

} // namespace degs::sim
