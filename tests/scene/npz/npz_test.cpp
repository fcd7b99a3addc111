// SPDX-License-Identifier: Apache-2.0
#include "scene/npz/npz.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include "scene/npz/nearest_points.hpp"
#include "scene/npz/npy_array.hpp"
#include "scene/npz/npz_cameras.hpp"
#include "scene/scene.hpp"
#include "tests/scene/cameras/seen_pixel.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/zip_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
    std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': " + shape + ", }";
    header.resize((header.size() + 11) / 64 * 64 + 53, ' ');
    header += '\n';
    return "\x93NUMPY" + std::string("\x01\x00", 2) + test::ZipBuilder::little(header.size(), 2) +
           header + data;
}

template <class Value>
std::string raw(const std::vector<Value>& values) {
    std::string bytes(values.size() * sizeof(Value), '\0');
    if (!values.empty()) {
        std::memcpy(bytes.data(), values.data(), bytes.size());
    }
    return bytes;
}

/// An archive of float arrays; others are put into `files`.
struct NpzBuilder {
    test::ZipBuilder zip;

    void add(const std::string& name, const std::string& shape, const std::vector<float>& values) {
        zip.files.emplace_back(name + ".npy", npy("<f4", shape, raw(values)));
    }
    void remove(const std::string& name) {
        for (std::size_t i = 0; i < zip.files.size(); ++i) {
            if (zip.files[i].first == name + ".npy") {
                zip.files.erase(zip.files.begin() + static_cast<std::ptrdiff_t>(i));
            }
        }
    }
    /// Two Gaussians of degree 1, as gsplat trains them.
    static NpzBuilder gaussians() {
        NpzBuilder npz;
        npz.add("means", "(2, 3)", {1, 2, 3, 4, 5, 6});
        npz.add("quats", "(2, 4)", {1, 0, 0, 0, 2, 0, 0, -2});
        npz.add("scales", "(2, 3)", {0, -1, -2, -3, -4, 1});
        npz.add("opacities", "(2,)", {0, 2});
        npz.add("sh0", "(2, 1, 3)", {0.5F, 1, 1.5F, -0.5F, -1, -1.5F});
        std::vector<float> rest;
        for (int i = 0; i < 18; ++i) {
            rest.push_back(static_cast<float>(i) / 8);
        }
        npz.add("shN", "(2, 3, 3)", rest);
        return npz;
    }
    void add_cameras() {
        add("viewmats", "(1, 4, 4)", {0, -1, 0, 1, 1, 0, 0, 2, 0, 0, 1, 3, 0, 0, 0, 1});
        add("Ks", "(1, 3, 3)", {50, 0, 29.5F, 0, 60, 26, 0, 0, 1});
        zip.files.emplace_back("width.npy", npy("<i8", "()", raw<std::int64_t>({64})));
        zip.files.emplace_back("height.npy", npy(">i4", "(1,)", std::string("\0\0\0\x30", 4)));
    }
};

SceneContent content_of(const NpzBuilder& npz) {
    const test::Folder folder;
    return read_npz(folder.write("scene.npz", npz.zip.file()));
}

TEST(Npz, ReadsTheGaussiansOfGsplat) {
    const SceneContent content = content_of(NpzBuilder::gaussians());
    const GaussianCloud& cloud = content.cloud;
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.means[1], glm::dvec3(4, 5, 6));
    EXPECT_EQ(cloud.rotations[1], glm::vec4(2, 0, 0, -2));
    EXPECT_FLOAT_EQ(cloud.scales[0].y, std::exp(-1.0F));
    EXPECT_FLOAT_EQ(cloud.opacities[1], 1 / (1 + std::exp(-2.0F)));
    ASSERT_EQ(cloud.sh_degree, 1);
    EXPECT_EQ(cloud.sh_of(1)[2], -1.5F);
    for (int k = 0; k < 9; ++k) {
        EXPECT_EQ(cloud.sh_of(1)[3 + k], static_cast<float>(9 + k) / 8);
    }
    EXPECT_TRUE(content.notes.empty());
    EXPECT_TRUE(content.cameras.empty());
}

