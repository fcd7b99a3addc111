// SPDX-License-Identifier: Apache-2.0
#include "scene/files/image_io.hpp"

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <png.h>

#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::complaint;
using test::Folder;
using test::IsSentenceWith;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

/// Values of all kinds, different in every pixel and layer.
Image colourful(int width, int height) {
    Image image(width, height);
    for (std::size_t i = 0; i < image.pixels(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            image.rgb[3 * i + c] = static_cast<float>(3 * i + c) * 0.37F - 2.0F;
        }
        image.transmittance[i] = 1.0F / static_cast<float>(i + 1);
        image.fragments[i] = static_cast<std::uint32_t>(i * 40503U) << 8U;
    }
    const float special[] = {kNan, kInf, -kInf, -0.0F, 1e-40F, 3e38F};
    std::memcpy(image.rgb.data(), special, std::min(sizeof special, image.rgb.size() * 4));
    return image;
}

void expect_same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
}

TEST(Exr, KeepsEveryBitOfEveryLayer) {
    const Folder folder;
    for (const auto& [width, height] : {std::pair{1, 1}, {37, 23}, {640, 3}, {2, 300}}) {
        const Image image = colourful(width, height);
        write_exr(image, folder.path("image.exr"));
        const Image back = read_exr(folder.path("image.exr"));
        EXPECT_EQ(back.width, width);
        EXPECT_EQ(back.height, height);
        expect_same_bits(back.rgb, image.rgb);
        expect_same_bits(back.transmittance, image.transmittance);
        EXPECT_EQ(back.fragments, image.fragments);
    }
    EXPECT_EQ(folder.entries(), 1U); // replaced in place, nothing left behind
}

TEST(Exr, SaysWhatItsColoursAre) {
    const Folder folder;
    write_exr(colourful(4, 4), folder.path("image.exr"));
    const Imf::InputFile file(folder.path("image.exr").c_str());
    const auto* const space = file.header().findTypedAttribute<Imf::StringAttribute>("colorSpace");
    ASSERT_NE(space, nullptr);
    EXPECT_EQ(space->value(), "srgb_rec709_display");
}

TEST(Exr, IsTheSameFileForTheSameImage) {
    const Folder folder;
    write_exr(colourful(50, 40), folder.path("a.exr"));
    write_exr(colourful(50, 40), folder.path("b.exr"));
    EXPECT_EQ(test::bytes_of(folder.path("a.exr")), test::bytes_of(folder.path("b.exr")));
}

TEST(HostileExr, IsRefusedWithASentence) {
    const Folder folder;
    write_exr(colourful(50, 40), folder.path("good.exr"));
    const std::string good = test::bytes_of(folder.path("good.exr"));
    EXPECT_THAT(complaint([&] { read_exr(folder.path("absent.exr")); }),
                IsSentenceWith("there is no such file"));
    EXPECT_THAT(complaint([&] { read_exr(folder.write("text.exr", "hello")); }),
                IsSentenceWith("text.exr: this is not a readable OpenEXR image"));
    for (std::size_t size = 1; size < good.size(); size += 61) {
        const std::string path = folder.write("cut.exr", good.substr(0, size));
        EXPECT_FALSE(complaint([&] { read_exr(path); }).empty()) << size;
    }
    std::string huge = good; // a header that claims 2^30 x 2^30 pixels
    const std::size_t window = huge.find("dataWindow") + std::strlen("dataWindow.box2i.") + 4;
    for (const std::size_t at : {window + 8, window + 12}) {
        huge.replace(at, 4, std::string("\xff\xff\xff\x3f"));
    }
    EXPECT_FALSE(complaint([&] { read_exr(folder.write("huge.exr", huge)); }).empty());
    std::string renamed = good;
    renamed.replace(renamed.find(std::string("channels\0chlist\0", 16)) + 16 + 4, 1, "Q");
    EXPECT_THAT(complaint([&] { read_exr(folder.write("noblue.exr", renamed)); }),
                IsSentenceWith("."));
}

std::vector<png_byte> read_png(const std::string& path, int& width, int& height) {
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&png, path.c_str()), 0) << png.message;
    EXPECT_EQ(png.format & PNG_FORMAT_FLAG_COLORMAP, 0U);
    png.format = PNG_FORMAT_RGB;
    width = static_cast<int>(png.width);
    height = static_cast<int>(png.height);
    std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
    EXPECT_NE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr), 0) << png.message;
    return bytes;
}

TEST(Png, RoundsAndClampsWithoutGamma) {
    const std::pair<float, int> cases[] = {
        {0.0F, 0},   {1.0F, 255},    {0.5F, 128},         {0.25F, 64},   {-0.1F, 0},
        {1.5F, 255}, {kNan, 0},      {kInf, 255},         {-kInf, 0},    {3e38F, 255},
        {1e-30F, 0}, {0.4980F, 127}, {100 / 255.0F, 100}, {0.00195F, 0}, {0.00197F, 1},
    };
    Image image(5, 1);
    for (std::size_t i = 0; i < 15; ++i) {
        image.rgb[i] = cases[i].first;
    }
    const Folder folder;
    write_png(image, folder.path("image.png"));
    int width = 0;
    int height = 0;
    const std::vector<png_byte> bytes = read_png(folder.path("image.png"), width, height);
    EXPECT_EQ(width, 5);
    EXPECT_EQ(height, 1);
    ASSERT_EQ(bytes.size(), 15U);
    for (std::size_t i = 0; i < 15; ++i) {
        EXPECT_EQ(bytes[i], cases[i].second) << cases[i].first;
    }
}

TEST(Png, KeepsRowsAndColumnsApart) {
    Image image(3, 2);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
        image.rgb[i] = static_cast<float>(i) / 255;
    }
    const Folder folder;
    write_png(image, folder.path("image.png"));
    int width = 0;
    int height = 0;
    const std::vector<png_byte> bytes = read_png(folder.path("image.png"), width, height);
    EXPECT_EQ(width, 3);
    EXPECT_EQ(height, 2);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        EXPECT_EQ(bytes[i], i);
    }
}

TEST(HostileImageOutput, IsAnInputErrorAndLeavesNoFile) {
    const Folder folder;
    const Image image = colourful(4, 4);
    for (const auto& write : {write_exr, write_png}) {
        EXPECT_THAT(complaint([&] { write(image, folder.path("none/image")); }),
                    IsSentenceWith("does not exist"));
        EXPECT_THAT(complaint([&] { write(image, folder.path("")); }), IsSentenceWith("folder"));
        EXPECT_THAT(complaint([&] { write(image, "/dev/null"); }), IsSentenceWith("device"));
        EXPECT_THAT(complaint([&] { write(image, "/proc/image"); }), IsSentenceWith("/proc/image"));
        EXPECT_THAT(complaint([&] { write(image, ""); }), IsSentenceWith("name"));
        EXPECT_THAT(complaint([&] { write(Image(0, 5), folder.path("image")); }),
                    IsSentenceWith("0 x 5"));
    }
    EXPECT_EQ(folder.entries(), 0U);
}

} // namespace
} // namespace degs
