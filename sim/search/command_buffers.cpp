// SPDX-License-Identifier: Apache-2.0
// degs buffers: the smallest buffers that lose little on some views.
#include <memory>

#include <nlohmann/json.hpp>

#include "base/grouped_number.hpp"
#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "sim/report/report.hpp"
#include "sim/search/buffer_fit.hpp"
#include "sim/search/design_study.hpp"
#include "sim/search/search.hpp"
#include "sim/shell/commands.hpp"
#include "sim/shell/view_options.hpp"
#include "sim/study/addressed_overrides.hpp"
#include "sim/study/study_options.hpp"
#include "sim/text/standard_output.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/warnings.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

/// Raised whenever a key of buffers.json changes its meaning, name or unit.
constexpr int kBuffersVersion = 1;

struct BuffersOptions {
    StudyOptions study;
    double lose = 1; ///< percent of the frames per second, on the view that loses most
    int jobs = 1;
    std::string out = "out";
};

/// A buffer before and after.
struct FittedBuffer {
    std::string key;
    double before = 0, after = 0; ///< bytes
};

struct FittedDesign {
    std::vector<FittedBuffer> buffers;
    double area_before = 0, area_after = 0; ///< mm²
    double loss = 0;                        ///< of the speed, on the view that loses most
    std::size_t simulated = 0;              ///< designs

    double bytes(double FittedBuffer::*when) const {
        double sum = 0;
        for (const FittedBuffer& buffer : buffers) {
            sum += buffer.*when;
        }
        return sum;
    }
};

FittedDesign fitted(const StudyPlan& plan, const BufferFit& fit) {
    FittedDesign found;
    const StudyVariant& before = plan.variants[plan.baseline];
    const StudyVariant& after = plan.variants[fit.smallest()];
    for (std::size_t k = 0; k < plan.keys.size(); ++k) {
        found.buffers.push_back(
            {plan.keys[k], std::stod(before.values[k]), std::stod(after.values[k])});
    }
    const auto area = [&plan](std::size_t variant) {
        return plan.request.configs[variant].config.accelerator().bill().area_mm2();
    };
    found.area_before = area(plan.baseline);
    found.area_after = area(fit.smallest());
    found.loss = 1 - fit.verdict().limits.front().value.value_or(1);
    found.simulated = fit.simulated();
    return found;
}

std::string count_of(double bytes) {
    return grouped(static_cast<std::uint64_t>(bytes));
}

/// What --set takes for the smallest buffers.
std::vector<std::string> settings_of(const FittedDesign& found) {
    std::vector<std::string> settings;
    for (const FittedBuffer& buffer : found.buffers) {
        if (buffer.after != buffer.before) {
            settings.push_back(buffer.key + "=" + decimal_text(buffer.after));
        }
    }
    return settings;
}

std::string text_of(const FittedDesign& found, std::size_t views) {
    TextTable table({"buffer", "bytes", "smallest", "unused, %"});
    const auto add = [&table](const std::string& name, double before, double after) {
        table.add({name, count_of(before), count_of(after), percent(1 - after / before)});
    };
    for (const FittedBuffer& buffer : found.buffers) {
        add(buffer.key, buffer.before, buffer.after);
    }
    add("all", found.bytes(&FittedBuffer::before), found.bytes(&FittedBuffer::after));
    std::string text = table.text() + "\nWith the smallest buffers the design takes " +
                       three_digits(found.area_after) + " of " + three_digits(found.area_before) +
                       " mm² and loses " + percent(std::max(found.loss, 0.0), 2) +
                       " % of its speed";
    text += views == 1 ? "" : " on the one of " + std::to_string(views) + " views that loses most";
    text += "; " + count_words(found.simulated, "design was", "designs were") + " simulated.\n";
    std::string settings;
    for (const std::string& setting : settings_of(found)) {
        settings += " --set " + setting;
    }
    return text + (settings.empty() ? "No buffer can be smaller by a step.\n"
                                    : "As options:" + settings + "\n");
}

nlohmann::ordered_json json_of(const FittedDesign& found) {
    nlohmann::ordered_json buffers = nlohmann::ordered_json::array();
    for (const FittedBuffer& buffer : found.buffers) {
        buffers.push_back(
            {{"key", buffer.key}, {"bytes", buffer.before}, {"smallest_bytes", buffer.after}});
    }
    return {{"version", kBuffersVersion},
            {"tool", tool_json()},
            {"buffers", buffers},
            {"bytes", found.bytes(&FittedBuffer::before)},
            {"smallest_bytes", found.bytes(&FittedBuffer::after)},
            {"area_mm2", found.area_before},
            {"smallest_area_mm2", found.area_after},
            {"loss", found.loss},
            {"simulated", found.simulated},
            {"settings", settings_of(found)}};
}

Study fitted_study(const BuffersOptions& options) {
    Study study = study_of_designs(study_of(options.study), options.study.file, "degs buffers");
    if (study.designs.size() != 1) {
        throw InputError(options.study.file + " has " + std::to_string(study.designs.size()) +
                         " designs, but 'degs buffers' takes one.");
    }
    if (study.analytic) {
        throw InputError("'degs buffers' simulates, because estimates do not know how full buffers "
                         "become; leave out '--fidelity analytic'.");
    }
    study.limits = {"worst(ratio.latency)>=" + decimal_text(1 - options.lose / 100), "--lose"};
    std::vector<std::string> fixed;
    for (const std::string& text : overrides_of(study.designs.front().name, study.overrides)) {
        fixed.push_back(override_path(text));
    }
    study.axes = buffer_axes(first_design(study), fixed);
    if (study.axes.empty()) {
        throw InputError(options.study.file +
                         ": the design has no buffer whose bytes are a key that is not set.");
    }
    return study;
}

void fit_buffers(const BuffersOptions& options) {
    const Study study = fitted_study(options);
    StudyPlan plan = plan_views(study);
    plan.request.jobs = options.jobs;
    DesignSpace space(study, plan);
    space.add_baseline();
    BufferFit fit(space, plan);
    SearchPart alone;
    std::optional<Failure> failure;
    if (search(plan, fit, alone, options.out, failure)) {
        if (fit.verdict().goals.empty()) {
            throw FailureError(failure.value());
        }
        const FittedDesign found = fitted(plan, fit);
        const OutputFolder folder(options.out, {"buffers.json"});
        folder.write_json("buffers.json", json_of(found));
        print(text_of(found, plan.views.size()) +
              "all runs, their plots and the page: " + visible(folder.path("")) + "\n");
        print_warnings(fit.results().warnings);
    }
    if (failure) {
        throw FailureError(*failure);
    }
}

} // namespace

void add_buffers_command(CLI::App& program) {
    auto options = std::make_shared<BuffersOptions>();
    CLI::App* command = program.add_subcommand(
        "buffers", "find the smallest buffers of a design that lose little on some views");
    add_study_options(*command, options->study);
    command
        ->add_option("--lose", options->lose,
                     "percent of the speed that may be lost on any of the views")
        ->type_name("PERCENT")
        ->check(CLI::Range(0.0, 50.0))
        ->capture_default_str();
    add_jobs_option(*command, options->jobs);
    add_out_option(*command, options->out, "folder for buffers.json and the runs");
    command->callback([options] { fit_buffers(*options); });
}

} // namespace degs::sim