TEST(Npz, ReadsValuesThatAreReadyToDraw) {
    NpzBuilder npz = NpzBuilder::gaussians();
    for (const char* const name : {"scales", "opacities", "sh0", "shN"}) {
        npz.remove(name);
    }
    npz.add("scales", "(2, 3)", {0.5F, 1, 2, 3, 4, 5});
    npz.add("opacities", "(2, 1)", {0.25F, 1});
    npz.add("colors", "(2, 1, 3)", {1, 2, 3, 4, 5, 6});
    npz.zip.deflated = true;
    const SceneContent content = content_of(npz);
    EXPECT_EQ(content.cloud.scales[0], glm::vec3(0.5F, 1, 2));
    EXPECT_EQ(content.cloud.opacities, (std::vector<float>{0.25F, 1}));
    EXPECT_EQ(content.cloud.sh, (std::vector<float>{1, 2, 3, 4, 5, 6}));
    ASSERT_EQ(content.notes.size(), 1U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("not as logarithms"));
}

NpzBuilder even_gaussians(std::size_t count, float scale, float opacity) {
    const std::string n = std::to_string(count);
    NpzBuilder npz;
    npz.add("means", "(" + n + ", 3)", std::vector<float>(3 * count, 1));
    npz.add("quats", "(" + n + ", 4)", std::vector<float>(4 * count, 0.5F));
    npz.add("scales", "(" + n + ", 3)", std::vector<float>(3 * count, scale));
    npz.add("opacities", "(" + n + ",)", std::vector<float>(count, opacity));
    npz.add("sh0", "(" + n + ", 1, 3)", std::vector<float>(3 * count, 0.25F));
    return npz;
}

// Scales and opacities are looked at each for itself.
TEST(Npz, ReadsScalesOrOpacitiesThatAreReadyToDraw) {
    const SceneContent scales = content_of(even_gaussians(100, 0.2F, 3));
    EXPECT_EQ(scales.cloud.scales[0].x, 0.2F);
    EXPECT_FLOAT_EQ(scales.cloud.opacities[0], 1 / (1 + std::exp(-3.0F)));
    EXPECT_THAT(scales.notes, testing::Contains(IsSentenceWith(
                                  "No scale is negative, so the scales were taken as they are, not "
                                  "as logarithms.")));
    const SceneContent opacities = content_of(even_gaussians(100, -2, 0.9F));
    EXPECT_FLOAT_EQ(opacities.cloud.scales[0].x, std::exp(-2.0F));
    EXPECT_EQ(opacities.cloud.opacities[0], 0.9F);
    EXPECT_THAT(opacities.notes, testing::Contains(IsSentenceWith("the opacities were taken as")));
    EXPECT_TRUE(content_of(even_gaussians(100, -2, 3)).notes.empty());
}

// A few logarithms of large scales, or logits of even opacities, look the same by chance.
TEST(Npz, DoubtsScalesOrOpacitiesOfFewGaussians) {
    const SceneContent scales = content_of(even_gaussians(99, 0.2F, 3));
    EXPECT_FLOAT_EQ(scales.cloud.scales[0].x, std::exp(0.2F));
    EXPECT_THAT(scales.notes, testing::Contains(IsSentenceWith("they were read as logarithms")));
    const SceneContent opacities = content_of(even_gaussians(99, -2, 0.9F));
    EXPECT_FLOAT_EQ(opacities.cloud.opacities[0], 1 / (1 + std::exp(-0.9F)));
    EXPECT_THAT(opacities.notes, testing::Contains(IsSentenceWith("they were read as logits")));
}

TEST(Npz, DropsDegreeFour) {
    NpzBuilder npz = NpzBuilder::gaussians();
    npz.remove("shN");
    std::vector<float> rest(144);
    for (std::size_t i = 0; i < rest.size(); ++i) {
        rest[i] = static_cast<float>(i);
    }
    npz.add("shN", "(2, 24, 3)", rest);
    const SceneContent content = content_of(npz);
    EXPECT_EQ(content.cloud.sh_degree, 3);
    EXPECT_EQ(content.cloud.sh_of(1)[3], 72);
    EXPECT_EQ(content.cloud.sh_of(1)[47], 72 + 44);
    ASSERT_EQ(content.notes.size(), 1U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("degree 4"));
}

