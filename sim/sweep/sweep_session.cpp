// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/sweep_session.hpp"

#include <algorithm>
#include <numeric>

#include "degs/error.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopping_signals.hpp"

namespace degs::sim {

PointRange shard_of(std::size_t points, std::size_t k, std::size_t n) {
    return {points * (k - 1) / n, points * k / n};
}

std::vector<std::size_t> points_of(PointRange range) {
    std::vector<std::size_t> points(range.end - range.begin);
    std::iota(points.begin(), points.end(), range.begin);
    return points;
}

SweepSession::SweepSession(const StudyPlan& plan, const PointStore& store,
                           const std::vector<std::size_t>& points, std::function<void()> finished)
    : plan_(plan), store_(store), finished_(std::move(finished)), runs_(plan.request, hooks()) {
    progress_.plan(points.size());
    std::size_t done = 0;
    for (const std::size_t p : points) {
        const StudyPoint& point = plan.points[p];
        if (store.read(p)) {
            ++done;
        } else {
            pending_[{point.scene, point.camera, point.size, point.variant}].point = p;
        }
    }
    progress_.resume(done);
}

SweepSession::Place SweepSession::place_of(const ViewRun& run) {
    return {run.scene, run.camera, run.size, run.config};
}

ViewRunsHooks SweepSession::hooks() {
    ViewRunsHooks hooks;
    hooks.wanted = [this](const ViewRun& run) { return pending_.count(place_of(run)) != 0; };
    hooks.ended = [this](const ViewRun& run, ChildOutcome&& outcome) {
        end(run, std::move(outcome));
    };
    hooks.scene_failed = [this](std::size_t scene, const Failure& failure, std::size_t) {
        fail_where(failure, [scene](const Place& place) { return std::get<0>(place) == scene; });
    };
    hooks.view_failed = [this](const ViewRun& view, const Failure& failure, std::size_t) {
        fail_where(failure, [&view](const Place& place) {
            ViewRun other = view;
            other.config = std::get<3>(place);
            return place_of(other) == place;
        });
    };
    hooks.tick = [this](const std::vector<std::string>& running) { progress_.show(running); };
    return hooks;
}

bool SweepSession::run() {
    set_interruption_sentence(interruption().sentence);
    for (const auto& [scene, cameras] : cameras_by_scene()) {
        interrupted_ = interrupted_ || !runs_.run_scene(scene, cameras);
    }
    interrupted_ = !runs_.finish();
    if (unwritten_) {
        throw FailureError(*unwritten_);
    }
    return !interrupted_;
}

/// In the order of the points.
std::map<std::size_t, std::vector<int>> SweepSession::cameras_by_scene() const {
    std::map<std::size_t, std::vector<int>> cameras;
    for (const StudyPoint& point : plan_.points) {
        std::vector<int>& list = cameras[point.scene];
        const Place place{point.scene, point.camera, point.size, point.variant};
        if (pending_.count(place) != 0 &&
            std::find(list.begin(), list.end(), point.camera) == list.end()) {
            list.push_back(point.camera);
        }
    }
    for (auto scene = cameras.begin(); scene != cameras.end();) {
        scene = scene->second.empty() ? cameras.erase(scene) : std::next(scene);
    }
    return cameras;
}

void SweepSession::end(const ViewRun& run, ChildOutcome&& outcome) {
    const bool good = !outcome.failure;
    try {
        if (take(run, std::move(outcome))) {
            progress_.ended(run.name, run.clock.seconds(), good);
            set_interruption_sentence(interruption().sentence);
            if (finished_) {
                finished_();
            }
        }
    } catch (const InputError& why) {
        stop(run, why.what());
    }
}

void SweepSession::stop(const ViewRun& run, const std::string& why) {
    const auto entry = pending_.find(place_of(run));
    const std::string lost =
        entry == pending_.end()
            ? "The results could not be written: "
            : "Point " + std::to_string(entry->second.point + 1) + " was not kept: ";
    unwritten_ = Failure{kUserError, lost + why + " The sweep stopped with " + progress_.words() +
                                         " done; the same command goes on with the others."};
    runs_.stop();
}

bool SweepSession::take(const ViewRun& run, ChildOutcome&& outcome) {
    const auto entry = pending_.find(place_of(run));
    if (entry == pending_.end()) {
        return false; // the point's other run has failed
    }
    if (outcome.failure) {
        fail(entry->first, *outcome.failure);
        return true;
    }
    Pending& pending = entry->second;
    RunSummary summary;
    try {
        summary = summary_from(outcome.output);
    } catch (...) {
        fail(entry->first, failure_of(std::current_exception()));
        return true;
    }
    if (run.path) {
        pending.found.path = std::move(summary);
    } else {
        pending.found.frame = std::move(summary);
        pending.frame_found = true;
    }
    if (!pending.frame_found || (plan_.request.path.frames > 1 && !pending.found.path)) {
        return false;
    }
    store_.keep(pending.point, pending.found);
    failures_.erase(pending.point);
    pending_.erase(entry);
    return true;
}

void SweepSession::fail(const Place& place, const Failure& failure) {
    const auto entry = pending_.find(place);
    if (entry == pending_.end()) {
        return;
    }
    const std::size_t point = entry->second.point;
    failures_[point] = failure;
    try {
        store_.keep_failure(point, failure);
    } catch (const InputError& full) {
        throw InputError(failure.sentence + " " + full.what());
    }
    pending_.erase(entry);
}

void SweepSession::fail_where(const Failure& failure,
                              const std::function<bool(const Place&)>& concerned) {
    std::vector<Place> places;
    for (const auto& [place, pending] : pending_) {
        if (concerned(place)) {
            places.push_back(place);
        }
    }
    for (const Place& place : places) {
        const std::string& name = plan_.variants[std::get<3>(place)].name;
        fail(place, failure);
        progress_.ended(name, 0, false);
    }
}

Failure SweepSession::interruption() const {
    return {interruption_code(), "Interrupted after " + progress_.words() +
                                     "; the same command goes on with the others in '" +
                                     store_.folder().path("") + "'."};
}

std::optional<Failure> SweepSession::failure() const {
    if (interrupted_) {
        return interruption();
    }
    std::vector<Failure> all;
    for (const auto& [point, failure] : failures_) {
        all.push_back(failure);
    }
    return worst_of(all, "points");
}

} // namespace degs::sim
