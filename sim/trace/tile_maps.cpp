// SPDX-License-Identifier: Apache-2.0
#include "sim/trace/tile_maps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include "base/ratio.hpp"
#include "scene/files/image_io.hpp"
#include "sim/plot/raster.hpp"
#include "sim/report/terminal.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr const char* kLayers = "tiles.exr";
constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

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
     [](const TileRecord& t) { return real_of(t.splats); }},
    {"fragments", "Useful fragments of a tile",
     [](const TileRecord& t) { return real_of(t.activity.slots[Slot::Useful]); }},
    {"cycles", "Cycles from the first task of a tile to its last",
     [](const TileRecord& t) { return real_of(busy_time(t)); }},
    {"residence", "Cycles from the first task of a tile until its pixels are read out",
     [](const TileRecord& t) {
         const ActiveWindow& window = t.activity.window;
         return window.empty() || t.activity.read_out < window.first
                    ? 0.0
                    : real_of(t.activity.read_out - window.first);
     }},
    {"useful_share", "Useful share of the PE-cycles that a tile took",
     [](const TileRecord& t) {
         const std::uint64_t total = t.activity.slots.total();
         return total == 0 ? 0.0 : ratio_of(t.activity.slots[Slot::Useful], total);
     }},
};

std::string slot_name(std::size_t slot) {
    return std::string("slots_") + kSlotClasses[slot].name;
}

/// Dark is little, light is much; brightness rises all the way, whatever colours a person sees.
Colour heat(double share) {
    constexpr std::array<Colour, 6> kStops{{{0.13, 0.03, 0.25},
                                            {0.35, 0.10, 0.45},
                                            {0.65, 0.20, 0.40},
                                            {0.90, 0.40, 0.25},
                                            {0.98, 0.70, 0.25},
                                            {0.99, 0.98, 0.75}}};
    const double place = std::clamp(share, 0.0, 1.0) * (kStops.size() - 1);
    const std::size_t below = std::min<std::size_t>(static_cast<std::size_t>(place), 4);
    Colour colour{};
    for (std::size_t c = 0; c < 3; ++c) {
        const double to = place - std::floor(place == 5.0 ? 4.0 : place);
        colour[c] = kStops[below][c] + (kStops[below + 1][c] - kStops[below][c]) * to;
    }
    return colour;
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

constexpr Colour kInkColour{0.1, 0.1, 0.1}, kGreyColour{0.33, 0.33, 0.33};
constexpr Colour kNoSplat{0.85, 0.85, 0.85};

Colour colour_of(double value, double largest) {
    return std::isnan(value) ? kNoSplat : heat(largest > 0 ? value / largest : 0);
}

// The picture in the upper left corner, so that its pixels keep their places, and below it the
// title, the subtitle, the scale and, if there are some, the words for tiles that list no splat.
Image with_legend(const Image& picture, const TileMap& map, const std::string& subtitle,
                  const std::string& no_splat) {
    constexpr int kLegendTicks = 4, kLeastWidth = 520, kFullWidth = 960;
    const int scale = std::max(1, picture.width / kFullWidth + (picture.width >= kLeastWidth));
    const int line = kRasterText * scale, margin = line;
    const double largest = largest_of(map);
    const int width =
        std::max({picture.width, kLeastWidth, raster_width(map.title, scale) + 2 * margin,
                  raster_width(subtitle, scale) + 2 * margin});
    Raster page(width, picture.height + 6 * line);
    page.put(picture, 0, 0);
    int y = picture.height + line / 2;
    page.text(margin, y, scale, map.title, kInkColour);
    page.text(margin, y += line, scale, subtitle, kGreyColour);
    y += 3 * line / 2;
    const int bar = width / 2;
    for (int x = 0; x < bar; ++x) {
        page.rectangle(margin + x, y, 1, line, heat((x + 0.5) / bar));
    }
    if (!no_splat.empty()) {
        page.rectangle(2 * margin + bar, y, line, line, kNoSplat);
        page.text(3 * margin + bar + line / 2, y + line / 6, scale, no_splat, kGreyColour);
    }
    y += line;
    for (int tick = 0; tick <= kLegendTicks; ++tick) {
        const std::string words = words_of(map, largest * tick / kLegendTicks);
        const int at = margin + tick * (bar - scale) / kLegendTicks;
        page.rectangle(at, y, scale, line / 3, kGreyColour);
        const int half = raster_width(words, scale) / 2;
        page.text(std::max(at - half, margin), y + line / 2, scale, words, kGreyColour);
    }
    return page.image();
}

} // namespace