TEST(Npz, ReadsCameras) {
    NpzBuilder npz = NpzBuilder::gaussians();
    npz.add_cameras();
    const SceneContent content = content_of(npz);
    ASSERT_EQ(content.cameras.size(), 1U);
    const Camera& camera = content.cameras[0];
    EXPECT_EQ(camera.width, 64);
    EXPECT_EQ(camera.height, 48);
    EXPECT_EQ(camera.fx, 50);
    EXPECT_EQ(camera.fy, 60);
    EXPECT_EQ(camera.position, glm::dvec3(-2, 1, -3)); // -R^T t
    EXPECT_EQ(camera.camera_to_world[0], glm::dvec3(0, -1, 0));
    EXPECT_TRUE(content.notes.empty());
    const glm::dmat3 to_camera(glm::dvec3(0, 1, 0), glm::dvec3(-1, 0, 0), glm::dvec3(0, 0, 1));
    test::expect_pixels(camera, {{50, 60, 29.5, 26}, to_camera, {1, 2, 3}});
    const test::Folder folder;
    const std::string path = folder.write("scene.npz", npz.zip.file());
    EXPECT_EQ(camera_count(path), 1U);
    EXPECT_EQ(load_scene(path).cameras[0].name, "view 0");
    npz.remove("Ks");
    npz.add("Ks", "(1, 3, 3)", {50, 0, 1e8F, 0, 60, 24, 0, 0, 1});
    EXPECT_THAT(test::complaint([&] { content_of(npz); }),
                IsSentenceWith("too far from the middle"));
}

TEST(Npz, GardenIsThePlyThatWasMadeFromIt) {
    DEGS_NEEDS_SCENE("garden-crop");
    const std::string folder = (test::scenes() / "garden-crop").string();
    const Scene ply = load_scene(folder + "/scene.ply");
    const SceneContent npz = read_npz(folder + "/test_garden.npz");
    ASSERT_EQ(npz.cloud.size(), ply.cloud.size());
    for (std::size_t i = 0; i < ply.cloud.size(); ++i) {
        ASSERT_EQ(glm::vec3(npz.cloud.means[i]), glm::vec3(ply.cloud.means[i]));
        ASSERT_NEAR(npz.cloud.scales[i].x / ply.cloud.scales[i].x, 1, 2e-5) << i;
        ASSERT_EQ(npz.cloud.scales[i].x, npz.cloud.scales[i].z);
        ASSERT_NEAR(npz.cloud.opacities[i], ply.cloud.opacities[i], 1e-6);
        ASSERT_NEAR(npz.cloud.sh_of(i)[1], ply.cloud.sh_of(i)[1], 1e-6);
    }
    ASSERT_EQ(npz.cameras.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LT(glm::length(npz.cameras[i].position - ply.cameras[i].position), 1e-5);
        EXPECT_NEAR(npz.cameras[i].fx, ply.cameras[i].fx, 1e-4);
        EXPECT_LT(
            glm::length(npz.cameras[i].camera_to_world[2] - ply.cameras[i].camera_to_world[2]),
            1e-5);
    }
    ASSERT_EQ(npz.notes.size(), 1U); // principal points are 0.19 pixels from the centre
    EXPECT_THAT(npz.notes[0], IsSentenceWith("points, not Gaussians"));
}

TEST(NearestPoints, AgreeWithEveryPair) {
    std::mt19937 random(4);
    std::vector<glm::dvec3> points;
    for (int i = 0; i < 400; ++i) { // on a lattice, so that many distances are equal
        points.emplace_back(random() % 9, random() % 9, random() % 9);
    }
    const std::vector<double> found = mean_squared_distances(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::vector<double> all;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const glm::dvec3 apart = points[i] - points[k];
            if (k != i) {
                all.push_back(glm::dot(apart, apart));
            }
        }
        std::sort(all.begin(), all.end());
        EXPECT_DOUBLE_EQ(found[i], (all[0] + all[1] + all[2]) / 3);
    }
    EXPECT_EQ(mean_squared_distances({glm::dvec3(1)}), std::vector<double>{0});
    EXPECT_EQ(mean_squared_distances({glm::dvec3(0), glm::dvec3(2, 0, 0)}),
              (std::vector<double>{4, 4}));
    const std::vector<glm::dvec3> same(100000, glm::dvec3(3)); // must not take n * n steps
    EXPECT_EQ(mean_squared_distances(same), std::vector<double>(same.size(), 0));
}

