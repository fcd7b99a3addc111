// SPDX-License-Identifier: Apache-2.0
// Pictures of one scene through PLY and SPZ: as far apart as rounding to the codes of SPZ explains.
#include <cmath>
#include <random>

#include "accuracy/image_difference.hpp"
#include "scene/scene.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

Image picture(const Scene& scene, const GaussianCloud& cloud) {
    ReferenceCounts counts;
    return render_reference(make_frame_workload(cloud, scene.cameras.at(0), 16, TileMode::Exact),
                            counts);
}

double root_mean_square(const Image& a, const Image& b) {
    double squares = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        squares += (a.rgb[i] - b.rgb[i]) * (a.rgb[i] - b.rgb[i]);
    }
    return std::sqrt(squares / static_cast<double>(a.rgb.size()));
}

/// Every value moved by up to half a step of its code, at random.
GaussianCloud shaken(const GaussianCloud& cloud, bool version_2, unsigned seed) {
    std::mt19937 random(seed);
    const auto half = [&](double step) {
        return std::uniform_real_distribution<double>(-step / 2, step / 2)(random);
    };
    GaussianCloud moved = cloud;
    const double turn = version_2 ? 1 / 127.5 : std::sqrt(0.5) / 511;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        glm::dvec4 q(moved.rotations[i]);
        for (int axis = 0; axis < 3; ++axis) {
            moved.means[i][axis] += half(1.0 / 4096);
            moved.scales[i][axis] *= static_cast<float>(std::exp(half(1.0 / 16)));
            q[axis + 1] += half(turn);
        }
        q.x += version_2 ? half(turn / std::max(0.1, std::abs(q.x))) : half(turn);
        moved.rotations[i] = glm::normalize(q);
        moved.opacities[i] = std::min(
            1.0F, std::max(0.0F, moved.opacities[i] + static_cast<float>(half(1.0 / 255))));
    }
    for (std::size_t k = 0; k < moved.sh.size(); ++k) {
        moved.sh[k] += static_cast<float>(half(k % 48 < 3 ? 1 / 255.0 / 0.15 : 1 / 128.0));
    }
    return moved;
}

TEST(SpzPictures, DifferFromThePlyAsRoundingDoes) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const std::string folder = (test::scenes() / "fruit-drops").string();
    const Scene ply = load_scene(folder + "/scene.ply");
    const Image wanted = picture(ply, ply.cloud);
    for (const bool version_2 : {true, false}) {
        const Scene spz = load_scene(folder + (version_2 ? "/scene-v2.spz" : "/scene-v3.spz"));
        double rounding = 0;
        for (const unsigned seed : {1U, 2U, 3U}) {
            rounding = std::max(
                rounding,
                root_mean_square(wanted, picture(ply, shaken(ply.cloud, version_2, seed))));
        }
        const double error = root_mean_square(wanted, picture(spz, spz.cloud));
        RecordProperty(version_2 ? "version_2" : "version_3",
                       std::to_string(error) + " of " + std::to_string(rounding));
        EXPECT_LT(error, 1.5 * rounding);
        EXPECT_GT(error, 0);
        const Scene unturned = load_scene(spz.source + "?axes=rdf"); // the wrong axes are seen
        EXPECT_GT(root_mean_square(wanted, picture(ply, unturned.cloud)), 20 * rounding);
    }
}

} // namespace
} // namespace degs
