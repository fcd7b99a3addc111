// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <nlohmann/json.hpp>

#include "base/number_json.hpp"
#include "sim/accuracy/hard_case_run.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// In the order of the measures.
std::vector<std::string> distinct(const std::vector<HardResult>& results,
                                  std::string HardMeasure::*key) {
    std::vector<std::string> names;
    for (const HardResult& result : results) {
        for (const HardMeasure& measure : result.measures) {
            if (std::find(names.begin(), names.end(), measure.*key) == names.end()) {
                names.push_back(measure.*key);
            }
        }
    }
    return names;
}

std::string decibels(const HardMeasure& measure) {
    if (measure.max_abs_error == 0) {
        return "=";
    }
    return std::isfinite(measure.psnr_db) ? std::to_string(std::lround(measure.psnr_db)) : "?";
}

std::string scientific(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.0e", value);
    return text;
}

/// "61 60 61 63, 3e-04", with "no: " in front.
std::string cell_of(const HardResult& result, const std::string& set) {
    std::string words;
    double worst = 0;
    bool holds = true;
    for (const HardMeasure& measure : result.measures) {
        if (measure.set == set) {
            words += (words.empty() ? "" : " ") + decibels(measure);
            worst = std::max(worst, measure.max_abs_error);
            holds = holds && measure.problems.empty();
        }
    }
    if (words.empty()) {
        return "";
    }
    words += worst > 0 ? ", " + scientific(worst) : "";
    return (holds ? "" : "no: ") + words;
}

std::string verdict_of(const HardResult& result) {
    return result.failures().empty() ? "yes" : "no";
}

nlohmann::ordered_json measure_json(const HardMeasure& measure) {
    nlohmann::ordered_json json;
    json["numbers"] = measure.set;
    json["resolution"] = measure.resolution;
    json["holds"] = measure.problems.empty();
    const bool identical = measure.max_abs_error == 0;
    json["psnr_db"] = identical ? nlohmann::ordered_json() : number_json(measure.psnr_db);
    json["identical"] = identical;
    json["alpha_error_max"] = number_json(measure.alpha_error_max);
    json["max_abs_error"] = number_json(measure.max_abs_error);
    json["pixels"] = measure.pixels;
    json["nonfinite"] = measure.nonfinite;
    json["recounted_pixels"] = measure.recounted;
    const bool bounded = measure.bounded;
    json["alpha_bound"] = bounded ? nlohmann::ordered_json(measure.alpha_bound) : nullptr;
    json["pixels_beyond_bound"] = bounded ? nlohmann::ordered_json(measure.beyond) : nullptr;
    json["problems"] = measure.problems;
    return json;
}

} // namespace

std::string hard_case_table(const std::vector<HardResult>& results) {
    const std::vector<std::string> sets = distinct(results, &HardMeasure::set);
    std::vector<std::string> headings{"case", "holds"};
    headings.insert(headings.end(), sets.begin(), sets.end());
    TextTable table(headings);
    std::string sentences;
    for (const HardResult& result : results) {
        std::vector<std::string> cells{result.hard->id, verdict_of(result)};
        for (const std::string& set : sets) {
            cells.push_back(cell_of(result, set));
        }
        table.add(cells);
        for (const std::string& note : result.notes) {
            sentences += result.hard->id + ", " + note + ".\n";
        }
        for (const std::string& failure : result.failures()) {
            sentences += failure + "\n";
        }
    }
    return table.text() + sentences;
}

std::string hard_case_markdown(const std::vector<HardResult>& results) {
    const std::vector<std::string> sets = distinct(results, &HardMeasure::set);
    std::string text = "| case | what | expected | holds |";
    std::string rule = "|---|---|---|---|";
    for (const std::string& set : sets) {
        text += " " + set + " |";
        rule += "---|";
    }
    text += "\n" + rule + "\n";
    for (const HardResult& result : results) {
        const HardCase& hard = *result.hard;
        text += "| " + hard.id + " | " + hard.what + " | " + hard.expectation + " | " +
                verdict_of(result) + " |";
        for (const std::string& set : sets) {
            text += " " + cell_of(result, set) + " |";
        }
        text += "\n";
    }
    return text;
}

nlohmann::ordered_json hard_case_json(const std::vector<HardResult>& results) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const HardResult& result : results) {
        nlohmann::ordered_json json;
        json["case"] = result.hard->id;
        json["what"] = result.hard->what;
        json["expectation"] = result.hard->expectation;
        json["holds"] = result.failures().empty();
        json["problems"] = result.problems;
        json["notes"] = result.notes;
        json["measures"] = nlohmann::ordered_json::array();
        for (const HardMeasure& measure : result.measures) {
            json["measures"].push_back(measure_json(measure));
        }
        list.push_back(std::move(json));
    }
    return list;
}

} // namespace degs::sim
