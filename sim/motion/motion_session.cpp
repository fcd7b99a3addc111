// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_session.hpp"

#include <nlohmann/json.hpp>

#include "degs/error.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopping_signals.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/simulation/warnings.hpp"

namespace degs::sim {
namespace {

constexpr double kWritesApart = 1; // s
constexpr const char* kDocument = "motion.json";
constexpr const char* kTable = "motion.csv";
constexpr const char* kIndex = "index.html";
constexpr const char* kLatency = "latency.svg";
constexpr const char* kRefresh = "refreshes.svg";

} // namespace

std::vector<std::string> motion_files() {
    return {kDocument, kTable, kIndex, kLatency, kRefresh};
}

MotionSession::MotionSession(const CompareRequest& request, const OutputFolder& out,
                             MotionWords words, Motion motion)
    : request_(request), out_(out), words_(std::move(words)), motion_(std::move(motion)),
      runs_(request,
            {{},
             {},
             [this](const ViewRun& run, ChildOutcome&& outcome) { end(run, std::move(outcome)); },
             [this](std::size_t, const Failure& failure, std::size_t lost) {
                 failures_.push_back(failure);
                 progress_.drop(lost);
             },
             [this](const ViewRun&, const Failure& failure, std::size_t lost) {
                 failures_.push_back(failure);
                 progress_.drop(lost);
             },
             [this](const std::vector<std::string>& running) { progress_.show(running); }}) {
    for (const NamedConfig& config : request.configs) {
        motion_.designs.push_back(
            {config.name, std::vector<std::optional<double>>(motion_.times_s.size())});
    }
}

const Motion& MotionSession::run() {
    progress_.plan(motion_.times_s.size() * request_.configs.size());
    interrupted_ = !runs_.run_scene(0, request_.cameras);
    interrupted_ = !runs_.finish();
    progress_.clear();
    if (unwritten_) {
        throw FailureError(*unwritten_);
    }
    if (found_) {
        write();
    }
    return motion_;
}

void MotionSession::end(const ViewRun& run, ChildOutcome&& outcome) {
    const bool good = !outcome.failure;
    try {
        take(run, outcome);
        if (found_ && written_.seconds() >= kWritesApart) { // a long path has large files
            write();
        }
    } catch (const InputError& why) {
        unwritten_ =
            Failure{kUserError, "The results of " + run.name + " were not kept: " + why.what() +
                                    " The path stopped after " + progress_.words() + "."};
        runs_.stop();
        return;
    } catch (...) {
        failures_.push_back(failure_of(std::current_exception()));
    }
    progress_.ended(run.name, run.clock.seconds(), good);
    set_interruption_sentence(interruption().sentence);
}

void MotionSession::take(const ViewRun& run, const ChildOutcome& outcome) {
    if (outcome.failure) {
        failures_.push_back(*outcome.failure);
        return;
    }
    const RunSummary summary = summary_from(outcome.output);
    found_ = true;
    add_warnings(warnings_, request_.configs[run.config].name, summary.warnings);
    motion_.designs[run.config].ms[run.camera] = summary.measures[Measure::LatencyMs];
}

void MotionSession::write() {
    judge_motion(motion_);
    out_.replace([this] {
        out_.write_json(kDocument, motion_json(words_, motion_));
        out_.write_text(kTable, motion_csv(motion_));
        out_.write_text(kLatency, motion_latency_svg(words_, motion_));
        out_.write_text(kRefresh, motion_refresh_svg(words_, motion_));
        out_.write_text(kIndex, motion_page(words_, motion_));
    });
    written_ = Stopwatch();
}

Failure MotionSession::interruption() const {
    return {interruption_code(), "Interrupted after " + progress_.words() +
                                     "; what they found is in '" + out_.path("") + "'."};
}

std::optional<Failure> MotionSession::failure() const {
    if (interrupted_) {
        return interruption();
    }
    return worst_of(failures_, "frames");
}

} // namespace degs::sim
