// SPDX-License-Identifier: Apache-2.0
// Drives the RTL of an Issue Bank with what came in according to a log, and compares what it takes,
// issues and packs, and the tiles that it ends, cycle by cycle.
#pragma once

#include <cstring>
#include <deque>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "tests/rtl/ports.hpp"
#include "tests/sim/trace/block_log.hpp"

namespace degs::rtl_test {

using degs::test::LoggedEvent;
using Number = std::int64_t;

/// The parameters of bank_top.sv.
struct BankShape {
    int streams, slots, domains, issue, width, seg, complete, items, messages;
    /// Bits of a domain among all tiles in flight.
    int domain_bits() const {
        int bits = 1;
        while ((1 << bits) < streams * slots * domains + 1) {
            ++bits;
        }
        return bits;
    }
};

/// What a run has compared.
struct Compared {
    std::uint64_t cycles = 0, spans = 0, segments = 0, packets = 0, tasks = 0, tiles = 0;
    std::uint64_t differences = 0;
    std::string first; ///< difference
};

template <class Rtl>
class BankBench {
public:
    BankBench(const BankShape& shape, const sim_test::BlockLog& log)
        : shape_(shape), facts_(log.facts()), streams_(shape.streams) {
        for (const LoggedEvent& event : log.events) {
            add(event);
        }
    }
    Compared run() {
        reset();
        for (now_ = first_; now_ <= last_ && done_.differences < 20; ++now_, ++done_.cycles) {
            drive();
            rtl_.eval();
            compare_intake();
            compare_issues();
            compare_packets();
            compare_tiles();
            clock();
        }
        return done_;
    }

private:
    static constexpr Number kNobody = 0xFFFFFFFF;
    static constexpr int kTagBits = 32, kTaskBits = kTagBits + 5, kByte = 8, kTagOfSpan = 3;
    struct Item {
        Number readable;
        bool end;
        int row, x0, length, tile, width;
        std::uint32_t tag;
    };
    /// What a cycle has in the log, in its order.
    struct Expected {
        std::vector<const LoggedEvent*> issues, packets, ended_pixels;
        std::vector<int> taken, contexts, over; // by stream
    };

    int tag_of(Number tile) const { return order_.at(tile) % 256; }
    Expected& at(Number now) {
        first_ = std::min(first_, now);
        last_ = std::max(last_, now);
        Expected& cycle = cycles_[now];
        cycle.taken.resize(streams_.size());
        cycle.contexts.resize(streams_.size());
        cycle.over.resize(streams_.size());
        return cycle;
    }
    int stream_of(Number context) const {
        return static_cast<int>((context - facts_.at("first_context")) / facts_.at("contexts"));
    }
    void add(const LoggedEvent& event) {
        const auto now = static_cast<Number>(event.now);
        if (event.kind() == "tile") {
            order_.emplace(event["tile"], static_cast<int>(order_.size()));
            widths_[event["tile"]] = static_cast<int>(event["last_column"]) + 1; // whole images
        } else if (event.kind() == "span" && event["tile"] != kNobody) {
            add_item(event);
            ++at(now).taken[event["port"]];
        } else if (event.kind() == "context_free") {
            ++at(now - event["waited"]).contexts[event["port"]];
        } else if (event.kind() == "terminated") {
            at(now - event["waited"]).ended_pixels.push_back(&event);
        } else if (event.kind() == "issue") {
            at(now).issues.push_back(&event);
        } else if (event.kind() == "packet" && event["tasks"] != 0) {
            at(now).packets.push_back(&event);
        } else if (event.kind() == "over") {
            ++at(now).over[stream_of(event["context"])];
        }
    }
    void add_item(const LoggedEvent& event) {
        const Number banks = facts_.at("banks");
        const auto key = std::make_tuple(event["tile"], event["splat"], event["row"]);
        const auto tag = static_cast<std::uint32_t>(spans_.size()) << kTagOfSpan;
        const bool end = event["end"] != 0;
        if (!end) {
            spans_[key] = tag;
        }
        streams_[event["port"]].push_back({static_cast<Number>(event.now) - event["waited"], end,
                                           static_cast<int>(event["row"] / banks),
                                           static_cast<int>(event["x0"]),
                                           static_cast<int>(event["length"]), tag_of(event["tile"]),
                                           widths_.at(event["tile"]), tag});
    }

    void reset() {
        rtl_.rst = 1;
        rtl_.clk = 0;
        rtl_.eval();
        clock();
        rtl_.rst = 0;
    }
    void clock() {
        rtl_.clk = 1;
        rtl_.eval();
        rtl_.clk = 0;
        rtl_.eval();
    }
    void drive() {
        for (auto clear : {0, 1}) { // every input that is not set below
            (void)clear;
            rtl_.t_valid = 0;
            rtl_.context_free = 0;
        }
        set(rtl_.s_valid, 0, shape_.streams * shape_.items, 0);
        for (int s = 0; s < shape_.streams; ++s) {
            for (int i = 0; i < shape_.items; ++i) {
                offer(s, i);
            }
        }
        const auto cycle = cycles_.find(now_);
        expected_ = cycle == cycles_.end() ? nullptr : &cycle->second;
        if (expected_ == nullptr) {
            return;
        }
        for (int s = 0; s < shape_.streams; ++s) {
            set(rtl_.context_free, 2 * s, 2, expected_->contexts[s]);
        }
        int message = 0;
        for (const LoggedEvent* const event : expected_->ended_pixels) {
            tell(*event, message++);
        }
    }
    void offer(int stream, int place) {
        auto& items = streams_[stream];
        if (static_cast<std::size_t>(place) >= items.size() || items[place].readable > now_) {
            return;
        }
        const Item& item = items[place];
        const int port = stream * shape_.items + place;
        set(rtl_.s_valid, port, 1, 1);
        set(rtl_.s_end, port, 1, item.end ? 1 : 0);
        set(rtl_.s_row, port * kByte, kByte, item.row);
        set(rtl_.s_x0, port * kByte, kByte, item.x0);
        set(rtl_.s_length, port * kByte, kByte, item.length);
        set(rtl_.s_tile, port * kByte, kByte, item.tile);
        set(rtl_.s_width, port * kByte, kByte, item.width);
        set(rtl_.s_tag, port * kTagBits, kTagBits, item.tag);
    }
    void tell(const LoggedEvent& event, int message) {
        if (message == shape_.messages) {
            differ("more messages about ended pixels than ports", message, shape_.messages);
            return;
        }
        const Number per_row = (facts_.at("tile_size") + shape_.seg - 1) / shape_.seg;
        const Number domain =
            event["row"] / facts_.at("banks") * per_row + event["column"] / shape_.seg;
        set(rtl_.t_valid, message, 1, 1);
        set(rtl_.t_tile, message * kByte, kByte, tag_of(event["tile"]));
        set(rtl_.t_domain, message * kByte, kByte, domain);
        set(rtl_.t_mask, message * shape_.seg, shape_.seg, event["mask"]);
    }

