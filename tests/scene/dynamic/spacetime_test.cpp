// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic/spacetime.hpp"

#include <cmath>
#include <cstring>
#include <limits>

#include "scene/dynamic/spacetime_ply.hpp"
#include "scene/dynamic/synthetic_dynamic.hpp"
#include "scene/dynamic_scene.hpp"
#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

/// A Gaussian that does everything at once.
SpacetimeGaussian busy() {
    SpacetimeGaussian g;
    g.mean = {1, 2, 3};
    g.centre = 0.25F;
    g.log_duration = std::log(0.5F);
    g.motion[0] = {4, 0, 0};
    g.motion[1] = {0, 16, 0};
    g.motion[2] = {0, 0, 64};
    g.rgb = {0.5F, 1, 0};
    g.opacity = 0; // one half
    g.log_scale = {0, std::log(2.0F), std::log(0.5F)};
    g.rotation = {1, 0, 0, 0};
    g.omega = {0, 0, 0, 4};
    return g;
}

TEST(Spacetime, FollowsItsFormulas) {
    const GaussianCloud there = at_time({busy()}, 0.25);
    EXPECT_EQ(there.means[0], glm::dvec3(1, 2, 3));
    EXPECT_FLOAT_EQ(there.opacities[0], 0.5F);
    EXPECT_EQ(there.rotations[0], glm::vec4(1, 0, 0, 0));
    const GaussianCloud later = at_time({busy()}, 0.5); // d = 1/4
    EXPECT_EQ(later.means[0], glm::dvec3(2, 3, 4));
    EXPECT_NEAR(later.opacities[0], 0.5 * std::exp(-0.25), 1e-7);
    const float half = std::sqrt(0.5F);
    EXPECT_LT(glm::length(later.rotations[0] - glm::vec4(half, 0, 0, half)), 1e-6F);
    EXPECT_FLOAT_EQ(later.scales[0].y, 2);
    EXPECT_FLOAT_EQ(later.scales[0].z, 0.5F);
    EXPECT_EQ(later.sh_degree, 0);
    constexpr double kY0 = 0.28209479177387814;
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_NEAR(0.5 + kY0 * later.sh[channel], busy().rgb[channel], 1e-6);
    }
    EXPECT_EQ(at_time({busy()}, 0).means[0], glm::dvec3(0, 3, 2)); // d = -1/4
}

TEST(Spacetime, WritesWhatItReads) {
    const test::Folder folder;
    const SpacetimeCloud scene = make_spacetime({"dynamic", 500, 3, {}});
    write_spacetime_ply(scene, folder.path("s.ply"));
    EXPECT_TRUE(is_spacetime_ply(folder.path("s.ply")));
    const SpacetimeCloud read = read_spacetime_ply(folder.path("s.ply"));
    ASSERT_EQ(read.size(), 500U);
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(std::memcmp(&read[i], &scene[i], sizeof read[i]), 0) << i;
    }
    const Scene at_half = load_scene(folder.path("s.ply") + "?time=0.5");
    const Scene synthetic = load_scene("synthetic:dynamic,gaussians=500,seed=3,time=0.5");
    EXPECT_EQ(at_half.cloud.means, synthetic.cloud.means);
    EXPECT_EQ(at_half.cloud.opacities, synthetic.cloud.opacities);
    EXPECT_NE(load_scene(folder.path("s.ply")).cloud.means, synthetic.cloud.means);
}

TEST(Spacetime, IsCutIntoAsManyFramesAsItsNameSays) {
    const test::Folder folder;
    write_spacetime_ply(make_spacetime({"dynamic", 100, 3, {}}), folder.path("s.ply"));
    for (const int frames : {1, 7, 300}) {
        const std::string number = std::to_string(frames);
        for (const std::string& spec :
             {folder.path("s.ply") + "?frames=" + number,
              "synthetic:dynamic,gaussians=100,seed=3,frames=" + number}) {
            const auto dynamic = open_dynamic_scene(spec);
            ASSERT_NE(dynamic, nullptr) << spec;
            ASSERT_EQ(dynamic->frames(), frames) << spec;
            const double last = (frames - 1.0) / frames;
            GaussianCloud wanted = at_time(make_spacetime({"dynamic", 100, 3, {}}), last);
            EXPECT_EQ(dynamic->frame(frames - 1).means, wanted.means) << spec;
        }
    }
    EXPECT_EQ(load_scene(folder.path("s.ply") + "?frames=7").cloud.means,
              load_scene(folder.path("s.ply")).cloud.means);
    write_ply(make_synthetic({"object", 50, 1}).cloud, folder.path("still.ply"));
    EXPECT_THAT(test::complaint([&] { load_scene(folder.path("still.ply") + "?frames=7"); }),
                test::IsSentenceWith("not a function of time; '?frames='"));
    EXPECT_THAT(test::complaint([] { parse_synthetic("object,frames=7"); }),
                test::IsSentenceWith("frames=N of 'dynamic'"));
}

TEST(HostileSpacetime, BytesBehindTheLastRow) {
    const test::Folder folder;
    const std::string path = folder.path("s.ply");
    write_spacetime_ply(make_spacetime({"dynamic", 100, 3, {}}), path);
    std::string bytes = test::bytes_of(path);
    const std::string end = "end_header\n";
    bytes.insert(bytes.find(end) + end.size(), 1, '\r');
    folder.write("s.ply", bytes);
    EXPECT_THAT(test::complaint([&] { load_scene(path); }),
                test::IsSentenceWith("1 byte(s) are left over"));
}

