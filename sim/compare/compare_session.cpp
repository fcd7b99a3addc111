// SPDX-License-Identifier: Apache-2.0
#include "sim/compare/compare_session.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include "degs/error.hpp"
#include "sim/compare/comparison_output.hpp"
#include "sim/page/page.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopping_signals.hpp"
#include "sim/text/warnings.hpp"
#include "sim/view/view.hpp"

namespace degs::sim {
namespace {

constexpr const char* kRatios = "ratios.svg";
constexpr const char* kSlots = "slots.svg";
constexpr const char* kUtilization = "utilization.svg";

} // namespace

std::vector<std::string> comparison_files() {
    return {"compare.json", "compare.csv", kPageFile, kRatios, kSlots, kUtilization};
}

CompareSession::CompareSession(const CompareRequest& request, const OutputFolder& out,
                               ViewsEnded views_ended, AreaScale scale)
    : request_(request), out_(out), views_ended_(std::move(views_ended)), scale_(scale),
      runs_(request,
            {{},
             [this](std::size_t cameras) {
                 progress_.plan(cameras * request_.sizes.size() * runs_.per_view());
             },
             [this](const ViewRun& run, ChildOutcome&& outcome) { end(run, std::move(outcome)); },
             [this](std::size_t scene, const Failure& failure, std::size_t lost) {
                 fail("", request_.scenes[scene], failure);
                 progress_.drop(lost);
             },
             [this](const ViewRun& view, const Failure& failure, std::size_t lost) {
                 fail("", view.words, failure);
                 progress_.drop(lost);
             },
             [this](const std::vector<std::string>& running) { progress_.show(running); }}) {}

Comparison CompareSession::run() {
    const std::size_t scenes = request_.scenes.size();
    if (request_.cameras) {
        progress_.plan(scenes * request_.cameras->size() * request_.sizes.size() *
                       runs_.per_view());
    }
    for (std::size_t s = 0; s < scenes && !interrupted_; ++s) {
        progress_.set_unknown_scenes(request_.cameras ? 0 : scenes - s - 1);
        interrupted_ = !runs_.run_scene(s, request_.cameras);
    }
    interrupted_ = !runs_.finish();
    if (unwritten_) {
        throw FailureError(*unwritten_);
    }
    if (!found_.empty()) {
        write(); // with failures that came after the last run
    }
    return comparison();
}

void CompareSession::end(const ViewRun& run, ChildOutcome&& outcome) {
    const bool good = !outcome.failure;
    try {
        // A report of this comparison does not stand beside the tables of an earlier one.
        out_.replace([&] {
            take(run, std::move(outcome));
            if (!found_.empty()) {
                write();
            }
        });
    } catch (const InputError& why) {
        unwritten_ =
            Failure{kUserError, "The results of " + run.name + " were not kept: " + why.what() +
                                    " The comparison stopped after " + progress_.words() + "."};
        runs_.stop();
        return;
    } catch (...) {
        fail(request_.configs[run.config].name, run.words, failure_of(std::current_exception()));
    }
    progress_.ended(run.name, run.clock.seconds(), good);
    set_interruption_sentence(interruption().sentence);
    ended_.resize(std::max(ended_.size(), run.view + 1), 0);
    ++ended_[run.view];
    tell_views();
}

// A view is a row of the comparison only if one of its runs has succeeded.
void CompareSession::tell_views() {
    const std::size_t before = told_;
    while (told_ < ended_.size() && ended_[told_] == runs_.per_view()) {
        ++told_;
    }
    if (told_ == before || !views_ended_) {
        return;
    }
    std::set<std::size_t> rows;
    for (const auto& [place, found] : found_) {
        if (found.frame && place.first < told_) {
            rows.insert(place.first);
        }
    }
    progress_.clear();
    views_ended_(comparison(), rows.size());
}

void CompareSession::take(const ViewRun& started, ChildOutcome&& outcome) {
    const std::string& name = request_.configs[started.config].name;
    if (outcome.failure) {
        fail(name, started.words, *outcome.failure);
        return;
    }
    RunSummary summary = summary_from(outcome.output);
    summary.view.dynamic = started.dynamic;
    summary.view.scene = runs_.label_of(started.scene);
    const OutputFolder folder(out_.path("reports/" + started.folder), {});
    const std::string file = std::to_string(started.config + 1) + "-" + file_name(name) +
                             (started.path ? "-path.json" : ".json");
    folder.write_text(file, summary.report);
    summary.report.clear();
    add_warnings(warnings_, summary.view.scene, summary.notes);
    add_warnings(warnings_, name, summary.warnings);
    Found& found = found_[{started.view, started.config}];
    (started.path ? found.path : found.frame) = std::move(summary);
    if (!started.path) {
        found.report = "reports/" + started.folder + "/" + file;
    }
}

void CompareSession::fail(const std::string& config, const std::string& view,
                          const Failure& failure) {
    failed_.push_back({config, view, failure.sentence});
    failures_.push_back(failure);
}

Comparison CompareSession::comparison() const {
    std::vector<std::string> names;
    for (const NamedConfig& config : request_.configs) {
        names.push_back(config.name);
    }
    std::vector<ComparedRun> runs;
    for (const auto& [place, found] : found_) {
        if (found.frame) { // a path alone has no latency to compare
            runs.push_back({names[place.second], *found.frame, found.path, found.report});
        }
    }
    Comparison result = compare(names, runs);
    result.failed = failed_;
    result.frames = request_.path.frames;
    result.path_step_degrees = request_.path.step_degrees;
    result.array_only = request_.array_only;
    return result;
}

void CompareSession::write() const {
    const Comparison now = comparison();
    out_.write_json("compare.json", comparison_json(now));
    out_.write_text("compare.csv", comparison_csv(now));
    out_.write_text(kPageFile, comparison_page(request_.configs, now));
    for (const auto& [file, picture] :
         {std::pair(kRatios, ratios_picture(now, scale_)), std::pair(kSlots, slots_picture(now)),
          std::pair(kUtilization, utilization_picture(now))}) {
        if (!picture.empty()) {
            out_.write_text(file, picture);
        }
    }
}

Failure CompareSession::interruption() const {
    return {interruption_code(),
            "Interrupted after " + progress_.words() +
                (found_.empty() ? "." : "; what they found is in '" + out_.path("") + "'.")};
}

std::optional<Failure> CompareSession::failure() const {
    if (interrupted_) {
        return interruption();
    }
    return worst_of(failures_, "parts of the comparison");
}

} // namespace degs::sim
