// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>

#include "dram/channel.hpp"

namespace degs::dram {

/// The future of a channel if nothing more comes: a copy that has been run ahead. It goes on as
/// long as what comes all the same cannot have changed anything that it has done, and is copied
/// again then. A backlog of posted writes is thus run through once and not once for each of them.
class Future {
public:
    /// Takes what the channel is about to take; `access` is Channel::marked(). Must come before
    /// Channel::push().
    void push(const Access& access);
    /// The copy goes on from what it has done, and does not need the channel's answers so far.
    bool holds() const { return holds_; }
    /// Copies the channel, which has run up to `known`, unless the copy holds.
    void follow(const Channel& channel, Ck known);
    /// Does what happens next, see Channel::step(). Appends the answers to `outcome`.
    void step(Outcome& outcome);

private:
    std::unique_ptr<Channel> copy_;
    bool holds_ = false;
    Ck until_ = 0; // nothing after this has been done
    // The first date from which an access of a kind would have found room in its queue and nobody
    // before it.
    std::array<Ck, Queues::kKinds> welcome_{};
};

} // namespace degs::dram
