// SPDX-License-Identifier: Apache-2.0
// What a scene file may cost: memory in proportion to its size, whole or damaged, and little time.
// Not a Hostile suite, because the address sanitizer keeps what has been freed.
#include <cstdio>
#include <random>

#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/spz/spz_write.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/reading_cost.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

constexpr double kMega = 1e6;

using Cost = test::ReadingCost;

Cost cost_of(const std::string& path) {
    return test::cost_of_reading([&] { load_scene(path); });
}

/// 8 files each with a bit flipped in the header, a bit anywhere, and the end missing.
std::vector<std::string> damaged(const std::string& good, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<std::string> files;
    const auto flip = [&](std::size_t within) {
        files.push_back(good);
        char& byte = files.back()[random() % within];
        byte = static_cast<char>(byte ^ 1 << random() % 8);
    };
    for (int i = 0; i < 8; ++i) {
        flip(std::min<std::size_t>(good.size(), 64));
        flip(good.size());
        files.push_back(good.substr(0, random() % good.size()));
    }
    return files;
}

struct FormatLimit {
    const char* file; ///< among the shared scenes
    double multiple;  ///< of its size, of memory
};

void PrintTo(const FormatLimit& limit, std::ostream* out) {
    *out << limit.file;
}

class LongFormatMemory : public testing::TestWithParam<FormatLimit> {};

TEST_P(LongFormatMemory, StaysInProportionToTheFile) {
    DEGS_NEEDS_SCENE(GetParam().file);
    const std::string name = (test::scenes() / GetParam().file).string();
    const std::string extension = std::filesystem::path(name).extension().string();
    const std::string good = test::bytes_of(name);
    const test::Folder folder;
    constexpr double kFixed = 12 * kMega; // buffers and what the libraries keep
    for (const std::string& bytes : damaged(good, 17)) {
        const Cost cost = cost_of(folder.write("damaged" + extension, bytes));
        ASSERT_TRUE(cost.ended);
        EXPECT_LT(static_cast<double>(cost.bytes),
                  GetParam().multiple * static_cast<double>(good.size()) + kFixed);
    }
}
INSTANTIATE_TEST_SUITE_P(Shared, LongFormatMemory,
                         testing::Values(FormatLimit{"flowers-small/scene.ply", 1.3},
                                         FormatLimit{"fruit-drops/scene.ply", 1.3},
                                         FormatLimit{"fruit-drops/scene-v2.spz", 8},
                                         FormatLimit{"skull/scene-v3.spz", 9},
                                         FormatLimit{"formats/minimal-v4.spz", 8},
                                         FormatLimit{"formats/minimal.splat", 4},
                                         FormatLimit{"skull/skull.sog", 11},
                                         FormatLimit{"garden-crop/test_garden.npz", 9}),
                         [](const auto& row) {
                             std::string name = row.param.file;
                             for (char& c : name) {
                                 c = std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
                             }
                             return name;
                         });

TEST(FormatMemory, ClaimsOfInflatedSizesAreNotBelieved) {
    // A file of 0.4 MB that inflates to 8 MB, but memory follows what is really there.
    GaussianCloud same;
    std::mt19937 random(1);
    for (int i = 0; i < 400000; ++i) {
        same.means.emplace_back(1, 2, 3);
        same.scales.emplace_back(1, 1, 1);
        same.rotations.emplace_back(1, 0, 0, 0);
        same.opacities.push_back(static_cast<float>(random() % 256) / 255.0F);
        same.sh.insert(same.sh.end(), 3, 0.25F);
    }
    const test::Folder folder;
    for (const int version : {3, 4}) {
        write_spz(same, folder.path("same.spz"), {version, false});
        const std::string good = test::bytes_of(folder.path("same.spz"));
        EXPECT_LT(good.size(), 500000U);
        const Cost whole = cost_of(folder.path("same.spz"));
        EXPECT_GT(whole.bytes, 20 * kMega); // 68 bytes per Gaussian
        EXPECT_LT(whole.bytes, 60 * kMega);
        const Cost cut = cost_of(folder.write("cut.spz", good.substr(0, good.size() / 3)));
        EXPECT_LT(cut.bytes, whole.bytes);
    }
}

/// The table of docs/scene-formats.md; takes a minute and 3 GB, so it runs on demand only.
TEST(FormatSpeed, DISABLED_FourMillionGaussians) {
    const test::Folder folder;
    const GaussianCloud cloud = make_synthetic({"landscape", 4000000, 1}).cloud;
    write_ply(cloud, folder.path("scene.ply"));
    write_spz(cloud, folder.path("scene-3.spz"), {3, false});
    write_spz(cloud, folder.path("scene-4.spz"), {4, false});
    folder.write("cameras.json", R"([{"width": 640, "height": 480, "position": [0, 0, -4],
        "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "fx": 500, "fy": 500}])");
    const auto ply_bytes =
        static_cast<double>(std::filesystem::file_size(folder.path("scene.ply")));
    for (const char* const name : {"scene.ply", "scene-3.spz", "scene-4.spz"}) {
        const auto bytes = static_cast<double>(std::filesystem::file_size(folder.path(name)));
        Cost best;
        for (int repeat = 0; repeat < 3; ++repeat) {
            const Cost cost = cost_of(folder.path(name));
            best = best.ended && best.seconds < cost.seconds ? best : cost;
        }
        std::printf("%-12s %6.0f MB  %5.2f s  %6.0f MB/s of PLY  %5.2f B of memory per byte\n",
                    name, bytes / kMega, best.seconds, ply_bytes / kMega / best.seconds,
                    static_cast<double>(best.bytes) / bytes);
        EXPECT_GT(ply_bytes / best.seconds, (*(name + 6) == 'p' ? 500 : 100) * kMega);
        if (std::string(name) == "scene.ply") {
            EXPECT_LT(static_cast<double>(best.bytes), 1.3 * bytes);
        }
    }
}

} // namespace
} // namespace degs