TEST(NpyArrays, OfEveryNumberType) {
    const auto value = [](const std::string& type, const std::string& bytes) {
        return parse_npy("f", "a", npy(type, "(1,)", bytes)).at(0);
    };
    EXPECT_EQ(value("<f2", std::string("\x00\xc1", 2)), -2.5);
    EXPECT_EQ(value(">f4", std::string("\x3f\xc0\0\0", 4)), 1.5);
    EXPECT_EQ(value("<f8", raw<double>({0.1})), 0.1);
    EXPECT_EQ(value("|i1", "\xff"), -1);
    EXPECT_EQ(value("|u1", "\xff"), 255);
    EXPECT_EQ(value("|b1", "\x01"), 1);
    EXPECT_EQ(value(">u2", std::string("\x01\x02", 2)), 258);
    EXPECT_EQ(value("<i4", raw<std::int32_t>({-7})), -7);
    EXPECT_EQ(value("<u8", raw<std::uint64_t>({1ULL << 40})), 1ULL << 40);
    EXPECT_EQ(parse_npy("f", "a", npy("<f4", "()", "abcd")).size(), 1U);
    EXPECT_EQ(parse_npy("f", "a", npy("<f4", "(0, 3)", "")).size(), 0U);
}

std::string mistake_in_npz(const NpzBuilder& npz) {
    return test::complaint([&] { content_of(npz); });
}

TEST(HostileNpz, ArraysThatLie) {
    const auto mistake = [](const std::string& bytes) {
        return test::complaint([&] { parse_npy("f.npz", "a", bytes); });
    };
    EXPECT_THAT(mistake("short"), IsSentenceWith("no NumPy array"));
    EXPECT_THAT(mistake(npy("<f4", "(2,)", "abcd")), IsSentenceWith("of shape (2)"));
    EXPECT_THAT(mistake(npy("<f4", "(1,)", "abcdefgh")), IsSentenceWith("of shape (1)"));
    EXPECT_THAT(mistake(npy("<f4", "(4294967296, 4294967296, 4294967296)", "")),
                IsSentenceWith("of shape"));
    EXPECT_THAT(mistake(npy("<f4", "(99999999999999999999,)", "")), IsSentenceWith("lengths"));
    EXPECT_THAT(mistake(npy("<f4", "(-1,)", "")), IsSentenceWith("lengths"));
    EXPECT_THAT(mistake(npy("<f4", "(1, 1, 1, 1, 1, 1, 1, 1, 1)", "abcd")),
                IsSentenceWith("lengths"));
    EXPECT_THAT(mistake(npy("<f4", "(1", "abcd")), IsSentenceWith("lengths"));
    EXPECT_THAT(mistake(npy("<f4", "", "abcd")), IsSentenceWith("shape"));
    EXPECT_THAT(mistake(npy("<c8", "(1,)", "abcdefgh")), IsSentenceWith("supported are"));
    EXPECT_THAT(mistake(npy("|O", "(1,)", "abcdefgh")), IsSentenceWith("supported are"));
    EXPECT_THAT(mistake(npy("<f3", "(1,)", "abc")), IsSentenceWith("supported are"));
    std::string fortran = npy("<f4", "(1,)", "abcd");
    fortran.replace(fortran.find("False"), 5, "True ");
    EXPECT_THAT(mistake(fortran), IsSentenceWith("column by column"));
    std::string longer = npy("<f4", "(1,)", "abcd");
    longer[9] = '\x7f';
    EXPECT_THAT(mistake(longer), IsSentenceWith("longer than"));
}

