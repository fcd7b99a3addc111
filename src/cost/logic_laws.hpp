// SPDX-License-Identifier: Apache-2.0
// Area and delay of logic whose cost follows a width: the laws of docs/synthesis.md.
#pragma once

#include <string>

#include "config/config.hpp"
#include "cost/rows.hpp"

namespace degs::cost {

/// A law of two terms, which its user names.
struct Law {
    double a = 0, b = 0;
    double of(double first, double second) const { return a * first + b * second; }
    void describe(ConfigVisitor& visitor);
};

/// The laws, fitted to synthesised points. Areas are in units of the library that the points were
/// mapped to, and count by their ratio to the PE of the same library; delays are in FO4, the delay
/// of an inverter that drives four. Arguments are counts, all at least 1.
struct LogicLaws {
    bool widths = true;                 ///< false: a wider unit costs no more
    UnitRow pe{0.01375, 0.00359375, 1}; ///< what `pe_area` takes in the rows' node
    double pe_area = 851993;            ///< library units
    double fo4_per_ns = 48.36;
    int task_bits = 16, address_bits = 48;
    Law in_turn{280.8, 420.9}, serial{703.2, 465.1}, oldest{78.6, 48.3};
    Law queue{135.7, 58.9}, domains{4790.1, 1690.2};
    Law packing{93.7, 3.88};
    double packing_reach = 149.3;
    Law crossbar{42.5, 64.1}, tile_walk{29850.1, 19789.5};
    Law pipelined{772.1, 96};
    Law in_turn_fo4{14.7, 3.49}, serial_fo4{6.80, 8.26}, oldest_fo4{8.2, 7.87};
    Law queue_fo4{7.15, 5.76};
    double packing_fo4 = 11.4, by_dates_fo4 = 5.74, chosen_fo4 = 4.68, group_fo4 = 5.75;
    double pixel_loop_fo4 = 102.5, tuned_pixel_loop_fo4 = 66.1;

    void describe(ConfigVisitor& visitor);

    /// Choice of `picks` of `waiting` ready ones in turn, in a cycle. `each_date`: each pick sees
    /// the date that those before it have moved. Area without registers.
    double area_in_turn(int waiting, int picks, bool each_date) const;
    double fo4_in_turn(int waiting, int picks, bool each_date) const;
    /// A choice in turn by a pipeline, which makes it `cycles` before it is used. The area is
    /// without the registers of dates; the delay is that of its slowest cycle.
    double area_pipelined(int waiting, int picks, int cycles) const;
    double fo4_pipelined(int waiting, int picks, int cycles) const;
    /// Delay of the dates that follow from a group of picks.
    double fo4_group(int waiting, int picks) const;
    /// Choice of the `picks` oldest of `waiting`, by an age matrix.
    double area_oldest(int waiting, int picks) const;
    double fo4_oldest(int picks) const;
    /// Lists of segments with `bits` flip-flops of state.
    double area_queue(int bits, int cut, int issued) const;
    double fo4_queue(int depth, int cut) const;
    /// Dates and ended pixels of `waiting` domains.
    double area_domains(int waiting, int issued) const;
    /// A Packing Unit that takes `segments` of `length` pixels and writes `packets` of `width`
    /// tasks in a cycle.
    double area_packing(int segments, int length, int width, int packets) const;
    double fo4_packing(int segments, int length) const;
    /// A crossbar of words of `bits`.
    double area_crossbar(int senders, int receivers, int bits) const;
    /// The walk over the tiles of a splat, `pairs` in a cycle.
    double area_tile_walk(int pairs) const;

    /// PEs that take as much; none if widths cost nothing.
    double share_of(double area) const { return widths ? area / pe_area : 0; }
};

} // namespace degs::cost
