// SPDX-License-Identifier: Apache-2.0
// Small runs whose advice for their losses is followed.
#pragma once

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {

using Settings = std::vector<std::string>;

/// A view of a design with which advice is asked for.
struct AdvisedView {
    const char* design; ///< a file of configs, without its ending
    Settings settings;
    int width = 240; ///< px
    const char* scene = "synthetic:object,gaussians=2000";
};

/// PE-cycles lost in the class or the time of a reason, whatever they were lost for.
inline double lost_for(const nlohmann::ordered_json& report, const std::string& reason) {
    const auto first_words = [](const std::string& words) {
        return words.substr(0, words.find(','));
    };
    double cycles = 0;
    for (const auto& loss : report["losses"]) {
        if (first_words(loss["reason"]) == first_words(reason)) {
            cycles += loss["share"].get<double>() * report["timing"]["cycles"].get<double>();
        }
    }
    return cycles;
}

inline double value_in(const nlohmann::ordered_json& report, const std::string& key) {
    std::string pointer = "/config/" + key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    return report.at(nlohmann::ordered_json::json_pointer(pointer)).get<double>();
}

/// What the advice "raise KEY", "lower KEY and KEY" or "KEY=VALUE" can mean.
inline std::vector<Settings> steps_of(const std::string& advice,
                                      const nlohmann::ordered_json& report) {
    const std::size_t space = advice.find(' ');
    if (space == std::string::npos) {
        return {{advice}};
    }
    const auto moved = [&](const std::string& key, double factor) {
        const double now = value_in(report, key);
        const double to = advice[0] == 'r' ? std::max(now, 1.0) * factor : std::floor(now / factor);
        std::ostringstream text;
        text << key << '=' << std::setprecision(12) << to;
        return text.str();
    };
    const std::size_t linked = advice.find(" and ");
    const std::string key = advice.substr(space + 1, linked - space - 1);
    std::vector<Settings> steps;
    for (const double factor : {2.0, 4.0, 8.0, 16.0}) {
        if (linked == std::string::npos) {
            steps.push_back({moved(key, factor)});
        } else {
            const std::string other = advice.substr(linked + 5);
            steps.push_back({moved(key, factor), moved(other, factor)});
            steps.push_back({moved(key, factor), moved(other, factor * factor)});
        }
    }
    return steps;
}

/// The report of a small run; nothing if the design is refused.
inline std::optional<nlohmann::ordered_json> report_with(const AdvisedView& view) {
    const Folder folder;
    Settings arguments{"run",      config(view.design), "--scene",
                       view.scene, "--width",           std::to_string(view.width),
                       "--out",    folder / "out",      "--no-reference"};
    for (const std::string& setting : view.settings) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    return degs(arguments).code == 0 ? std::optional(report_in(folder / "out")) : std::nullopt;
}

/// Whether a step of the advice for the loss of that reason lowers it by 5 % without a longer
/// frame; "" or why not. `before` is the report of the view.
inline std::string failure_of(const std::string& advice, const std::string& reason,
                              const AdvisedView& view, const nlohmann::ordered_json& before) {
    const double lost = lost_for(before, reason);
    std::ostringstream tried;
    for (const Settings& step : steps_of(advice, before)) {
        AdvisedView with = view;
        with.settings.insert(with.settings.end(), step.begin(), step.end());
        const auto after = report_with(with);
        if (!after) {
            continue;
        }
        const double part = lost_for(*after, reason) / lost;
        const double frame =
            (*after)["timing"]["cycles"].get<double>() / before["timing"]["cycles"].get<double>();
        if (part < 0.95 && frame <= 1) {
            return "";
        }
        tried << ' ' << step.front() << ": loss x " << part << ", frame x " << frame << ';';
    }
    return reason + ": " + advice + ':' +
           (tried.str().empty() ? " no step is allowed" : tried.str());
}

} // namespace degs::sim_test