TEST(HostileNpz, ScenesThatLackSomething) {
    for (const char* const name : {"means", "quats", "opacities", "sh0"}) {
        NpzBuilder npz = NpzBuilder::gaussians();
        npz.remove(name);
        EXPECT_THAT(mistake_in_npz(npz), IsSentenceWith(std::string("'") + name + "'"));
    }
    NpzBuilder points = NpzBuilder::gaussians();
    points.remove("scales");
    EXPECT_THAT(mistake_in_npz(points), IsSentenceWith("neither the scales"));
    points.add("colors", "(2, 3)", {0, 0, 0, 1, 1, 1});
    EXPECT_EQ(mistake_in_npz(points), "");
    points.remove("means");
    points.add("means", "(2, 3)", {0, 0, 0, NAN, 1, 1});
    EXPECT_THAT(mistake_in_npz(points), IsSentenceWith("not finite"));
    NpzBuilder shapes = NpzBuilder::gaussians();
    shapes.remove("quats");
    shapes.add("quats", "(2, 3)", std::vector<float>(6));
    EXPECT_THAT(mistake_in_npz(shapes), IsSentenceWith("(2, 3), but (N, 4)"));
    NpzBuilder odd = NpzBuilder::gaussians();
    odd.remove("shN");
    odd.add("shN", "(2, 5, 3)", std::vector<float>(30));
    EXPECT_THAT(mistake_in_npz(odd), IsSentenceWith("6 coefficients"));
    NpzBuilder dynamic;
    dynamic.add("means3D", "(1, 1, 3)", {0, 0, 0});
    EXPECT_NE(mistake_in_npz(dynamic), "");
}

TEST(HostileNpz, CamerasThatLie) {
    const auto with = [](const std::string& name, const std::string& shape,
                         const std::vector<float>& values) {
        NpzBuilder npz = NpzBuilder::gaussians();
        npz.add_cameras();
        npz.remove(name);
        npz.add(name, shape, values);
        return mistake_in_npz(npz);
    };
    EXPECT_THAT(with("width", "()", {0}), IsSentenceWith("'width' must hold"));
    EXPECT_THAT(with("width", "()", {NAN}), IsSentenceWith("'width' must hold"));
    EXPECT_THAT(with("height", "()", {1e9F}), IsSentenceWith("'height' must hold"));
    EXPECT_THAT(with("width", "(2,)", {64, 64}), IsSentenceWith("'width' holds 2 numbers"));
    EXPECT_THAT(with("height", "(0,)", {}), IsSentenceWith("'height' must hold"));
    EXPECT_THAT(with("Ks", "(1, 9)", std::vector<float>(9)), IsSentenceWith("(C, 3, 3)"));
    EXPECT_THAT(with("Ks", "(1, 3, 3)", std::vector<float>(9)), IsSentenceWith("focal"));
    EXPECT_THAT(with("Ks", "(2, 3, 3)", std::vector<float>(18, 1)), IsSentenceWith("2 'Ks'"));
    EXPECT_THAT(with("viewmats", "(1, 4, 4)", std::vector<float>(16, 1)),
                IsSentenceWith("no rotation"));
    EXPECT_THAT(with("viewmats", "(1, 4, 4)", std::vector<float>(16, NAN)),
                IsSentenceWith("no rotation"));
}

TEST(HostileNpz, DamagedArchivesLoadOrComplain) {
    NpzBuilder npz = NpzBuilder::gaussians();
    npz.add_cameras();
    for (const bool deflated : {false, true}) {
        npz.zip.deflated = deflated;
        const std::string good = npz.zip.file();
        const test::Folder folder;
        int refused = 0;
        const auto attempt = [&](const std::string& bytes) {
            const std::string path = folder.write("bad.npz", bytes);
            const std::string sentence = test::complaint([&] { read_npz(path); });
            refused += sentence.empty() ? 0 : 1;
            ASSERT_TRUE(sentence.empty() || testing::Value(sentence, IsSentenceWith("bad.npz: ")))
                << sentence;
        };
        for (std::size_t size = 0; size < good.size(); size += 61) {
            attempt(good.substr(0, size));
        }
        std::mt19937 random(9);
        for (int i = 0; i < 200; ++i) {
            std::string bytes = good;
            char& byte = bytes[random() % bytes.size()];
            byte = static_cast<char>(byte ^ 1 << random() % 8);
            attempt(bytes);
        }
        EXPECT_GT(refused, 60);
    }
}

} // namespace
} // namespace degs
