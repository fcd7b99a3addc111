// SPDX-License-Identifier: Apache-2.0
#include "cost/logic_laws.hpp"

#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"

namespace degs::cost {

void Law::describe(ConfigVisitor& visitor) {
    constexpr double kMost = 1e9;
    visitor.real("a", a, 0, kMost, "factor of the first term");
    visitor.real("b", b, 0, kMost, "factor of the second term");
}

void LogicLaws::describe(ConfigVisitor& visitor) {
    constexpr double kMost = 1e9;
    visitor.boolean("widths", widths,
                    "the area of banks, pools, clusters and binners follows their widths; false: a "
                    "wider unit costs no more, as in Table I");
    visitor.section("pe", pe, "the PE that `pe_area` is of: Table I, Blending Array / 64");
    visitor.real("pe_area", pe_area, 1, kMost,
                 "library units of a PE of `paper`, to which all "
                 "areas below are relative (synthesis)");
    visitor.real(
        "fo4_per_ns", fo4_per_ns, 1, 1e4,
        "FO4 of logic in a nanosecond, without wires and setup: 40 at 45 nm [assumed], divided by "
        "the node's delay (DeepScaleTool)");
    visitor.integer("task_bits", task_bits, 1, 256,
                    "bits of a task that the shift network moves beside its pixel [assumed]");
    visitor.integer("address_bits", address_bits, 1, 64,
                    "bits of a request that clusters send to the memory [assumed]");
    visitor.section("in_turn", in_turn, "K of N domains in turn, one date: a N + b N K");
    visitor.section("serial", serial, "the same, serial dates: a N K + b N (K - 1)");
    visitor.section("pipelined", pipelined,
                    "the same in n cycles, each a register of picks: a N K + b N K (n - 1)");
    visitor.section("oldest", oldest, "the K oldest of N: a N N + b N N K");
    visitor.section("queue", queue, "queue of F flip-flops, C cut, K issued: a F + b F (C + K)");
    visitor.section("domains", domains, "dates and ended pixels of N domains: a N + b N K");
    visitor.section("packing", packing,
                    "Packing Unit: a (L + W) B + b R B, beside packing_reach R");
    visitor.real("packing_reach", packing_reach, 0, kMost, "per pair of a pixel and its lanes, R");
    visitor.section("crossbar", crossbar, "I to O words of B bits: a (I + 1) O B + b (I + O) B");
    visitor.section("tile_walk", tile_walk, "P list entries per cycle: a + b P");
    visitor.section("in_turn_fo4", in_turn_fo4, "FO4: a + b K log2 N");
    visitor.section("serial_fo4", serial_fo4, "FO4: a log2 N + b (K - 1) log2 N");
    visitor.real("by_dates_fo4", by_dates_fo4, 0, kMost, "FO4 / log2 N K of a choice by dates");
    visitor.real("chosen_fo4", chosen_fo4, 0, kMost, "the same among registered ready domains");
    visitor.real("group_fo4", group_fo4, 0, kMost, "FO4 / log2 N K of the dates after a group");
    visitor.section("oldest_fo4", oldest_fo4, "FO4: a + b K");
    visitor.section("queue_fo4", queue_fo4, "FO4: a C + b log2 depth");
    visitor.real("packing_fo4", packing_fo4, 0, kMost, "FO4 / log2 K L of L pixels in a segment");
    visitor.real("pixel_loop_fo4", pixel_loop_fo4, 0, kMost, "FO4 of a pixel's loop in `paper`");
    visitor.real("tuned_pixel_loop_fo4", tuned_pixel_loop_fo4, 0, kMost, "the same in `tuned`");
}

double LogicLaws::area_in_turn(int waiting, int picks, bool each_date) const {
    const double n = waiting;
    return each_date ? serial.of(n * picks, n * (picks - 1)) : in_turn.of(n, n * picks);
}

double LogicLaws::fo4_in_turn(int waiting, int picks, bool each_date) const {
    const double steps = std::log2(std::max(2, waiting));
    return each_date ? serial_fo4.of(steps, (picks - 1) * steps) : in_turn_fo4.of(1, picks * steps);
}

double LogicLaws::area_pipelined(int waiting, int picks, int cycles) const {
    const double pairs = double(waiting) * picks;
    return pipelined.of(pairs, pairs * (cycles - 1));
}

double LogicLaws::fo4_group(int waiting, int picks) const {
    return group_fo4 * std::log2(std::max(2, waiting * picks));
}

double LogicLaws::fo4_pipelined(int waiting, int picks, int cycles) const {
    const double steps = std::log2(std::max(2, waiting * picks));
    const double group = fo4_group(waiting, picks);
    return cycles == 1   ? by_dates_fo4 * steps + group
           : cycles == 2 ? std::max(by_dates_fo4 * steps, group)
                         : std::max(chosen_fo4 * steps, group);
}

double LogicLaws::area_oldest(int waiting, int picks) const {
    const double pairs = double(waiting) * waiting;
    return oldest.of(pairs, pairs * picks);
}

double LogicLaws::fo4_oldest(int picks) const {
    return oldest_fo4.of(1, picks);
}

double LogicLaws::area_queue(int bits, int cut, int issued) const {
    return queue.of(bits, double(bits) * (cut + issued));
}

double LogicLaws::fo4_queue(int depth, int cut) const {
    return queue_fo4.of(cut, std::log2(std::max(2, depth)));
}

double LogicLaws::area_domains(int waiting, int issued) const {
    return domains.of(waiting, double(waiting) * issued);
}

// A lane is one of the packets that a cycle may complete or write, and of the one behind them. A
// pixel reaches the lanes that the tasks before it, and those of the open packet, may leave to it.
double LogicLaws::area_packing(int segments, int length, int width, int packets) const {
    const int complete = (width - 1 + length) / width;
    const int lanes = (std::max(complete, packets) + 1) * width;
    double reach = 0;
    for (int pixel = 0; pixel < length * segments; ++pixel) {
        reach += std::min(lanes, width + pixel);
    }
    constexpr int kPlaceBits = 5; // of a pixel in its segment, and that there is one
    const double bits = task_bits + kPlaceBits;
    return packing.of((lanes + width) * bits, reach * bits) + packing_reach * reach;
}

double LogicLaws::fo4_packing(int segments, int length) const {
    return packing_fo4 * std::log2(std::max(2, segments * length));
}

double LogicLaws::area_crossbar(int senders, int receivers, int bits) const {
    const double wires = bits;
    return crossbar.of(wires * (senders + 1) * receivers, wires * (senders + receivers));
}

double LogicLaws::area_tile_walk(int pairs) const {
    return tile_walk.of(1, pairs);
}

} // namespace degs::cost
