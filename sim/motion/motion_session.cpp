// SPDX-License-Identifier: Apache-2.0
#include "sim/motion/motion_session.hpp"

#include <nlohmann/json.hpp>

#include "degs/error.hpp"
#include "sim/page/page.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopping_signals.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/text/warnings.hpp"

namespace degs::sim {
namespace {

constexpr double kWritesApart = 1; // s
constexpr const char* kDocument = "motion.json";
constexpr const char* kTable = "motion.csv";
constexpr const char* kLatency = "latency.svg";
constexpr const char* kRefresh = "refreshes.svg";

} // namespace

std::vector<std::string> motion_files() {
    return {kDocument, kTable, kPageFile, kLatency, kRefresh};
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
        motion_.designs.push_back({config.name,
                                   std::vector<std::optional<double>>(motion_.times_s.size()),
                                   std::vector<std::optional<double>>(motion_.times_s.size())});
    }
}

const Motion& MotionSession::run() {
    for (std::size_t config = 0; config < request_.configs.size(); ++config) {
        const std::size_t frames = motion_.times_s.size();
        const bool follows = ViewRuns::follows(request_, config, 1);
        progress_.plan(follows ? 2 * frames - 1 : frames);
    }
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
    add_warnings(warnings_, summary.view.scene, summary.notes);
    add_warnings(warnings_, request_.configs[run.config].name, summary.warnings);
    put(run, summary.measures);
}

/// A frame that follows another one is what both take beyond the other one alone.
void MotionSession::put(const ViewRun& run, const Measures& measures) {
    DesignMotion& design = motion_.designs[run.config];
    const auto bytes_of = [](const Measures& m) -> std::optional<double> {
        const auto& read = m[Measure::DramRead];
        const auto& written = m[Measure::DramWritten];
        return read && written ? std::optional(*read + *written) : std::nullopt;
    };
    if (!ViewRuns::follows(request_, run.config, run.camera)) {
        design.ms[run.camera] = measures[Measure::LatencyMs];
        design.bytes[run.camera] = bytes_of(measures);
        return;
    }
    const auto [half, first] = halves_.try_emplace({run.config, run.camera}, run.path, measures);
    if (first) {
        return;
    }
    const Measures& both = run.path ? measures : half->second.second;
    const Measures& alone = run.path ? half->second.second : measures;
    const double clock = request_.configs[run.config].config.accelerator().clock_ghz;
    constexpr double kMsPerNs = 1e-6;
    if (both[Measure::Cycles] && alone[Measure::Cycles]) {
        design.ms[run.camera] =
            (*both[Measure::Cycles] - *alone[Measure::Cycles]) / clock * kMsPerNs;
    }
    if (const auto all = bytes_of(both), before = bytes_of(alone); all && before) {
        design.bytes[run.camera] = *all - *before;
    }
    halves_.erase(half);
}

void MotionSession::write() {
    judge_motion(motion_);
    out_.replace([this] {
        out_.write_json(kDocument, motion_json(words_, motion_));
        out_.write_text(kTable, motion_csv(motion_));
        out_.write_text(kLatency, motion_latency_svg(words_, motion_));
        out_.write_text(kRefresh, motion_refresh_svg(words_, motion_));
        out_.write_text(kPageFile, motion_page(words_, motion_));
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
