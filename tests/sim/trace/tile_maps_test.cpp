// SPDX-License-Identifier: Apache-2.0
// --maps: what every tile took, against the report and against its image.
#include <cmath>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include "scene/files/image_io.hpp"
#include "sim/plot/raster.hpp"
#include "sim/trace/tile_maps.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::vector<float> layer(const std::string& path, const std::string& name, int& width) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    width = window.max.x + 1;
    std::vector<float> values(std::size_t{1} * width * (window.max.y + 1));
    Imf::FrameBuffer buffer;
    buffer.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4,
                                   std::size_t{4} * width));
    EXPECT_NE(file.header().channels().findChannel(name), nullptr) << name;
    file.setFrameBuffer(buffer);
    file.readPixels(0, window.max.y);
    return values;
}

double sum_of(const std::vector<float>& values) {
    double sum = 0;
    for (const float value : values) {
        sum += std::isnan(value) ? 0 : value;
    }
    return sum;
}

class MapsOf : public ::testing::TestWithParam<const char*> {};

TEST_P(MapsOf, AddUpToTheReportAndTheImage) {
    const Folder folder;
    // In double precision, with exact ends where spans are solved, only useful tasks update pixels.
    std::vector<std::string> arguments{"run",
                                       config(GetParam()),
                                       "--scene",
                                       "synthetic:object,gaussians=1000",
                                       "--width",
                                       "200",
                                       "--no-reference",
                                       "--out",
                                       folder / "out",
                                       "--maps",
                                       folder / "maps",
                                       "--set",
                                       "pipeline.numbers=fp64"};
    if (std::string(GetParam()).rfind("degs", 0) == 0) {
        arguments.insert(arguments.end(), {"--set", "pipeline.span_ends=exact"});
    }
    expect_success(degs(arguments));
    const auto report = report_in(folder / "out");
    const std::string tiles = folder / "maps/tiles.exr";
    int width = 0;
    for (const auto* slot : {"useful", "boundary", "terminated", "conflict", "ports", "padding",
                             "starved", "blocked", "drain"}) {
        EXPECT_EQ(sum_of(layer(tiles, std::string("slots_") + slot, width)),
                  report["slots"][slot].get<double>())
            << slot;
    }
    EXPECT_EQ(sum_of(layer(tiles, "list_length", width)),
              report["workload"]["tile_pairs"].get<double>());
    const int size = report["workload"]["tile_size"];
    EXPECT_EQ(width, (200 + size - 1) / size);
    // The fragments of each tile are those of its pixels.
    const std::vector<float> fragments = layer(tiles, "fragments", width);
    const Image image = read_exr(folder / "out/image.exr");
    std::vector<double> updates(fragments.size(), 0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            updates[y / size * width + x / size] += image.fragments[image.at(x, y)];
        }
    }
    const std::vector<float> cycles = layer(tiles, "cycles", width);
    const std::vector<float> residence = layer(tiles, "residence", width);
    for (std::size_t t = 0; t < fragments.size(); ++t) {
        EXPECT_EQ(std::isnan(fragments[t]) ? 0 : fragments[t], updates[t]) << "tile " << t;
        if (!std::isnan(cycles[t])) {
            EXPECT_GE(residence[t], cycles[t]) << "tile " << t;
            EXPECT_LE(cycles[t], report["timing"]["blending_cycles"].get<float>());
        }
    }
    for (const std::string& file : sim::tile_map_files()) {
        EXPECT_TRUE(fs::exists(folder / ("maps/" + file))) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(Designs, MapsOf,
                         ::testing::Values("degs-64", "degs-1024-streams", "gscore-64", "gbu-64",
                                           "gcc-64"),
                         [](const auto& design) {
                             std::string name = design.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

sim::TileMaps two_tiles() {
    return {TileGrid(8, 3, 4), {}};
}

double brightness(const Image& image, int x, int y) {
    const float* const pixel = &image.rgb[3 * image.at(x, y)];
    return pixel[0] + pixel[1] + pixel[2];
}

TEST(TileMaps, PicturesShowMuchBrighterThanLittle) {
    const sim::TileMaps maps = two_tiles();
    const sim::TileMap map{"cycles", "Cycles of a tile", {0.0F, 2000.0F}};
    const Image picture = sim::map_picture(maps, map, "degs-64");
    EXPECT_LT(brightness(picture, 0, 0), brightness(picture, 127, 0)); // tiles of 64 px
    EXPECT_EQ(brightness(picture, 0, 0), brightness(picture, 63, 63));
    const Image over = sim::map_over(maps, map, "degs-64", Image(8, 3));
    EXPECT_LT(brightness(over, 0, 0), brightness(over, 7, 0));
    EXPECT_EQ(brightness(over, 0, 0), brightness(over, 3, 2)); // a tile has one colour
}

TEST(TileMaps, PicturesHaveATitleAndALegend) {
    const sim::TileMaps maps = two_tiles();
    const auto picture = [&maps](const char* title, float largest, const char* subtitle) {
        return sim::map_picture(maps, {"cycles", title, {0.0F, largest}}, subtitle).rgb;
    };
    const auto shown = picture("Cycles of a tile", 2000, "degs-64");
    EXPECT_NE(shown, picture("Fragments", 2000, "degs-64"));
    EXPECT_NE(shown, picture("Cycles of a tile", 3000, "degs-64")); // the numbers of the scale
    EXPECT_NE(shown, picture("Cycles of a tile", 2000, "gbu-64"));
}

TEST(TileMaps, PicturesGrowWithLongWords) {
    const sim::TileMaps maps = two_tiles();
    const sim::TileMap map{"cycles", "Cycles of a tile", {0.0F, 2000.0F}};
    const std::string words(300, 'm');
    EXPECT_GT(sim::map_picture(maps, map, words).width, sim::raster_width(words, 1));
}

TEST(Raster, CutsOffWhatLiesBeyondThePage) {
    sim::Raster page(4, 3);
    page.rectangle(-2, -2, 3, 3, {0, 0, 0});
    page.rectangle(3, 2, 9, 9, {0, 0, 0});
    page.text(-3, -3, 5, "W", {1, 1, 1});
    EXPECT_EQ(brightness(page.image(), 1, 1), 3);
    EXPECT_EQ(brightness(page.image(), 3, 2), 0);
    EXPECT_EQ(page.image().rgb.size(), 36U);
}

TEST(Raster, DrawsTextWithinItsWidthAndHeight) {
    const std::string words = "12.5 %";
    for (const int scale : {1, 3}) {
        const int width = sim::raster_width(words, scale);
        sim::Raster page(width + 8, sim::kRasterText * scale + 8);
        page.text(4, 4, scale, words, {0, 0, 0});
        int black = 0;
        for (int y = 0; y < page.image().height; ++y) {
            for (int x = 0; x < page.image().width; ++x) {
                const bool drawn = brightness(page.image(), x, y) == 0;
                black += drawn;
                EXPECT_TRUE(!drawn || (x >= 4 && x < 4 + width && y >= 4)) << x << ", " << y;
                EXPECT_TRUE(!drawn || y < 4 + sim::kRasterText * scale) << y;
            }
        }
        EXPECT_GT(black, 20 * scale * scale);
    }
}

TEST(HostileTileMaps, Mistakes) {
    const Folder folder;
    std::ofstream(folder / "file") << "x";
    expect_mistake(degs({"run", config("degs-16"), "--scene", "synthetic:single", "--out",
                         folder / "out", "--maps", folder / "file"}),
                   "cannot be used");
}

} // namespace
} // namespace degs::sim_test
