// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace degs {

/// The conflict domains that an Issue Bank has chosen and whose segments it has not packed yet:
/// groups of at most `width` picks, one group for each cycle from the choice to the packing, empty
/// ones included. The oldest group is packed pick by pick. Once nothing of it is left, it becomes
/// the newest one, which the next choice fills.
class PickPipeline {
public:
    /// A domain that the bank has chosen: of which stream, of which of its tiles, and its number
    /// there.
    struct Pick {
        std::size_t stream = 0, turn = 0;
        int domain = 0;
    };

    /// `groups` is 0 in a bank that packs a segment in the cycle in which it chooses it.
    PickPipeline(int groups, int width) : groups_(groups) {
        for (Group& group : groups_) {
            group.picks.reserve(width);
        }
    }
    bool exists() const { return !groups_.empty(); }
    bool empty() const { return size_ == 0; }

    /// The pick that is packed next; nullptr if nothing is left of the oldest group.
    const Pick* front() const {
        const Group& group = groups_[oldest_];
        return group.packed < group.picks.size() ? &group.picks[group.packed] : nullptr;
    }
    void pop() {
        ++groups_[oldest_].packed;
        --size_;
    }
    /// The oldest group, of which nothing is left, becomes the newest one, which
    /// add() fills.
    void shift() {
        newest_ = oldest_;
        groups_[newest_].picks.clear();
        groups_[newest_].packed = 0;
        oldest_ = oldest_ + 1 < groups_.size() ? oldest_ + 1 : 0;
    }
    /// Adds a pick to the newest group.
    void add(const Pick& pick) {
        groups_[newest_].picks.push_back(pick);
        ++size_;
    }
    /// Removes a pick whose domain has lost its segments. Its place in the group stays empty.
    void remove(const Pick& lost) {
        for (Group& group : groups_) {
            for (std::size_t i = group.packed; i < group.picks.size(); ++i) {
                const Pick& pick = group.picks[i];
                if (pick.stream == lost.stream && pick.turn == lost.turn &&
                    pick.domain == lost.domain) {
                    group.picks.erase(group.picks.begin() + static_cast<std::ptrdiff_t>(i));
                    --size_;
                    return;
                }
            }
        }
    }

private:
    struct Group {
        std::vector<Pick> picks;
        std::size_t packed = 0; // of them
    };
    std::vector<Group> groups_;
    std::size_t oldest_ = 0, newest_ = 0;
    std::size_t size_ = 0; // picks in all groups
};

} // namespace degs
