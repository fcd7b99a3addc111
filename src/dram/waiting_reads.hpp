// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "dram/queue.hpp"

namespace degs::dram {

/// Reads that wait for their date or for room in the read queue. A level more (AxQOS) counts as
/// having come `step` reads earlier, so that none starves; of the level whose turn it is, urgent
/// reads get in before others, and older ones before younger ones.
class WaitingReads {
public:
    /// Whether the read queue has room, for urgent reads and for others.
    struct Room {
        bool urgent = false, ordinary = false;
    };

    explicit WaitingReads(int step) : step_(step) {}

    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    /// Dates never fall.
    void push(const Access& access) {
        const unsigned rank = rank_of(access);
        auto list = lists_.begin();
        while (list != lists_.end() && list->rank > rank) {
            ++list;
        }
        if (list == lists_.end() || list->rank != rank) {
            list = lists_.insert(list, {rank, {}});
        }
        list->reads.push_back({access, pushed_++});
        ++size_;
    }
    /// Such a read overtakes no other one.
    static bool is_lowest(const Access& access) { return rank_of(access) == 0; }
    bool has_lowest() const {
        return !lists_.empty() && lists_.back().rank == 0 && !lists_.back().reads.empty();
    }
    /// The earliest date of a read for which there is room; kNoDate if there is none.
    Ck next_date(const Room& room) const {
        Ck date = kNoDate;
        if (size_ != 0) {
            for (const List& list : lists_) {
                if (list.fits(room)) {
                    date = std::min(date, list.date());
                }
            }
        }
        return date;
    }
    bool ready(Ck date, const Room& room) const { return next_date(room) <= date; }
    /// Takes the first that is ready; there must be one.
    Access take(Ck date, const Room& room) {
        const unsigned qos = qos_of_first(date, room);
        const auto list = std::find_if(lists_.begin(), lists_.end(), [&](const List& each) {
            return each.ready(date, room) && each.qos() == qos;
        });
        const Access access = list->reads.front().access;
        list->reads.pop_front();
        --size_;
        return access;
    }
    /// Some wait for room.
    bool held_up(const Room& room) const {
        return std::any_of(lists_.begin(), lists_.end(), [&room](const List& list) {
            return !list.reads.empty() && !list.has_room(room);
        });
    }
    template <class Visit>
    void for_each(const Visit& visit) const {
        for (const List& list : lists_) {
            for (const Waiting& waiting : list.reads) {
                visit(waiting.access);
            }
        }
    }

private:
    struct Waiting {
        Access access;
        std::int64_t number; // of all reads so far
    };
    struct List {
        unsigned rank;
        std::deque<Waiting> reads;

        unsigned qos() const { return rank / 2; }
        Ck date() const { return reads.front().access.date; }
        bool has_room(const Room& room) const {
            return rank % 2 == 1 ? room.urgent : room.ordinary;
        }
        bool fits(const Room& room) const { return !reads.empty() && has_room(room); }
        bool ready(Ck date, const Room& room) const { return fits(room) && this->date() <= date; }
    };
    static unsigned rank_of(const Access& access) {
        return 2U * access.qos + (access.urgent ? 1 : 0);
    }
    unsigned qos_of_first(Ck date, const Room& room) const {
        std::int64_t least = std::numeric_limits<std::int64_t>::max();
        unsigned qos = 0;
        for (const List& list : lists_) {
            if (list.ready(date, room)) {
                const std::int64_t number =
                    list.reads.front().number - std::int64_t{step_} * list.qos();
                qos = number < least ? list.qos() : qos;
                least = std::min(least, number);
            }
        }
        return qos;
    }

    int step_;
    std::vector<List> lists_; // the highest first; only ranks that have come
    std::size_t size_ = 0;
    std::int64_t pushed_ = 0;
};

} // namespace degs::dram
