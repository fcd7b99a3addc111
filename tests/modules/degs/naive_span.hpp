// SPDX-License-Identifier: Apache-2.0
// A module of Span Units that is awake in every cycle and does what docs/span-unit.md says, in the
// plainest code. The arithmetic of rows is not its subject: x0 and the length of a span come from
// the log.
#pragma once

#include <numeric>
#include <tuple>

#include "tests/modules/degs/naive_block.hpp"

namespace degs::test {

/// Runs on what came in according to a log, and says what it takes and sends.
class NaiveSpan : public NaiveBlock {
public:
    NaiveSpan(const std::map<std::string, Number>& facts, const std::vector<LoggedEvent>& events)
        : NaiveBlock(facts, events) {
        for (const LoggedEvent& event : events) {
            if (event.kind() == "span" && event["end"] == 0) {
                spans_[{event["tile"], event["splat"], event["row"]}] = {event["x0"],
                                                                         event["length"]};
            }
            lanes_ = event.kind() == "row" ? std::max(lanes_, event["port"] + 1) : lanes_;
        }
        lanes_ = lanes_ / fact("streams"); // of a stream
        ports_ = fact("banks") / common();
    }

private:
    void follow() override {
        if (fact("pool") == 0) {
            run_unit();
        } else {
            run_pool();
        }
    }

    struct Stream {
        Number ends = 0;         // lanes that have delivered the end of the tile
        Number port = -1;        // to which the end goes next; -1: no end has to be sent
        Number tile = 0;         // that ends
        std::vector<bool> ended; // by lane
    };

    Number common() const { return std::gcd(fact("modules"), fact("banks")); }
    Number port_of(Number row) const { return row % fact("banks") / common(); }
    void send_end(Number port, Number tile) {
        fill("span", port, {tile, 1, 0, 0, 0, 0}, fact("latency_cycles"));
    }
    // A row that misses its tile sends nothing.
    bool send_span(Number port, const LoggedEvent& row) {
        const auto span = spans_.find({row["tile"], row["splat"], row["row"]});
        if (span == spans_.end()) {
            return false;
        }
        fill("span", port,
             {row["tile"], 0, row["splat"], row["row"], span->second.first, span->second.second},
             fact("latency_cycles"));
        return true;
    }

    // One unit with a lane and rows of its own.
    void run_unit() {
        while (left("row")) {
            wait_for("row");
            const LoggedEvent row = take("row");
            if (row["end"] != 0) {
                for (Number port = 0; port < ports_; ++port) {
                    wait_for_room(port);
                    send_end(port, row["tile"]);
                }
                continue;
            }
            const Number port = port_of(row["row"]);
            if (spans_.count({row["tile"], row["splat"], row["row"]}) != 0) {
                wait_for_room(port);
                send_span(port, row);
            }
            now_ += fact("cycles_per_row");
        }
    }

    // Units that share lanes.
    void run_pool() {
        streams_.resize(fact("streams"));
        for (Stream& stream : streams_) {
            stream.ended.resize(lanes_);
        }
        free_from_.resize(fact("units"));
        for (; left("row") || ending(); next_cycle()) {
            reads_.assign(fact("streams") * lanes_, 0);
            for (Number lane = 0; lane < Number(reads_.size()); ++lane) {
                look_at(lane);
            }
            for (Number& from : free_from_) {
                if (from <= now_ && take_rows() != 0) {
                    from = now_ + fact("cycles_per_row");
                }
            }
        }
    }
    bool ending() const {
        return std::any_of(streams_.begin(), streams_.end(),
                           [](const Stream& stream) { return stream.port >= 0; });
    }
    // From the lanes in turn. Returns the number of rows.
    Number take_rows() {
        Number taken = 0;
        const Number all = fact("streams") * lanes_;
        for (Number in_vain = 0; taken < fact("rows_per_cycle") && in_vain < all;) {
            look_at(next_lane_);
            const bool took = take_from(next_lane_);
            next_lane_ = (next_lane_ + 1) % all;
            taken += took ? 1 : 0;
            in_vain = took ? 0 : in_vain + 1;
        }
        return taken;
    }
    bool take_from(Number lane) {
        const Number stream = lane / lanes_;
        if (streams_[stream].ended[lane % lanes_] || !arrived("row", lane)) {
            return false;
        }
        const LoggedEvent& front = messages("row", lane).front().event;
        const bool has_port = fact("row_ports") == 0 || reads_[lane] < fact("row_ports");
        const Number port = stream * ports_ + port_of(front["row"]);
        if (front["end"] != 0 || !has_port || !room(port, 1)) {
            return false;
        }
        send_span(port, take("row", lane));
        ++reads_[lane];
        return true;
    }
    // A tile ends in all lanes of its stream together, and costs no unit's time. Its end passes at
    // the start of a cycle, or when a unit comes to the lane.
    void look_at(Number lane) {
        Stream& stream = streams_[lane / lanes_];
        pass_end(stream, lane);
        send_ends(stream, lane / lanes_ * ports_);
    }
    void pass_end(Stream& stream, Number lane) {
        if (stream.port >= 0 || stream.ended[lane % lanes_] || !arrived("row", lane) ||
            messages("row", lane).front().event["end"] == 0) {
            return;
        }
        stream.tile = take("row", lane)["tile"];
        stream.ended[lane % lanes_] = true;
        stream.port = ++stream.ends == lanes_ ? 0 : -1;
    }
    void send_ends(Stream& stream, Number first_port) {
        while (stream.port >= 0 && room(first_port + stream.port, 1)) {
            send_end(first_port + stream.port, stream.tile);
            if (++stream.port == ports_) {
                stream.port = -1;
                stream.ends = 0;
                stream.ended.assign(lanes_, false);
            }
        }
    }

    std::map<std::tuple<Number, Number, Number>, std::pair<Number, Number>> spans_;
    Number lanes_ = 1, ports_ = 1; // of a stream
    std::vector<Stream> streams_;
    std::vector<Number> free_from_; // by unit
    std::vector<Number> reads_;     // of each lane in this cycle
    Number next_lane_ = 0;
};

} // namespace degs::test
