// SPDX-License-Identifier: Apache-2.0
// A bank's part of the Feature Buffer in the plainest code, see naive_bank.hpp.
#pragma once

#include <algorithm>
#include <deque>

#include "tests/modules/degs/scheduler/naive_facts.hpp"

namespace degs::test {

class NaiveFeatures {
public:
    struct Splat {
        Number tile = -1, splat = 0, entry = 0;
    };
    using Open = std::deque<Splat>; ///< splats of a stream of which more rows may come

    explicit NaiveFeatures(const NaiveFacts& facts)
        : facts_(facts), entries_(facts.feature_entries),
          write_ports_(facts.fill_ports * facts.fill_sram_banks) {
        for (std::size_t i = 0; i < entries_.size(); ++i) {
            free_.push_back({Number(i), 0});
        }
    }
    /// Makes a splat the current one. False if no entry is free.
    bool admit(Open& open, Number tile, Number splat, Number now) {
        for (const Splat& one : open) {
            if (one.tile == tile && one.splat == splat) {
                current_ = one;
                return true;
            }
        }
        const Number share = Number(entries_.size()) / facts_.streams;
        if (Number(open.size()) == std::min(facts_.open_splats, share)) {
            close_oldest(open, now);
        }
        if (free_.size() == entries_.size() && free_.back().from <= now) { // all are free
            std::sort(free_.begin(), free_.end(),
                      [](const Free& a, const Free& b) { return a.entry < b.entry; });
        }
        if (free_.empty() || free_.front().from > now) {
            return false;
        }
        current_ = {tile, splat, free_.front().entry};
        free_.pop_front();
        entries_[current_.entry] = {1, now, fill(current_.entry, now)};
        open.push_back(current_);
        return true;
    }
    const Splat& current() const { return current_; }
    Number filled() const { return entries_[current_.entry].filled; }
    void hold(Number entry) { ++entries_[entry].held; }
    /// Entries come back in the order in which they are given back.
    void release(Number entry, Number date) {
        Entry& e = entries_[entry];
        e.needed = std::max(e.needed, date);
        if (--e.held == 0) {
            latest_ = std::max(latest_, e.needed);
            free_.push_back({entry, latest_});
        }
    }
    void close_oldest(Open& open, Number now) {
        const Number entry = open.front().entry;
        open.pop_front();
        release(entry, now);
    }

private:
    struct Entry {
        Number held = 0, needed = 0, filled = 0;
    };
    struct Free {
        Number entry, from;
    };
    Number fill(Number entry, Number now) {
        if (write_ports_.empty() || facts_.fill_cycles == 0) {
            return now + facts_.fill_cycles;
        }
        const auto first =
            write_ports_.begin() + entry % facts_.fill_sram_banks * facts_.fill_ports;
        Number& port = *std::min_element(first, first + facts_.fill_ports);
        port = std::max(port, now) + facts_.fill_cycles;
        return port;
    }

    const NaiveFacts& facts_;
    std::vector<Entry> entries_;
    std::vector<Number> write_ports_; // dates at which they are free, SRAM bank by bank
    std::deque<Free> free_;
    Splat current_;
    Number latest_ = 0;
};

} // namespace degs::test