    void differ(const std::string& what, Number rtl, Number model) {
        if (done_.differences++ == 0) {
            done_.first = "cycle " + std::to_string(now_) + ": " + what + ": RTL " +
                          std::to_string(rtl) + ", model " + std::to_string(model);
        }
    }
    bool same(const std::string& what, Number rtl, Number model) {
        if (rtl != model) {
            differ(what, rtl, model);
        }
        return rtl == model;
    }
    void compare_intake() {
        for (int s = 0; s < shape_.streams; ++s) {
            const auto taken = static_cast<int>(get(rtl_.s_taken, 4 * s, 4));
            same("items taken", taken, expected_ == nullptr ? 0 : expected_->taken[s]);
            done_.spans += taken;
            streams_[s].erase(streams_[s].begin(),
                              streams_[s].begin() +
                                  std::min<std::ptrdiff_t>(taken, streams_[s].size()));
        }
    }
    void compare_issues() {
        const std::size_t model = expected_ == nullptr ? 0 : expected_->issues.size();
        const int bits = shape_.domain_bits();
        std::size_t rtl = 0;
        for (int place = 0; place < shape_.issue; ++place) {
            if (get(rtl_.i_valid, place, 1) == 0) {
                continue; // a pick of a pipelined bank that went before, or was lost
            }
            if (rtl < model) {
                const LoggedEvent& event = *expected_->issues[rtl];
                same("tasks issued", get(rtl_.i_mask, place * shape_.seg, shape_.seg),
                     event["mask"]);
                same("domain issued", get(rtl_.i_domain, place * bits, bits) % shape_.domains,
                     event["domain"]);
            }
            ++rtl;
        }
        same("segments issued", rtl, model);
        done_.segments += rtl;
    }
    void compare_packets() {
        const std::size_t model = expected_ == nullptr ? 0 : expected_->packets.size();
        std::size_t rtl = 0;
        for (; rtl <= static_cast<std::size_t>(shape_.complete) && get(rtl_.p_valid, rtl, 1) != 0;
             ++rtl) {
            if (rtl < model) {
                compare_packet(*expected_->packets[rtl], rtl);
            }
        }
        same("packets", rtl, model);
        done_.packets += rtl;
    }
    void compare_packet(const LoggedEvent& event, std::size_t place) {
        const auto tasks = static_cast<std::size_t>(get(rtl_.p_tasks, place * kByte, kByte));
        const Number slot = now_ + facts_.at("packet_latency") + rtl_.i_rel + Number(place);
        if (!same("tasks of a packet", tasks, event["tasks"])) {
            return;
        }
        same("slot of a packet", slot, event["slot"]);
        std::size_t lane = place * shape_.width;
        for (std::size_t run = 0; run < event.parts; ++run) {
            enum { kTile, kContext, kDomain, kSplat, kRow, kColumn, kMask, kPart };
            const std::uint32_t tag =
                spans_.at(
                    {event.part(run, kTile), event.part(run, kSplat), event.part(run, kRow)}) +
                static_cast<std::uint32_t>(event.part(run, kColumn) / shape_.seg);
            for (int pixel = 0; pixel < shape_.seg; ++pixel) {
                if ((event.part(run, kPart) >> pixel & 1) != 0) {
                    same("pixel of a task", get(rtl_.p_lanes, lane * kTaskBits, 5), pixel);
                    same("segment of a task", get(rtl_.p_lanes, lane * kTaskBits + 5, kTagBits),
                         tag);
                    ++lane;
                }
            }
        }
        done_.tasks += tasks;
    }
    void compare_tiles() {
        for (int s = 0; s < shape_.streams; ++s) {
            const Number rtl = get(rtl_.ended, 2 * s, 2);
            same("tiles over", rtl, expected_ == nullptr ? 0 : expected_->over[s]);
            done_.tiles += rtl;
        }
    }

    BankShape shape_;
    std::map<std::string, Number> facts_;
    std::map<Number, Expected> cycles_;
    std::vector<std::deque<Item>> streams_;
    std::map<Number, int> order_, widths_; // of tiles
    std::map<std::tuple<Number, Number, Number>, std::uint32_t> spans_;
    Number first_ = std::numeric_limits<Number>::max(), last_ = 0, now_ = 0;
    const Expected* expected_ = nullptr;
    Rtl rtl_;
    Compared done_;
};

} // namespace degs::rtl_test
