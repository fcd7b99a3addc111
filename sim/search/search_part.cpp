// SPDX-License-Identifier: Apache-2.0
#include "sim/search/search_part.hpp"

#include <algorithm>
#include <chrono>
#include <thread>

#include "base/grouped_number.hpp"
#include "config/config_words.hpp"
#include "sim/process/interruption.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/sweep/sweep_session.hpp"
#include "sim/text/progress.hpp"

namespace degs::sim {
namespace {

using Milliseconds = std::chrono::milliseconds;

/// Estimates take milliseconds and simulations minutes: looks grow rarer while nothing comes.
constexpr Milliseconds kFirstLook{10};
constexpr Milliseconds kLastLook{1000};

/// "0.5 minutes", "1 minute".
std::string minutes(double seconds) {
    const double count = seconds / 60;
    return config_words::number(count) + (count == 1 ? " minute" : " minutes");
}

} // namespace

std::string SearchPart::name() const {
    return "part " + std::to_string(task_.k) + " of " + std::to_string(task_.n);
}

std::vector<std::size_t> SearchPart::own_points(const StudyPlan& step, const PointStore& store,
                                                const std::string& folder) {
    if (is_alone()) {
        return points_of({0, step.points.size()});
    }
    added_.clear();
    for (std::size_t p = 0; p < step.points.size(); ++p) {
        if (seen_.insert(folder + "/" + step.points[p].key).second) {
            added_.push_back({p});
        }
    }
    for (std::size_t part = 1; part <= task_.n; ++part) {
        const PointRange range = shard_of(added_.size(), part, task_.n);
        for (std::size_t a = range.begin; a < range.end; ++a) {
            added_[a].part = part;
        }
    }
    std::vector<std::size_t> own;
    for (const Added& added : added_) {
        if (added.part == task_.k && (store.read(added.point) || !store.failure(added.point))) {
            own.push_back(added.point);
        }
    }
    return own;
}

/// "parts 1, 3 (4 points)".
std::string SearchPart::waiting_words(const std::vector<Added>& open) const {
    std::string parts;
    std::size_t last = 0;
    std::size_t count = 0;
    for (const Added& added : open) {
        if (added.part != last) {
            last = added.part;
            parts += (count++ == 0 ? "" : ", ") + std::to_string(last);
        }
    }
    return (count == 1 ? "part " : "parts ") + parts + " (" + grouped(open.size()) +
           (open.size() == 1 ? " point)" : " points)");
}

void SearchPart::wait_for_others(const PointStore& store) const {
    std::vector<Added> open = added_;
    StatusLine line;
    Stopwatch since_point;
    for (Milliseconds pause = kFirstLook;; pause = std::min(2 * pause, kLastLook)) {
        const std::size_t before = open.size();
        const auto is_known = [&store](const Added& added) {
            return store.read(added.point) || store.failure(added.point);
        };
        open.erase(std::remove_if(open.begin(), open.end(), is_known), open.end());
        if (open.empty()) {
            return;
        }
        if (open.size() < before) {
            since_point = Stopwatch();
            pause = kFirstLook;
        }
        const std::string awaited = waiting_words(open);
        if (since_point.seconds() > patience_) {
            throw FailureError(
                {kUserError, "This is " + name() + ", and has waited " + minutes(patience_) +
                                 " in vain for " + awaited +
                                 "; all parts must run at the same time, with the same options. "
                                 "The same command goes on in '" +
                                 store.folder().path("") + "'."});
        }
        set_interruption_sentence("Interrupted while " + name() + " waited for " + awaited +
                                  "; the same command goes on.");
        line.show("waiting for " + awaited);
        std::this_thread::sleep_for(pause);
    }
}

} // namespace degs::sim