TileMaps tile_maps_of(const RunResult& result) {
    TileMaps maps{TileGrid(result.camera, result.workload.tile_size), {}};
    const std::size_t tiles = std::size_t{1} * maps.grid.tiles_x() * maps.grid.tiles_y();
    const auto add = [&](const std::string& name, const std::string& title, const auto& value) {
        TileMap map{name, title, std::vector<float>(tiles, static_cast<float>(kNoValue))};
        for (const TileRecord& tile : result.accelerator.tile_records) {
            if (tile.frame == 0) {
                map.values[maps.grid.tile_of_pixel(tile.x, tile.y)] =
                    static_cast<float>(value(tile));
            }
        }
        maps.maps.push_back(std::move(map));
    };
    for (const Measured& measured : kMeasured) {
        add(measured.name, measured.title, measured.value);
    }
    for (std::size_t s = 0; s < kSlotClasses.size(); ++s) {
        add(slot_name(s), std::string("PE-cycles of a tile: ") + kSlotClasses[s].name,
            [s](const TileRecord& t) { return real_of(t.activity.slots[kSlotClasses[s].slot]); });
    }
    return maps;
}

Image map_picture(const TileMaps& maps, const TileMap& map, const std::string& subtitle) {
    constexpr int kUsualWidth = 960, kLargestTile = 64;
    const int columns = maps.grid.tiles_x(), rows = maps.grid.tiles_y();
    const int side = std::clamp(kUsualWidth / columns, 1, kLargestTile);
    const double largest = largest_of(map);
    Raster picture(columns * side, rows * side);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            picture.rectangle(column * side, row * side, side, side,
                              colour_of(map.values[row * columns + column], largest));
        }
    }
    return with_legend(picture.image(), map, subtitle, "no splat listed");
}

// The image in grey below the colours, so that both can be seen.
Image map_over(const TileMaps& maps, const TileMap& map, const std::string& subtitle,
               const Image& image) {
    constexpr double kHeat = 0.65;
    const double largest = largest_of(map);
    const PixelBox& first = maps.grid.image();
    Image over = image;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double value = map.values[maps.grid.tile_of_pixel(first.x0 + x, first.y0 + y)];
            const std::size_t pixel = 3 * image.at(x, y);
            const double grey = std::clamp(
                (image.rgb[pixel] + image.rgb[pixel + 1] + image.rgb[pixel + 2]) / 3.0, 0.0, 1.0);
            const Colour colour =
                std::isnan(value) ? Colour{grey, grey, grey} : colour_of(value, largest);
            for (std::size_t c = 0; c < 3; ++c) {
                over.rgb[pixel + c] = static_cast<float>((1 - kHeat) * grey + kHeat * colour[c]);
            }
        }
    }
    return with_legend(over, map, subtitle, "");
}

std::vector<std::string> tile_map_files() {
    std::vector<std::string> files{kLayers};
    const auto add = [&files](const std::string& name) {
        files.push_back(name + ".png");
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
                                 std::to_string(maps.grid.tile_size()) + " px";
    std::vector<ExrLayer> layers;
    for (const TileMap& map : maps.maps) {
        write_png(map_picture(maps, map, subtitle), out.path(map.name + ".png"));
        write_png(map_over(maps, map, subtitle, run.images.front()),
                  out.path(map.name + "_over_image.png"));
        layers.push_back({map.name, map.values.data()});
    }
    write_exr(layers, maps.grid.tiles_x(), maps.grid.tiles_y(), out.path(kLayers));
}

std::vector<std::string> old_tile_maps(const OutputFolder& out,
                                       const std::optional<OutputFolder>& maps) {
    std::vector<std::string> paths = maps ? maps->paths() : std::vector<std::string>();
    if (std::filesystem::exists(out.path(kLayers))) { // else files of such names may be the user's
        for (const std::string& file : tile_map_files()) {
            paths.push_back(out.path(file));
        }
    }
    return paths;
}

} // namespace degs::sim
