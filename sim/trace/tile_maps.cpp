// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/tile_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "config/ratio.hpp"
#include "scene/image_io.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/text/terminal.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Measured {
    const char* name;
    const char* title;
    double (*value)(const TileRecord& tile);
};

Cycle busy_time(const TileRecord& tile) {
    return tile.activity.window.cycles();
}

constexpr Measured kMeasured[] = {
    {"list_length", "Splats in the list of a tile",
     [](const TileRecord& t) { return ratio_of(t.splats, 1); }},
    {"fragments", "Useful fragments of a tile",
     [](const TileRecord& t) { return ratio_of(t.activity.slots.useful, 1); }},
    {"cycles", "Cycles from the first task of a tile to its last",
     [](const TileRecord& t) { return ratio_of(busy_time(t), 1); }},
    {"residence", "Cycles from the first task of a tile until its pixels are read out",
     [](const TileRecord& t) {
         const ActiveWindow& window = t.activity.window;
         return window.empty() || t.activity.read_out < window.first
                    ? 0.0
                    : ratio_of(t.activity.read_out - window.first, 1);
     }},
    {"useful_share", "Useful share of the PE-cycles that a tile took",
     [](const TileRecord& t) {
         const std::uint64_t total = t.activity.slots.total();
         return total == 0 ? 0.0 : ratio_of(t.activity.slots.useful, total);
     }},
};

std::string slot_name(std::size_t slot) {
    return std::string("slots_") + kSlotClasses[slot].name;
}

/// Dark is little, light is much; brightness rises all the way, whatever colours a person sees.
std::array<double, 3> heat(double share) {
    constexpr std::array<std::array<double, 3>, 6> kStops{{{0.13, 0.03, 0.25},
                                                           {0.35, 0.10, 0.45},
                                                           {0.65, 0.20, 0.40},
                                                           {0.90, 0.40, 0.25},
                                                           {0.98, 0.70, 0.25},
                                                           {0.99, 0.98, 0.75}}};
    const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
    const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), 4);
    std::array<double, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double to = place - std::floor(place == 5.0 ? 4.0 : place);
        colour[c] = kStops[below][c] + (kStops[below + 1][c] - kStops[below][c]) * to;
    }
    return colour;
}

std::string hex(const std::array<double, 3>& colour) {
    char text[8];
    std::snprintf(text, sizeof text, "#%02x%02x%02x", static_cast<unsigned>(colour[0] * 255 + 0.5),
                  static_cast<unsigned>(colour[1] * 255 + 0.5),
                  static_cast<unsigned>(colour[2] * 255 + 0.5));
    return text;
}

double largest_of(const TileMap& map) {
    double largest = 0;
    for (const float value : map.values) {
        largest = value > largest ? value : largest; // NaN is not
    }
    return largest;
}

std::string words_of(const TileMap& map, double value) {
    return map.name == "useful_share" ? percent(value) + " %" : scaled(value);
}

void draw_scale(Svg& svg, double y, const TileMap& map, double largest) {
    constexpr int kColours = 100;
    constexpr double kLeft = kPlotMargin, kWidth = 400;
    for (int i = 0; i < kColours; ++i) {
        svg.rectangle(kLeft + i * kWidth / kColours, y, kWidth / kColours + 0.5, 14,
                      hex(heat((i + 0.5) / kColours)));
    }
    for (int tick = 0; tick <= 4; ++tick) {
        svg.text(kLeft + tick * kWidth / 4, y + 30, words_of(map, largest * tick / 4),
                 {kSmallText, kGrey, tick == 0 ? "start" : "middle", false});
    }
    svg.rectangle(kLeft + kWidth + 60, y, 14, 14, kGrid);
    svg.text(kLeft + kWidth + 82, y + 12, "lists no splat", {kSmallText, kGrey, "start", false});
}

} // namespace

