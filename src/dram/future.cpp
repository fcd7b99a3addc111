// SPDX-License-Identifier: Apache-2.0
#include "dram/future.hpp"

#include <algorithm>

namespace degs::dram {

// An access changes nothing before it gets into its queue.
void Future::push(const Access& access) {
    if (!holds_) {
        return;
    }
    Ck& welcome = welcome_[Queues::kind_of(access)];
    holds_ = std::max(access.date, welcome) > until_;
    if (holds_) {
        copy_->push_marked(access);
        welcome = kNoDate;
    }
}

void Future::follow(const Channel& channel, Ck known) {
    if (holds_) {
        return;
    }
    if (copy_ == nullptr) {
        copy_ = std::make_unique<Channel>(channel);
    } else {
        *copy_ = channel;
    }
    copy_->observe({});
    holds_ = true;
    until_ = known;
    welcome_.fill(kNoDate);
}

void Future::step(Outcome& outcome) {
    const std::size_t before = outcome.admitted.size();
    until_ = std::max(until_, copy_->step(outcome));
    if (std::find(welcome_.begin(), welcome_.end(), kNoDate) == welcome_.end()) {
        return;
    }
    const bool admitted = outcome.admitted.size() != before;
    for (const Queues::Kind kind : {Queues::kWrite, Queues::kFavouredRead, Queues::kRead}) {
        // A read may have taken room that one of a higher level, or an urgent one, would have had.
        const bool overtakes = kind == Queues::kFavouredRead && admitted;
        if (welcome_[kind] == kNoDate && (overtakes || copy_->welcomes(kind))) {
            welcome_[kind] = until_;
        }
    }
}

} // namespace degs::dram
