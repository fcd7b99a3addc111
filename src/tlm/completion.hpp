// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tlm/clock_domain.hpp"

namespace degs {

/// An answer of the memory that has not come yet. The kernel has not reached its date.
class LateAnswer {
public:
    bool known() const { return known_; }
    /// The date at which the answer came. Only if known().
    Cycle date() const { return date_; }
    /// Notes that the answer has come, and tells all who want to know, once.
    void come(Cycle date) {
        date_ = date;
        known_ = true;
        for (const auto& tell : std::exchange(told_, {})) {
            tell(date);
        }
    }
    /// Calls `tell` with the date when the answer comes. Only if not known().
    void on_come(std::function<void(Cycle)> tell) { told_.push_back(std::move(tell)); }

private:
    bool known_ = false;
    Cycle date_ = 0;
    std::vector<std::function<void(Cycle)>> told_;
};

/// The date at which an access to memory is complete. LT memories say it when they are asked; of
/// others it is known when their answer comes, which must not keep a block from its next access.
class Completion {
public:
    Completion(Cycle date = 0) : date_(date) {} // NOLINT(google-explicit-constructor): is a date
    explicit Completion(std::shared_ptr<LateAnswer> late) : late_(std::move(late)) {}

    bool known() const { return late_ == nullptr || late_->known(); }
    /// Throws std::logic_error if it is not known().
    Cycle date() const {
        if (late_ == nullptr) {
            return date_;
        }
        if (!late_->known()) {
            throw std::logic_error("an access to memory is not complete yet");
        }
        return late_->date();
    }
    /// Calls `tell` with the date, now or when the answer comes.
    void when_known(const std::function<void(Cycle)>& tell) const {
        if (known()) {
            tell(date());
        } else {
            late_->on_come(tell);
        }
    }
    /// The completion of both accesses together: the later one.
    friend Completion latest(const Completion& a, const Completion& b) {
        return a.late_ == nullptr && b.late_ == nullptr ? Completion(std::max(a.date_, b.date_))
                                                        : both(a, b);
    }
    friend bool operator==(const Completion& completion, Cycle date) {
        return completion.date() == date;
    }

private:
    static Completion both(const Completion& a, const Completion& b) {
        if (a.known() && b.known()) {
            return {std::max(a.date(), b.date())};
        }
        auto joined = std::make_shared<LateAnswer>();
        const auto tell = [joined, a, b](Cycle /*date*/) {
            if (!joined->known() && a.known() && b.known()) {
                joined->come(std::max(a.date(), b.date()));
            }
        };
        for (const Completion* each : {&a, &b}) {
            if (!each->known()) {
                each->late_->on_come(tell);
            }
        }
        return Completion(joined);
    }

    Cycle date_ = 0;
    std::shared_ptr<LateAnswer> late_;
};

} // namespace degs
