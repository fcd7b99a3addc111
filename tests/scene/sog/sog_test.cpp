// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog.hpp"

#include <cmath>
#include <random>

#include "scene/scene.hpp"
#include "scene/scene_formats.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/sog/sog_builder.hpp"

namespace degs {
namespace {

using test::Bytes;
using test::IsSentenceWith;
using test::SogBuilder;
using test::webp;

SceneContent content_of(const std::string& bytes) {
    return test::sog_content_of(bytes);
}

void expect_decoded(const SogBuilder& made, const GaussianCloud& cloud) {
    ASSERT_EQ(cloud.size(), static_cast<std::size_t>(made.count));
    ASSERT_EQ(cloud.sh_degree, made.degree);
    const double low[] = {-1, -2, 0.5}, high[] = {1, 2, 3.5};
    const double scale_low[] = {-9, -8, -7}, scale_high[] = {-1, -2, -3};
    const double colour_low[] = {-2, -1, 0}, colour_high[] = {2, 1, 3};
    for (int i = 0; i < made.count; ++i) {
        double squares = 0;
        int packed = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const int word = made.low[4 * i + axis] + 256 * made.high[4 * i + axis];
            const double folded = low[axis] + (high[axis] - low[axis]) * word / 65535;
            const double mean = folded < 0 ? 1 - std::exp(-folded) : std::exp(folded) - 1;
            EXPECT_NEAR(cloud.means[i][axis], mean, 1e-12);
            const int s = made.scales[4 * i + axis], c = made.sh0[4 * i + axis];
            const double log_scale =
                made.version_2 ? SogBuilder::code("s", s)
                               : scale_low[axis] + (scale_high[axis] - scale_low[axis]) * s / 255;
            EXPECT_NEAR(std::log(cloud.scales[i][axis] * 1.0), log_scale, 2e-6);
            const double colour =
                made.version_2
                    ? SogBuilder::code("c", c)
                    : colour_low[axis] + (colour_high[axis] - colour_low[axis]) * c / 255;
            EXPECT_NEAR(cloud.sh_of(i)[axis], colour, 1e-6);
        }
        const double alpha = made.sh0[4 * i + 3] / 255.0;
        EXPECT_NEAR(cloud.opacities[i], made.version_2 ? alpha : 1 / (1 + std::exp(5 - 10 * alpha)),
                    1e-6);
        const int largest = made.quats[4 * i + 3] - 252;
        for (int k = 0; k < 4; ++k) { // w x y z
            if (k != largest) {
                const double value = (made.quats[4 * i + packed++] / 255.0 * 2 - 1) / std::sqrt(2);
                EXPECT_NEAR(cloud.rotations[i][k], value, 1e-6);
                squares += value * value;
            }
        }
        EXPECT_NEAR(cloud.rotations[i][largest], std::sqrt(std::max(0.0, 1 - squares)), 1e-6);
        const int label = made.labels[4 * i];
        for (int k = 0; k < made.rest(); ++k) {
            const int pixel = label / 64 * 64 * made.rest() + label % 64 * made.rest() + k;
            for (int channel = 0; channel < 3; ++channel) {
                const int byte = made.centroids[4 * pixel + channel];
                const double value =
                    made.version_2 ? SogBuilder::code("r", byte) : -0.5 + 1.25 * byte / 255;
                EXPECT_NEAR(cloud.sh_of(i)[3 * (k + 1) + channel], value, 1e-6);
            }
        }
    }
}

TEST(Sog, DecodesEveryField) {
    for (const int degree : {0, 1, 2, 3}) {
        SogBuilder made;
        made.set_degree(degree);
        const SceneContent content = content_of(made.file());
        expect_decoded(made, content.cloud);
        EXPECT_TRUE(content.traits.antialiased);
        EXPECT_TRUE(content.notes.empty());
    }
}

TEST(Sog, DecodesVersionOne) {
    SogBuilder made;
    made.make_version_1();
    const SceneContent content = content_of(made.file());
    expect_decoded(made, content.cloud);
    EXPECT_FALSE(content.traits.antialiased);
}

TEST(Sog, MayBeDeflatedAndRenamed) {
    const SogBuilder made;
    test::ZipBuilder zip = made.archive();
    zip.deflated = true;
    const test::Folder folder;
    expect_decoded(made, read_scene_file(folder.write("scene.zip", zip.file())).cloud);
}

TEST(Sog, SaysWhatItHadToGuess) {
    SogBuilder made;
    made.quats[3] = 7;
    made.labels[4] = 69;
    made.labels[5] = 200; // beyond the palette
    const SceneContent content = content_of(made.file());
    EXPECT_EQ(content.cloud.rotations[0], glm::vec4(1, 0, 0, 0));
    EXPECT_EQ(content.cloud.sh_of(1)[3], 0);
    ASSERT_EQ(content.notes.size(), 2U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("1 rotations"));
    EXPECT_THAT(content.notes[1], IsSentenceWith("beyond the palette"));
}

TEST(Sog, ModelsAreThoseOfSplatTransform) {
    const auto with_model = [](const std::string& members) {
        SogBuilder made;
        const std::string from = "\"antialias\":true,";
        made.meta.replace(made.meta.find(from), from.size(), members);
        return content_of(made.file());
    };
    EXPECT_FALSE(with_model("").traits.antialiased);
    EXPECT_TRUE(with_model("\"model\":\"antialiased\",").traits.antialiased);
    EXPECT_TRUE(with_model("\"antialias\":true,\"model\":\"default\",").traits.antialiased);
    EXPECT_FALSE(with_model("\"model\":\"default\",").traits.antialiased);
    EXPECT_TRUE(with_model("\"model\":\"default\",").notes.empty());
    EXPECT_THAT(with_model("\"model\":\"2dgs\",").notes,
                testing::ElementsAre(IsSentenceWith("2D Gaussian Splatting")));
    EXPECT_THAT(with_model("\"model\":\"warp\",").notes,
                testing::ElementsAre(IsSentenceWith("'model: warp' of the file is unknown")));
    EXPECT_THAT(test::complaint([&] { with_model("\"model\":2,"); }), IsSentenceWith("no text"));
}

/// The files of the scene in a folder of their own; returns the name of meta.json.
std::string unbundled(const SogBuilder& made, const test::Folder& folder) {
    for (const auto& [name, content] : made.archive().files) {
        folder.write("scene/" + name, content);
    }
    return folder.path("scene/meta.json");
}

TEST(Sog, UnbundledScenesAreReadFromTheirFolder) {
    const SogBuilder made;
    const test::Folder folder;
    const std::string meta = unbundled(made, folder);
    expect_decoded(made, read_scene_file(meta).cloud);
    EXPECT_EQ(load_scene(meta).name, "scene");
    EXPECT_EQ(scene_external_files(meta).size(), 7U);
    EXPECT_TRUE(scene_external_files(folder.write("a.sog", made.file())).empty());
    std::filesystem::rename(meta, folder.path("scene/other.json"));
    expect_decoded(made, read_scene_file(folder.path("scene/other.json")).cloud);
}

TEST(HostileSog, UnbundledScenesStayInTheirFolder) {
    SogBuilder made;
    const test::Folder folder;
    folder.write("out.webp", made.archive().files[1].second);
    const auto refusal = [&](const std::string& name) {
        SogBuilder bad = made;
        const std::string from = "\"u.webp\"";
        bad.meta.replace(bad.meta.find(from), from.size(), "\"" + name + "\"");
        const std::string meta = unbundled(bad, folder);
        return test::complaint([&] { read_scene_file(meta); });
    };
    EXPECT_EQ(refusal("u.webp"), "");
    EXPECT_THAT(refusal("../out.webp"), IsSentenceWith("only files in the folder of the scene"));
    EXPECT_THAT(refusal("/etc/hostname"), IsSentenceWith("only files in the folder of the scene"));
    EXPECT_THAT(refusal("none.webp"), IsSentenceWith("there is no such file"));
    EXPECT_THAT(refusal("u.webp\\u0000"), IsSentenceWith("control character"));
    EXPECT_THAT(refusal("u.webp\\n"), IsSentenceWith("control character"));
}

TEST(HostileSog, StreamedScenesInArchivesAreNamed) {
    test::ZipBuilder zip;
    zip.files.emplace_back("lod-meta.json", "{}");
    EXPECT_THAT(test::complaint([&] { content_of(zip.file()); }),
                IsSentenceWith("read from a folder only"));
}

TEST(Sog, SkullIsThePlyThatWasMadeFromIt) {
    DEGS_NEEDS_SCENE("skull");
    const std::string folder = (test::scenes() / "skull").string();
    const Scene sog = load_scene(folder + "/skull.sog"), ply = load_scene(folder + "/scene.ply");
    EXPECT_TRUE(sog.notes.empty());
    ASSERT_EQ(sog.cloud.size(), ply.cloud.size());
    for (std::size_t i = 0; i < ply.cloud.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) { // the PLY holds float logarithms and logits
            ASSERT_NEAR(sog.cloud.means[i][axis], ply.cloud.means[i][axis], 1e-6);
            ASSERT_NEAR(sog.cloud.scales[i][axis] / ply.cloud.scales[i][axis], 1, 1e-5);
        }
        ASSERT_NEAR(sog.cloud.opacities[i], ply.cloud.opacities[i], 2e-6);
        ASSERT_GT(std::abs(glm::dot(sog.cloud.rotations[i], ply.cloud.rotations[i])), 1 - 1e-6F);
        for (int k = 0; k < 48; ++k) {
            ASSERT_NEAR(sog.cloud.sh_of(i)[k], ply.cloud.sh_of(i)[k], 1e-6);
        }
    }
}

