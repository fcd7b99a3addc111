// SPDX-License-Identifier: Apache-2.0
// Profile `garden`: a courtyard with a lawn, beds, trees and the houses around it.
#include "scene/synthetic/synthetic_place.hpp"

namespace degs {
namespace {
namespace courtyard {

/// Fitted to the levels of detail of a scan; see docs/regime.md.
const std::vector<PlaceLevel>& levels() {
    static const std::vector<PlaceLevel> list{
        {750000, 0.027, 0.4}, {3380000, 0.0136, 0.54}, {13560000, 0.0068, 0.75}};
    return list;
}

/// Areas are less equal than those of a flat, and ellipses fill a smaller part of their squares.
const PlaceShapes& shapes() {
    using Axis = MeasuredDistribution::Axis;
    static const PlaceShapes found{{Axis::Logarithmic, {0.12, 0.45, 1, 2.54, 5.5, 11.7}},
                                   {Axis::Logarithmic, {1, 1.6, 4.1, 13, 31, 110}},
                                   0};
    return found;
}

const Material kLawn{
    {0.26, 0.42, 0.13}, {0.52, 0.62, 0.26}, Pattern::Leaves, 0.8, 1, 1.5, 0.05, 1.5};
const Material kStone{
    {0.72, 0.67, 0.58}, {0.45, 0.41, 0.35}, Pattern::Tiles, 0.9, 1, 0.7, 0.01, 1.5};
const Material kWall{
    {0.88, 0.78, 0.60}, {0.74, 0.62, 0.45}, Pattern::Plain, 1.05, 1, 0.5, 0.01, 1.5};
const Material kBrick{
    {0.64, 0.34, 0.25}, {0.80, 0.72, 0.64}, Pattern::Tiles, 0.9, 1, 0.6, 0.01, 1.5};
const Material kGlass{{0.20, 0.28, 0.36}, {0.95, 0.95, 0.92}, Pattern::Pane, 0.9};
const Material kDoor{{0.16, 0.36, 0.28}, {0.10, 0.25, 0.19}, Pattern::Plain, 0.8};
const Material kLeaves{
    {0.13, 0.27, 0.09}, {0.48, 0.66, 0.24}, Pattern::Leaves, 0.9, 0.95, 1.5, 0.9, 1.5};
const Material kBlossom{
    {0.62, 0.16, 0.30}, {1.0, 0.62, 0.72}, Pattern::Leaves, 0.8, 0.95, 1.5, 0.9, 1.5};
const Material kIvy{
    {0.10, 0.25, 0.10}, {0.36, 0.52, 0.20}, Pattern::Leaves, 0.9, 1, 1.5, 0.12, 1.5};
const Material kBark{
    {0.34, 0.25, 0.18}, {0.22, 0.16, 0.11}, Pattern::Plain, 0.8, 1, 0.15, 0.01, 1.5};
const Material kWood{{0.58, 0.40, 0.24}, {0.42, 0.27, 0.15}, Pattern::Boards, 0.7};
const Material kPot{{0.74, 0.38, 0.24}, {0.58, 0.28, 0.17}, Pattern::Plain, 0.7};
const Material kWater{{0.20, 0.38, 0.44}, {0.62, 0.76, 0.80}, Pattern::Plain, 0.9};

constexpr double kSide = 5; ///< half of the courtyard

void add_ground(SyntheticPlace& place) {
    place.sheet({-kSide, 0, -kSide}, {2 * kSide, 0, 0}, {0, 0, 2 * kSide}, kStone, 0.8);
    place.sheet({-3.8, -0.04, -3.0}, {3.0, 0, 0}, {0, 0, 6.5}, kLawn, 1.3);
    place.sheet({0.8, -0.04, -3.0}, {3.0, 0, 0}, {0, 0, 6.5}, kLawn, 1.3);
    // A round basin stands in the middle of the path.
    place.ball({0, -0.1, 0.6}, {0.75, 0.32, 0.75}, kStone, 1.3);
    place.ball({0, -0.36, 0.6}, {0.6, 0.05, 0.6}, kWater, 1.3);
    place.box({-0.08, -1.0, 0.52}, {0.08, -0.3, 0.68}, kStone);
    place.ball({0, -1.05, 0.6}, {0.3, 0.08, 0.3}, kStone);
}

void add_house(SyntheticPlace& place) {
    constexpr double kHigh = 5.5;
    place.sheet({-kSide, -kHigh, kSide}, {0, kHigh, 0}, {2 * kSide, 0, 0}, kWall);
    for (int floor = 0; floor < 2; ++floor) {
        for (int n = -2; n <= 2; ++n) {
            if (floor == 0 && n == 0) {
                continue;
            }
            const double x = 1.9 * n - 0.45;
            const double y = floor == 0 ? -2.2 : -4.6;
            place.sheet({x, y, kSide - 0.06}, {0, 1.4, 0}, {0.95, 0, 0}, kGlass, 1.5);
            place.box({x - 0.08, y + 1.42, kSide - 0.2}, {x + 1.03, y + 1.5, kSide}, kStone);
        }
    }
    place.sheet({-0.55, -2.3, kSide - 0.06}, {0, 2.3, 0}, {1.1, 0, 0}, kDoor, 1.5);
    place.box({-0.8, -0.14, kSide - 0.6}, {0.8, 0, kSide}, kStone);
}

// Garden walls of brick stand at both sides and behind, with ivy over them.
void add_walls(SyntheticPlace& place) {
    place.sheet({-kSide, -3.4, -kSide}, {0, 3.4, 0}, {0, 0, 2 * kSide}, kBrick);
    place.sheet({kSide, -3.4, -kSide}, {0, 0, 2 * kSide}, {0, 3.4, 0}, kBrick);
    place.sheet({-kSide, -1.3, -kSide}, {2 * kSide, 0, 0}, {0, 1.3, 0}, kBrick);
    place.sheet({-kSide + 0.12, -3.3, -1}, {0, 2.4, 0}, {0, 0, 4.5}, kIvy);
    place.sheet({kSide - 0.12, -3.3, -3}, {0, 0, 4.0}, {0, 2.6, 0}, kIvy);
}

void add_houses_beyond(SyntheticPlace& place) {
    place.sheet({-8, -9, -6}, {0, 9, 0}, {0, 0, 12}, kWall, 0.4);
    place.sheet({8, -9, -6}, {0, 0, 12}, {0, 9, 0}, kWall, 0.4);
    place.sheet({-9, -11, 8}, {0, 11, 0}, {18, 0, 0}, kBrick, 0.3);
    place.box({-7, -6, -16}, {7, 0, -10}, kBrick, 0.85);
}

void add_low_wall(SyntheticPlace& place) {
    place.sheet({-kSide, -1.3, kSide}, {0, 1.3, 0}, {2 * kSide, 0, 0}, kBrick);
}

void add_tree(SyntheticPlace& place, double x, double z, double high, const Material& crown) {
    place.box({x - 0.11, -0.55 * high, z - 0.11}, {x + 0.11, 0, z + 0.11}, kBark);
    place.ball({x, -0.72 * high, z}, {0.28 * high, 0.25 * high, 0.28 * high}, crown);
    place.ball({x + 0.16 * high, -0.6 * high, z + 0.2}, {0.19 * high, 0.15 * high, 0.19 * high},
               crown);
    place.ball({x - 0.17 * high, -0.62 * high, z - 0.1}, {0.19 * high, 0.15 * high, 0.17 * high},
               crown);
}

void add_plants(SyntheticPlace& place) {
    add_tree(place, -2.9, 2.4, 3.9, kLeaves);
    add_tree(place, 2.9, 2.9, 3.4, kBlossom);
    add_tree(place, 3.3, -1.9, 2.7, kLeaves);
    for (int n = 0; n < 7; ++n) {
        const double z = -3.6 + 1.15 * n;
        const double radius = 0.34 + 0.05 * (n % 3);
        place.ball({-4.45, -0.4, z}, {radius, 0.42, radius + 0.1}, n % 3 == 1 ? kBlossom : kLeaves);
        place.ball({4.45, -0.4, z}, {radius, 0.42, radius + 0.1}, n % 3 == 2 ? kBlossom : kLeaves);
    }
    for (const double x : {-1.35, 1.35}) {
        place.ball({x, -0.28, 4.4}, {0.26, 0.3, 0.26}, kPot);
        place.ball({x, -0.85, 4.4}, {0.36, 0.42, 0.36}, kLeaves);
    }
    // A table with two benches stands on the right lawn.
    place.box({1.4, -0.76, -0.6}, {2.6, -0.7, 0.5}, kWood, 1.5);
    place.box({1.95, -0.7, -0.1}, {2.05, 0, 0.0}, kWood);
    place.box({1.4, -0.45, -1.2}, {2.6, -0.4, -0.85}, kWood, 1.5);
    place.box({1.4, -0.45, 0.8}, {2.6, -0.4, 1.15}, kWood, 1.5);
}

} // namespace courtyard
} // namespace

void make_garden(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cameras = place_cameras({{{{3.9, -5.2, -7.6}, {-0.2, -1.0, 1.6}, 0.8},
                                    {{-1.7, -1.9, -3.9}, {0.5, -1.1, 2.5}, 1.08},
                                    {{2.2, -2.3, -4.7}, {-0.6, -1.1, 2.0}, 0.8}}});
    SyntheticPlace place(spec, courtyard::levels(), courtyard::shapes());
    courtyard::add_ground(place);
    // With a sky the garden is open: a low wall stands where the house is, and nothing beyond it.
    const bool is_open = spec.sky > 0;
    if (is_open) {
        courtyard::add_low_wall(place);
    } else {
        courtyard::add_house(place);
    }
    courtyard::add_walls(place);
    if (!is_open) {
        courtyard::add_houses_beyond(place);
    }
    courtyard::add_plants(place);
    place.fill(scene.cloud, scene.cameras, 25);
}

} // namespace degs
