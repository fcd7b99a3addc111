// SPDX-License-Identifier: Apache-2.0
// degs bandwidth: from which bandwidth on memory does not limit a design.
#include <memory>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "sim/report/report.hpp"
#include "sim/search/bandwidth_search.hpp"
#include "sim/search/design_study.hpp"
#include "sim/search/search.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/study_options.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// Raised whenever a key of bandwidth.json changes its meaning, name or unit.
constexpr int kBandwidthVersion = 1;

struct BandwidthOptions {
    StudyOptions study;
    int jobs = 1;
    std::string out = "out";
};

/// A threshold with the view and the design that it is of.
struct OfView {
    std::string design, view, folder;
    BandwidthThreshold threshold;
};

std::string range_words(const BandwidthThreshold& found) {
    return found.gb_per_s ? three_digits(found.low) + " to " + three_digits(found.high) : "";
}

std::string text_of(const std::vector<OfView>& all) {
    TextTable table({"design", "view", "GB/s", "between", "estimated", "ms", "simulated"});
    std::string sentences;
    for (const OfView& each : all) {
        const BandwidthThreshold& found = each.threshold;
        table.add({each.design, each.view, found.gb_per_s ? three_digits(*found.gb_per_s) : "none",
                   range_words(found), found.estimated ? three_digits(*found.estimated) : "",
                   found.gb_per_s ? three_digits(found.latency_ms) : "",
                   std::to_string(found.simulated)});
        sentences +=
            found.none.empty() ? "" : each.design + ", " + each.view + ": " + found.none + "\n";
    }
    return table.text() + "\nFrom there on, 10 % more bandwidth gain less than 1 %.\n" + sentences;
}

nlohmann::ordered_json json_of(const std::vector<OfView>& all) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const OfView& each : all) {
        const BandwidthThreshold& found = each.threshold;
        const auto if_found = [&found](double value) {
            return found.gb_per_s ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
        };
        list.push_back(
            {{"design", each.design},
             {"view", each.view},
             {"gb_per_s", if_found(found.gb_per_s.value_or(0))},
             {"low_gb_per_s", if_found(found.low)},
             {"high_gb_per_s", if_found(found.high)},
             {"latency_ms", if_found(found.latency_ms)},
             {"estimated_gb_per_s", found.estimated ? nlohmann::ordered_json(*found.estimated)
                                                    : nlohmann::ordered_json()},
             {"simulated", found.simulated},
             {"none",
              found.none.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(found.none)},
             {"runs", each.folder}});
    }
    return {{"version", kBandwidthVersion}, {"tool", tool_json()}, {"thresholds", list}};
}

/// The views of a plan without designs, one by one.
std::vector<StudyPlan> views_one_by_one(const StudyPlan& plan) {
    std::vector<StudyPlan> plans;
    for (const StudyView& view : plan.views) {
        plans.push_back(plan);
        plans.back().views = {view};
    }
    return plans;
}

/// Empty after Ctrl-C.
std::optional<OfView> threshold_of(const Study& study, StudyPlan plan, const std::string& out,
                                   std::vector<std::string>& warnings,
                                   std::optional<Failure>& failure) {
    const BandwidthSteps steps = bandwidth_steps(first_design(study));
    Study varied = study;
    varied.axes = {steps.axis};
    DesignSpace space(varied, plan);
    space.add_baseline();
    BandwidthSearch thresholds(space, plan, steps);
    SearchPart alone;
    if (!search(plan, thresholds, alone, out, failure)) {
        return {};
    }
    const StepResults& results = thresholds.results();
    warnings.insert(warnings.end(), results.warnings.begin(), results.warnings.end());
    return OfView{study.designs.front().name, "", out, thresholds.threshold()};
}

void find_thresholds(const BandwidthOptions& options) {
    Study study = study_of_designs(study_of(options.study), options.study.file, "degs bandwidth");
    StudyPlan views = plan_views(study);
    views.request.jobs = options.jobs;
    const std::vector<StudyPlan> plans = views_one_by_one(views);
    const std::vector<StudyDesign> designs = study.designs;
    std::vector<OfView> all;
    std::vector<std::string> warnings;
    std::optional<Failure> failure;
    for (const StudyDesign& design : designs) {
        study.designs = {design};
        for (std::size_t v = 0; v < plans.size(); ++v) {
            const bool alone = plans.size() * designs.size() == 1;
            const std::string folder =
                alone ? options.out : options.out + "/" + design.name + "-" + std::to_string(v + 1);
            std::optional<OfView> found = threshold_of(study, plans[v], folder, warnings, failure);
            if (!found) {
                return;
            }
            found->view = words_of(plans[v], plans[v].views.front());
            all.push_back(std::move(*found));
        }
    }
    const OutputFolder folder(options.out, {"bandwidth.json"});
    folder.write_json("bandwidth.json", json_of(all));
    print(text_of(all) + "\nall runs, their plots and pages: " + visible(folder.path("")) + "\n");
    print_warnings(warnings);
    if (failure) {
        throw FailureError(*failure);
    }
}

} // namespace

void add_bandwidth_command(CLI::App& program) {
    auto options = std::make_shared<BandwidthOptions>();
    CLI::App* command = program.add_subcommand(
        "bandwidth", "find the bandwidth from which memory does not limit a design any more");
    add_study_options(*command, options->study);
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for bandwidth.json and the runs");
    command->callback([options] { find_thresholds(*options); });
}

} // namespace degs::sim