TEST(HostileSog, ImagesThatGoOnBehindTheGaussiansAreAWarning) {
    for (const int count : {12, 1}) { // of 20 pixels in rows of 5 or 2
        SogBuilder made;
        made.width = count == 12 ? 5 : 2;
        made.height = count == 12 ? 4 : 10;
        made.count = count;
        made.meta = made.meta_2();
        EXPECT_EQ(content_of(made.file()).notes.size(), count == 12 ? 0U : 1U);
    }
}

std::string mistake_in_sog(const SogBuilder& made) {
    return test::complaint([&] { content_of(made.file()); });
}

TEST(HostileSog, LiesAreOneSentence) {
    const SogBuilder good;
    const auto with_meta = [&](const std::string& from, const std::string& to) {
        SogBuilder bad = good;
        bad.meta.replace(bad.meta.find(from), from.size(), to);
        return mistake_in_sog(bad);
    };
    EXPECT_THAT(with_meta("\"version\":2", "\"version\":3"), IsSentenceWith("version 1 or 2"));
    EXPECT_THAT(with_meta("{\"version\"", "[\"version\""), IsSentenceWith("no JSON"));
    EXPECT_THAT(with_meta("\"count\":19", "\"count\":0"), IsSentenceWith("0 Gaussians"));
    EXPECT_THAT(with_meta("\"count\":19", "\"count\":21"), IsSentenceWith("fewer than its 21"));
    EXPECT_THAT(with_meta("\"count\":19", "\"count\":-1"), IsSentenceWith("whole number 'count'"));
    EXPECT_THAT(with_meta("\"count\":19", "\"count\":4000000000"), IsSentenceWith("allowed are"));
    EXPECT_THAT(with_meta("[-1,-2,0.5]", "[-1,-2]"), IsSentenceWith("'mins'"));
    EXPECT_THAT(with_meta("[-1,-2,0.5]", "[-1,-2,0.5,1]"), IsSentenceWith("more than 3 numbers"));
    EXPECT_THAT(with_meta("[-1,-2,0.5]", "[-1,-2,1e999]"), IsSentenceWith("so this is no SOG"));
    EXPECT_THAT(with_meta("[-1,-2,0.5]", "[-1,-2,\"x\"]"), IsSentenceWith("finite numbers"));
    EXPECT_THAT(with_meta("\"means\"", "\"mean\""), IsSentenceWith("'means'"));
    EXPECT_THAT(with_meta("\"u.webp\"", "7"), IsSentenceWith("means.files"));
    EXPECT_THAT(with_meta("\"u.webp\"", "\"../u.webp\""), IsSentenceWith("holds no file"));
    EXPECT_THAT(with_meta("\"bands\":2", "\"bands\":4"), IsSentenceWith("shN.bands"));
    EXPECT_THAT(with_meta("\"bands\":2", "\"bands\":3"), IsSentenceWith("512 pixels wide"));
    EXPECT_THAT(with_meta("\"p.webp\"", "\"l.webp\""), IsSentenceWith("5 pixels wide"));
    EXPECT_THAT(with_meta("\"s.webp\"", "\"meta.json\""), IsSentenceWith("no still WebP image"));
    SogBuilder large = good; // 3,000 x 3,000 pixels of one colour from a few bytes
    test::ZipBuilder zip = large.archive();
    zip.files[2].second = webp(Bytes(std::size_t{4} * 3000 * 3000, 255), 3000, 3000);
    EXPECT_THAT(test::complaint([&] { content_of(zip.file()); }), IsSentenceWith("3000 x 3000"));
}

TEST(HostileSog, DamagedArchivesLoadOrComplain) {
    const std::string good = SogBuilder().file();
    const test::Folder folder;
    int refused = 0;
    const auto attempt = [&](const std::string& bytes) {
        const std::string path = folder.write("bad.sog", bytes);
        const std::string sentence = test::complaint([&] { read_sog(path); });
        refused += sentence.empty() ? 0 : 1;
        ASSERT_TRUE(sentence.empty() || testing::Value(sentence, IsSentenceWith("bad.sog: ")))
            << sentence;
    };
    for (std::size_t size = 0; size < good.size(); size += 131) {
        attempt(good.substr(0, size));
    }
    std::mt19937 random(2);
    for (int i = 0; i < 200; ++i) {
        std::string bytes = good;
        char& byte = bytes[random() % bytes.size()];
        byte = static_cast<char>(byte ^ 1 << random() % 8);
        attempt(bytes);
    }
    EXPECT_GT(refused, 100);
}

} // namespace
} // namespace degs
