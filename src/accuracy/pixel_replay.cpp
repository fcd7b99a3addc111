// SPDX-License-Identifier: Apache-2.0
#include "accuracy/pixel_replay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "splat/frame/pixel_rules.hpp"

namespace degs {
namespace {

/// The list of the tile that holds a pixel.
struct TileList {
    const std::uint32_t* first;
    std::size_t length;
    int x_begin, x_end; ///< columns of the tile

    TileList(const FrameWorkload& work, int x, int y) {
        const TileGrid grid = work.grid();
        const int tile = grid.tile_of_pixel(x, y);
        first = work.tile_splats.data() + work.tile_begin[tile];
        length = work.tile_begin[tile + 1] - work.tile_begin[tile];
        x_begin = grid.pixels_of(tile).x0;
        x_end = grid.pixels_of(tile).x1 + 1;
    }
};

PixelReplay blank(const TileList& list) {
    PixelReplay replay;
    replay.alpha.assign(list.length, 0.0);
    replay.weight.assign(list.length, 0.0);
    replay.ended = list.length;
    return replay;
}

double reference_alpha(const FrameWorkload& work, const ProjectedSplat& s, int x, int y) {
    const double dy = y - s.mu_y;
    const double u = x - s.mu_x - s.cov_b / s.cov_c * dy;
    const double q = s.conic_a() * u * u + dy * dy / s.cov_c;
    const double alpha = std::min(kAlphaMax, s.opacity * std::exp(-0.5 * q));
    const bool cut = s.q_cut_off > 0 && q > s.q_end();
    return cut || alpha < work.projection.alpha_min ? 0 : alpha;
}

/// Blends alphas in double by the reference's rules; fills in all but `alpha`.
void blend_exactly(const FrameWorkload& work, const TileList& list, PixelReplay& replay) {
    for (std::size_t i = 0; i < list.length; ++i) {
        const double next = replay.transmittance * (1 - replay.alpha[i]);
        if (next < kStopTransmittance) {
            replay.ended = i;
            return;
        }
        replay.weight[i] = replay.alpha[i] * replay.transmittance;
        for (int c = 0; c < 3; ++c) {
            replay.rgb[c] += replay.weight[i] * work.splats[list.first[i]].colour[c];
        }
        replay.transmittance = next;
    }
}

/// Everything exact but for the order of operations.
NumberSet unrounded(NumberSet set) {
    const NumberSet ideal = number_set("ideal");
    for (NumberFormat NumberSet::*stage : {&NumberSet::mean,
                                           &NumberSet::slope,
                                           &NumberSet::c_prime,
                                           &NumberSet::radius,
                                           &NumberSet::inverse_radius2,
                                           &NumberSet::conic,
                                           &NumberSet::q_threshold,
                                           &NumberSet::colour,
                                           &NumberSet::distance,
                                           &NumberSet::square,
                                           &NumberSet::ratio,
                                           &NumberSet::edge,
                                           &NumberSet::level,
                                           &NumberSet::g0,
                                           &NumberSet::d0,
                                           &NumberSet::term,
                                           &NumberSet::q,
                                           &NumberSet::alpha,
                                           &NumberSet::transmittance,
                                           &NumberSet::weight,
                                           &NumberSet::sum}) {
        set.*stage = ideal.*stage;
    }
    for (TableSpec NumberSet::*table : {&NumberSet::sqrt, &NumberSet::exp}) {
        (set.*table).interpolation = Interpolation::Exact;
        (set.*table).values = (set.*table).argument = ideal.sqrt.values;
    }
    set.derivation = Derivation::Reference;
    set.ends = SpanEnds::Exact;
    set.q_mask = false;
    return set;
}

/// An operation, and how to round it alone.
struct Operation {
    const char* name;
    void (*take)(const NumberSet& from, NumberSet& to);
};

template <NumberFormat NumberSet::*stage>
void take(const NumberSet& from, NumberSet& to) {
    to.*stage = from.*stage;
}

/// Slope's part that depends on the unit of the mean is left out: the mean is exact here.
void take_ends(const NumberSet& from, NumberSet& to) {
    to.ends = from.ends == SpanEnds::Exact ? SpanEnds::Exact : SpanEnds::Outward;
    to.delta = from.delta;
}

constexpr std::array<Operation, 25> kOperations{{
    {"mean", &take<&NumberSet::mean>},
    {"m", &take<&NumberSet::slope>},
    {"C'", &take<&NumberSet::c_prime>},
    {"r_x", &take<&NumberSet::radius>},
    {"1/r_y^2", &take<&NumberSet::inverse_radius2>},
    {"A", &take<&NumberSet::conic>},
    {"Q_th", &take<&NumberSet::q_threshold>},
    {"colour", &take<&NumberSet::colour>},
    {"dy", &take<&NumberSet::distance>},
    {"products", &take<&NumberSet::square>},
    {"x", &take<&NumberSet::ratio>},
    {"x_c and w", &take<&NumberSet::edge>},
    {"level", &take<&NumberSet::level>},
    {"g0", &take<&NumberSet::g0>},
    {"d0", &take<&NumberSet::d0>},
    {"n d0 and A n(n-1)", &take<&NumberSet::term>},
    {"q", &take<&NumberSet::q>},
    {"alpha", &take<&NumberSet::alpha>},
    {"transmittance", &take<&NumberSet::transmittance>},
    {"weight", &take<&NumberSet::weight>},
    {"sum", &take<&NumberSet::sum>},
    {"sqrt", [](const NumberSet& from, NumberSet& to) { to.sqrt = from.sqrt; }},
    {"exp", [](const NumberSet& from, NumberSet& to) { to.exp = from.exp; }},
    {"span ends", &take_ends},
    {"derivation",
     [](const NumberSet& from, NumberSet& to) {
         to.derivation = from.derivation;
         to.conic = from.conic;
         to.slope = from.slope;
         to.c_prime = from.c_prime;
         to.radius = from.radius;
         to.inverse_radius2 = from.inverse_radius2;
     }},
}};

/// The list entry whose alpha, taken from `test` alone, moves the reference's pixel most.
std::size_t culprit(const FrameWorkload& work, const TileList& list, const PixelReplay& reference,
                    const PixelReplay& test) {
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t i = 0; i < list.length; ++i) {
        // Behind the end only one that did not end the pixel can matter.
        if (test.alpha[i] == reference.alpha[i] || i > reference.ended) {
            continue;
        }
        PixelReplay changed = blank(list);
        changed.alpha = reference.alpha;
        changed.alpha[i] = test.alpha[i];
        blend_exactly(work, list, changed);
        const double moved = pixel_distance(changed, reference);
        if (moved > most) {
            most = moved;
            worst = i;
        }
    }
    return most < 0 && reference.ended < list.length ? reference.ended : worst;
}

std::string flipped_decision(const PixelReplay& reference, const PixelReplay& test,
                             std::size_t entry) {
    if ((reference.alpha[entry] > 0) != (test.alpha[entry] > 0)) {
        return "span ends";
    }
    return reference.ended != test.ended ? "stop rule" : "";
}

} // namespace

