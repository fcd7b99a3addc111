// SPDX-License-Identifier: Apache-2.0
// Profile `interior`: a furnished room and what lies behind its walls.
#include "scene/synthetic/synthetic_place.hpp"

namespace degs {
namespace {
namespace flat {

/// Fitted to the levels of detail of a scan; see docs/regime.md.
const std::vector<PlaceLevel>& levels() {
    static const std::vector<PlaceLevel> list{{750000, 0.0237, 0.53},
                                              {1500000, 0.0200, 0.83},
                                              {3000000, 0.0159, 1.0},
                                              {12000000, 0.0074, 1.05, 1.2}};
    return list;
}

/// Ellipses of the scan are higher than wide: half of them have more than 8.7, 12.4 and 13.1 rows
/// in the three views, and rows of 6.6, 8.4 and 8.7 px (960x720).
const PlaceShapes& shapes() {
    using Axis = MeasuredDistribution::Axis;
    static const PlaceShapes found{{Axis::Logarithmic, {0.15, 0.49, 1, 2.1, 3.8, 6.9}},
                                   {Axis::Logarithmic, {1, 1.44, 3.0, 7.6, 15, 40}},
                                   0.9};
    return found;
}

const Material kOak{{0.62, 0.43, 0.26}, {0.38, 0.24, 0.13}, Pattern::Boards};
const Material kPlaster{{0.86, 0.83, 0.76}, {0.78, 0.74, 0.66}, Pattern::Plain, 1.05};
const Material kCeiling{{0.93, 0.92, 0.90}, {0.86, 0.85, 0.83}, Pattern::Plain, 1.1};
const Material kSofa{{0.20, 0.36, 0.50}, {0.13, 0.25, 0.37}, Pattern::Plain, 0.9};
const Material kCushion{{0.86, 0.52, 0.16}, {0.72, 0.38, 0.10}, Pattern::Plain, 0.8};
const Material kRug{{0.62, 0.16, 0.14}, {0.88, 0.76, 0.56}, Pattern::Picture, 0.8};
const Material kWood{{0.46, 0.28, 0.15}, {0.30, 0.17, 0.08}, Pattern::Plain, 0.7};
const Material kPane{{0.95, 1.00, 1.08}, {0.98, 0.97, 0.95}, Pattern::Pane, 1.0};
const Material kBooks{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, Pattern::Books, 0.6};
const Material kDoor{{0.55, 0.36, 0.20}, {0.40, 0.25, 0.13}, Pattern::Plain, 0.9};
const Material kShade{{1.05, 0.95, 0.70}, {1.0, 0.88, 0.6}, Pattern::Plain, 0.7};
const Material kLeaves{{0.12, 0.30, 0.12}, {0.42, 0.62, 0.28}, Pattern::Leaves, 0.8, 1, 1, 0.9};
const Material kPot{{0.70, 0.36, 0.22}, {0.55, 0.28, 0.16}, Pattern::Plain, 0.7};
const Material kCanvas{{0.16, 0.34, 0.52}, {0.92, 0.72, 0.35}, Pattern::Picture, 0.6};
const Material kWhite{{0.95, 0.95, 0.93}, {0.88, 0.88, 0.86}, Pattern::Plain, 0.6};

constexpr double kHigh = -2.6; ///< y of the ceiling; the floor has 0 and y points down

void add_shell(SyntheticPlace& place) {
    constexpr double kX = 2.6, kZ = 2.9;
    place.sheet({-kX, 0, -kZ}, {2 * kX, 0, 0}, {0, 0, 2 * kZ}, kOak);
    place.sheet({-kX, kHigh, -kZ}, {0, 0, 2 * kZ}, {2 * kX, 0, 0}, kCeiling);
    place.sheet({-kX, kHigh, kZ}, {0, -kHigh, 0}, {2 * kX, 0, 0}, kPlaster);
    place.sheet({-kX, kHigh, -kZ}, {2 * kX, 0, 0}, {0, -kHigh, 0}, kPlaster);
    place.sheet({-kX, kHigh, -kZ}, {0, -kHigh, 0}, {0, 0, 2 * kZ}, kPlaster);
    place.sheet({kX, kHigh, -kZ}, {0, 0, 2 * kZ}, {0, -kHigh, 0}, kPlaster);
    // Skirting, a window in the right wall with its sill, and a door in the one opposite.
    place.box({-kX, -0.1, kZ - 0.02}, {kX, 0, kZ}, kWhite);
    place.box({kX - 0.02, -0.1, -kZ}, {kX, 0, kZ}, kWhite);
    place.sheet({kX - 0.03, -2.25, -0.4}, {0, 0, 1.83}, {0, 1.43, 0}, kPane, 2);
    place.box({kX - 0.2, -0.82, -0.5}, {kX, -0.77, 1.55}, kWhite);
    place.sheet({1.45, -2.1, kZ - 0.03}, {0, 2.1, 0}, {0.9, 0, 0}, kDoor, 2);
    place.ball({1.55, -1.0, kZ - 0.07}, {0.04, 0.04, 0.04}, kShade);
}

void add_furniture(SyntheticPlace& place) {
    // The sofa stands at the far wall, with cushions on it.
    place.box({-1.5, -0.42, 1.95}, {0.9, -0.06, 2.75}, kSofa);
    place.box({-1.5, -0.95, 2.55}, {0.9, -0.35, 2.85}, kSofa);
    place.box({-1.72, -0.65, 1.95}, {-1.48, -0.04, 2.8}, kSofa);
    place.box({0.88, -0.65, 1.95}, {1.12, -0.04, 2.8}, kSofa);
    place.ball({-1.15, -0.6, 2.42}, {0.24, 0.22, 0.12}, kCushion);
    place.ball({0.55, -0.6, 2.42}, {0.24, 0.22, 0.12}, kCushion);
    // A rug, a low table with a bowl and a book.
    place.sheet({-1.5, -0.015, 0.1}, {2.5, 0, 0}, {0, 0, 1.6}, kRug, 1.5);
    place.box({-0.95, -0.44, 0.5}, {0.45, -0.38, 1.25}, kWood, 1.5);
    for (const double x : {-0.9, 0.34}) {
        for (const double z : {0.54, 1.15}) {
            place.box({x, -0.38, z}, {x + 0.06, 0, z + 0.06}, kWood);
        }
    }
    place.ball({-0.5, -0.5, 0.9}, {0.17, 0.09, 0.17}, kWhite);
    place.box({0.0, -0.48, 0.75}, {0.25, -0.44, 1.05}, kCushion);
    // Books at the left wall, a picture above the sofa, a lamp and a plant in the corners.
    place.box({-2.6, -2.1, 0.2}, {-2.3, 0, 2.0}, kWood);
    place.sheet({-2.28, -2.02, 0.26}, {0, 0, 1.68}, {0, 1.92, 0}, kBooks, 2.5);
    place.box({-0.95, -2.05, 2.84}, {0.35, -1.2, 2.88}, kWood);
    place.sheet({-0.88, -1.98, 2.82}, {0, 0.71, 0}, {1.16, 0, 0}, kCanvas, 2);
    place.box({-2.02, -1.5, 2.45}, {-1.98, 0, 2.49}, kWood);
    place.ball({-2.0, -1.6, 2.47}, {0.23, 0.2, 0.23}, kShade);
    place.ball({2.15, -0.25, 2.35}, {0.2, 0.25, 0.2}, kPot);
    place.ball({2.15, -1.0, 2.3}, {0.4, 0.55, 0.4}, kLeaves);
    // An armchair by the window.
    place.box({1.35, -0.42, 0.3}, {2.1, -0.05, 1.05}, kCushion);
    place.box({1.95, -0.95, 0.25}, {2.2, -0.05, 1.1}, kCushion);
    place.box({1.35, -0.62, 0.2}, {2.15, -0.05, 0.34}, kCushion);
    place.box({1.35, -0.62, 1.0}, {2.15, -0.05, 1.14}, kCushion);
}

/// What lies behind the walls: seen by no pixel, and listed by the tiles.
void add_neighbours(SyntheticPlace& place) {
    place.sheet({-2.6, 0, 3.1}, {5.2, 0, 0}, {0, 0, 1.4}, kOak);
    place.sheet({-2.6, kHigh, 4.5}, {0, -kHigh, 0}, {5.2, 0, 0}, kPlaster, 0.6);
    place.box({-1.2, -0.8, 3.4}, {1.0, 0, 4.2}, kWood, 0.8);
    place.box({-7.5, kHigh, -3}, {-2.8, 0, 0}, kPlaster, 2.6);
    place.box({-2.6, kHigh, -6.5}, {2.6, 0, -3.1}, kPlaster, 2.6);
}

} // namespace flat
} // namespace

void make_interior(const SyntheticSpec& spec, SyntheticScene& scene) {
    scene.cameras = place_cameras({{{{1.9, -1.75, -2.3}, {-0.5, -0.85, 1.6}, 0.75},
                                    {{-1.5, -1.45, -1.7}, {0.2, -0.8, 2.4}, 0.85},
                                    {{0.8, -1.4, -1.9}, {-0.6, -0.75, 2.2}, 0.8}}});
    SyntheticPlace place(spec, flat::levels(), flat::shapes());
    flat::add_shell(place);
    flat::add_furniture(place);
    flat::add_neighbours(place);
    place.fill(scene.cloud, scene.cameras, 12);
}

} // namespace degs