TEST(Spacetime, SyntheticSceneMovesInPartsAndStaysInParts) {
    const auto dynamic = open_dynamic_scene("synthetic:dynamic,gaussians=4000");
    ASSERT_NE(dynamic, nullptr);
    ASSERT_EQ(dynamic->frames(), kFramesOfScene);
    const GaussianCloud first = dynamic->frame(0);
    const GaussianCloud last = dynamic->frame(kFramesOfScene - 1);
    ASSERT_EQ(first.size(), 4000U);
    ASSERT_EQ(last.size(), 4000U);
    int still = 0;
    int moved = 0;
    int faded = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        still += first.means[i] == last.means[i] ? 1 : 0;
        moved += glm::length(first.means[i] - last.means[i]) > 0.3 ? 1 : 0;
        faded += std::abs(first.opacities[i] - last.opacities[i]) > 0.01F ? 1 : 0;
    }
    EXPECT_NEAR(still, 0.64 * 4000, 0.03 * 4000); // table, wall and things
    EXPECT_GT(moved, 0.15 * 4000);
    EXPECT_GT(faded, 0.01 * 4000);
    EXPECT_EQ(open_dynamic_scene("synthetic:dynamic,time=0.5"), nullptr); // says when
    EXPECT_EQ(open_dynamic_scene("synthetic:object"), nullptr);
    EXPECT_EQ(load_scene("synthetic:dynamic,gaussians=4000").cloud.means, first.means);
}

TEST(HostileSpacetime, EveryMistakeHasItsSentence) {
    const test::Folder folder;
    const std::string good = folder.path("good.ply");
    write_spacetime_ply({busy()}, good);
    const std::string bytes = test::bytes_of(good);
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string changed = bytes;
        changed.replace(changed.find(from), from.size(), to);
        return folder.write("bad.ply", changed);
    };
    const auto complain = [](const std::string& spec) {
        return test::complaint([&] { load_scene(spec); });
    };
    EXPECT_THAT(complain(with("omega_3", "omega_4")),
                IsSentenceWith("needs the scalar properties 'omega_3'"));
    EXPECT_THAT(complain(with("float nz", "float f_t_0")),
                IsSentenceWith("supported are its lite model and sequences"));
    EXPECT_THAT(complain(with("vertex 1\n", "vertex 2\n")), IsSentenceWith("bad.ply: "));
    EXPECT_THAT(complain(with("vertex 1\n", "vertex 99999999999\n")), IsSentenceWith("bad.ply: "));
    EXPECT_THAT(complain(with("vertex 1\n", "vertex 0\n")), IsSentenceWith("."));
    EXPECT_THAT(complain(folder.write("cut.ply", bytes.substr(0, bytes.size() - 3))),
                IsSentenceWith("cut.ply: "));
    for (const char* time : {"2", "-0.1", "x", "nan", ""}) {
        EXPECT_THAT(complain(good + "?time=" + time),
                    IsSentenceWith("must be a number from 0 to 1"));
    }
    write_ply(at_time({busy()}, 0), folder.path("static.ply"));
    EXPECT_THAT(complain(folder.path("static.ply") + "?time=0.5"),
                IsSentenceWith("not a function of time"));
    EXPECT_THAT(complain("synthetic:dynamic,time=2"), IsSentenceWith("from 0 to 1"));
    EXPECT_THAT(complain("synthetic:object,time=0.5"), IsSentenceWith("no setting"));
    SpacetimeGaussian broken = busy();
    broken.omega.y = std::numeric_limits<float>::infinity();
    write_spacetime_ply({busy(), broken}, good);
    EXPECT_EQ(load_scene(good).cloud.size(), 1U);
    EXPECT_THAT(load_scene(good).notes.at(0), IsSentenceWith("1 Gaussians hold NaN or infinity"));
}

// Scales and opacities have notes of their own.
TEST(Spacetime, ActivatedValuesAreAWarning) {
    const auto notes = [](float side, float scale, float opacity) {
        SpacetimeCloud scene(40, busy());
        for (std::size_t i = 0; i < scene.size(); ++i) {
            scene[i].mean = {side * static_cast<float>(i) / 40, 0, 0};
            scene[i].log_scale = glm::vec3(scale);
            scene[i].opacity = opacity;
        }
        const test::Folder folder;
        write_spacetime_ply(scene, folder.path("s.ply"));
        std::string all;
        for (const std::string& note : load_scene(folder.path("s.ply")).notes) {
            all += note;
        }
        return all;
    };
    using testing::HasSubstr;
    using testing::Not;
    EXPECT_THAT(notes(2, 0.3F, 3), HasSubstr("hold its scales as they are"));
    EXPECT_THAT(notes(300, 0.02F, 3), HasSubstr("hold its scales as they are"));
    EXPECT_THAT(notes(300, 1.5F, 3), Not(HasSubstr("as they are")));
    EXPECT_THAT(notes(300, 1.5F, 0.5F), HasSubstr("hold its opacities as they are"));
    EXPECT_THAT(notes(2, 0.3F, 0.5F), HasSubstr("hold both as they are"));
    EXPECT_THAT(notes(2, -3, -2), Not(HasSubstr("as they are")));
}

} // namespace
} // namespace degs