TileMaps tile_maps_of(const RunResult& result) {
    TileMaps maps;
    maps.tile_size = result.workload.tile_size;
    maps.tiles_x = (result.camera.width + maps.tile_size - 1) / maps.tile_size;
    maps.tiles_y = (result.camera.height + maps.tile_size - 1) / maps.tile_size;
    const std::size_t tiles = std::size_t{1} * maps.tiles_x * maps.tiles_y;
    const auto add = [&](const std::string& name, const std::string& title, const auto& value) {
        TileMap map{name, title, std::vector<float>(tiles, static_cast<float>(kNone))};
        for (const TileRecord& tile : result.accelerator.tile_records) {
            if (tile.frame == 0) {
                const int place = tile.y / maps.tile_size * maps.tiles_x + tile.x / maps.tile_size;
                map.values[place] = static_cast<float>(value(tile));
            }
        }
        maps.maps.push_back(std::move(map));
    };
    for (const Measured& measured : kMeasured) {
        add(measured.name, measured.title, measured.value);
    }
    for (std::size_t s = 0; s < kSlotClasses.size(); ++s) {
        add(slot_name(s), std::string("PE-cycles of a tile: ") + kSlotClasses[s].name,
            [s](const TileRecord& t) {
                return ratio_of(t.activity.slots.*kSlotClasses[s].slots, 1);
            });
    }
    return maps;
}

std::string map_svg(const TileMaps& maps, const TileMap& map, const std::string& subtitle) {
    const double side = (kPlotWidth - 2 * kPlotMargin) / maps.tiles_x;
    constexpr double kTop = 64;
    const double largest = largest_of(map);
    Svg svg;
    svg.text(kPlotMargin, 28, map.title, {16, kInk, "start", true});
    svg.text(kPlotMargin, 48, subtitle, {kSmallText, kGrey, "start", false});
    for (int row = 0; row < maps.tiles_y; ++row) {
        for (int column = 0; column < maps.tiles_x; ++column) {
            const double value = map.values[row * maps.tiles_x + column];
            svg.rectangle(kPlotMargin + column * side, kTop + row * side, side + 0.3, side + 0.3,
                          std::isnan(value) ? kGrid : hex(heat(largest > 0 ? value / largest : 0)));
        }
    }
    const double bottom = kTop + maps.tiles_y * side + 16;
    draw_scale(svg, bottom, map, largest);
    return svg.document(kPlotWidth, bottom + 44, map.title);
}

// The image in grey below the colours, so that both can be seen.
Image map_over(const TileMaps& maps, const TileMap& map, const Image& image) {
    constexpr double kHeat = 0.65;
    const double largest = largest_of(map);
    Image over = image;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double value = map.values[y / maps.tile_size * maps.tiles_x + x / maps.tile_size];
            const std::size_t pixel = 3 * image.at(x, y);
            const double grey = std::clamp(
                (image.rgb[pixel] + image.rgb[pixel + 1] + image.rgb[pixel + 2]) / 3.0, 0.0, 1.0);
            const std::array<double, 3> colour = std::isnan(value)
                                                     ? std::array<double, 3>{grey, grey, grey}
                                                     : heat(largest > 0 ? value / largest : 0);
            for (std::size_t c = 0; c < 3; ++c) {
                over.rgb[pixel + c] = static_cast<float>((1 - kHeat) * grey + kHeat * colour[c]);
            }
        }
    }
    return over;
}

std::vector<std::string> tile_map_files() {
    std::vector<std::string> files{"tiles.exr"};
    const auto add = [&files](const std::string& name) {
        files.push_back(name + ".svg");
        files.push_back(name + "_over_image.png");
    };
    for (const Measured& measured : kMeasured) {
        add(measured.name);
    }
    for (std::size_t s = 0; s < kSlotClasses.size(); ++s) {
        add(slot_name(s));
    }
    return files;
}

void write_tile_maps(const RunResult& result, const OutputFolder& out) {
    const TileMaps maps = tile_maps_of(result);
    const AcceleratorResult& run = result.accelerator;
    const std::string subtitle = run.name + " · " + result.scene.name + " · " +
                                 size_words(result.camera) + " · tiles of " +
                                 std::to_string(maps.tile_size) + " px";
    std::vector<ExrLayer> layers;
    for (const TileMap& map : maps.maps) {
        out.write_text(map.name + ".svg", map_svg(maps, map, subtitle));
        write_png(map_over(maps, map, run.images.front()), out.path(map.name + "_over_image.png"));
        layers.push_back({map.name, map.values.data()});
    }
    write_exr(layers, maps.tiles_x, maps.tiles_y, out.path("tiles.exr"));
}

} // namespace degs::sim