double pixel_distance(const PixelReplay& a, const PixelReplay& b) {
    double most = 0;
    for (const double each :
         {std::abs(a.rgb[0] - b.rgb[0]), std::abs(a.rgb[1] - b.rgb[1]),
          std::abs(a.rgb[2] - b.rgb[2]), std::abs(a.transmittance - b.transmittance)}) {
        most = std::isfinite(each) ? std::max(most, each) : INFINITY;
    }
    return most;
}

PixelReplay replay_reference(const FrameWorkload& workload, int x, int y) {
    const TileList list(workload, x, y);
    PixelReplay replay = blank(list);
    for (std::size_t i = 0; i < list.length; ++i) {
        replay.alpha[i] = reference_alpha(workload, workload.splats[list.first[i]], x, y);
    }
    blend_exactly(workload, list, replay);
    return replay;
}

PixelReplay replay_row(const FrameWorkload& workload, int x, int y, const QuantizedRow& row,
                       StopRule stop) {
    const TileList list(workload, x, y);
    PixelReplay replay = blank(list);
    QuantizedPixel pixel;
    for (std::size_t i = 0; i < list.length; ++i) {
        const QuantizedSplat splat = row.record(workload.splats[list.first[i]]);
        const QuantizedSpan span = row.solve(splat, y, list.x_begin, list.x_end);
        if (x < span.x0 || x > span.x1) {
            continue;
        }
        replay.alpha[i] = row.alpha(splat, row.q(splat.a, span.g0, span.d0, x - span.base));
        QuantizedPixel next = pixel;
        row.blend(replay.alpha[i], splat.colour, next);
        const bool ends = next.transmittance < kStopTransmittance && replay.ended == list.length;
        if (replay.ended < list.length || (ends && stop == StopRule::Refuse)) {
            replay.ended = std::min(replay.ended, i);
            continue; // the alphas of the rest are worth knowing
        }
        replay.weight[i] = replay.alpha[i] * pixel.transmittance;
        pixel = next;
        if (ends) {
            replay.ended = i;
        }
    }
    std::copy(pixel.rgb, pixel.rgb + 3, replay.rgb);
    replay.transmittance = pixel.transmittance;
    return replay;
}

PixelBlame blame_pixel(const FrameWorkload& workload, int x, int y, const NumberSet& set,
                       StopRule stop) {
    const TileList list(workload, x, y);
    const PixelReplay reference = replay_reference(workload, x, y);
    const PixelReplay test = replay_row(workload, x, y, QuantizedRow(set), stop);
    PixelBlame blame;
    blame.error = pixel_distance(reference, test);
    if (list.length == 0 || blame.error == 0) {
        return blame;
    }
    const std::size_t entry = culprit(workload, list, reference, test);
    blame.id = workload.splats[list.first[entry]].id;
    blame.flip = flipped_decision(reference, test, entry);
    const NumberSet exact = unrounded(set);
    for (const Operation& operation : kOperations) {
        NumberSet alone = exact;
        NumberSet without = set;
        operation.take(set, alone);
        operation.take(exact, without);
        const auto error_of = [&](const NumberSet& numbers) {
            return pixel_distance(reference,
                                  replay_row(workload, x, y, QuantizedRow(numbers), stop));
        };
        const double share = std::max(error_of(alone), blame.error - error_of(without));
        if (share > blame.explained) {
            blame.explained = share;
            blame.operation = operation.name;
        }
    }
    return blame;
}

} // namespace degs
