// SPDX-License-Identifier: Apache-2.0
// Hard case H16: a wide view from one place, turned, in either order.
#include <algorithm>
#include <cmath>

#include "accuracy/hard/hard_builder.hpp"
#include "splat/frame/rendering_rules.hpp"

namespace degs {
namespace {

constexpr double kWideFocal = 0.25; ///< widths: 127 degrees from edge to edge
constexpr double kTurns[] = {0, 25};
constexpr double kDegreeInRadians = 0.017453292519943295;

/// About the vertical axis.
glm::dmat3 turned_view(double degrees) {
    const double c = std::cos(degrees * kDegreeInRadians);
    const double s = std::sin(degrees * kDegreeInRadians);
    return {{c, 0, -s}, {0, 1, 0}, {s, 0, c}};
}

/// Rings of overlapping splats whose order by z is the opposite of that by distance.
void add_rings(HardBuilder& builder) {
    const Camera& camera = builder.scene.camera;
    for (int ring = 0; ring < 8; ++ring) {
        for (int i = 0; i < 40; ++i) {
            const double angle = 2 * 3.14159265358979 * (i + 0.1 * ring) / 40;
            const double slope =
                0.15 + 0.2 * ring + 0.01 * (i % 5); // x/z, from near the axis outwards
            const double z = 12 - 0.9 * ring - 0.03 * (i % 7);
            const double size = 14 * z / camera.fx;
            builder.add_world({slope * z * std::cos(angle), 0.5 * slope * z * std::sin(angle), z},
                              {size, 0.5 * size, 0.3 * size}, {1, 0.1 * ring, 0.2, 0.1 * (i % 3)},
                              0.7, {0.1 * (i % 10), 0.12 * ring, 0.5});
        }
    }
}

} // namespace

std::vector<HardScene> make_order_case(int width, int height) {
    std::vector<HardScene> scenes;
    for (const SplatOrder order : {SplatOrder::Depth, SplatOrder::Distance}) {
        for (const double degrees : kTurns) {
            HardBuilder builder(width, height);
            builder.scene.camera.fx = builder.scene.camera.fy = kWideFocal * width;
            builder.scene.camera.position = {0.5, -0.25, 1};
            add_rings(builder);
            for (glm::dvec3& mean : builder.scene.cloud.means) {
                mean += builder.scene.camera.position;
            }
            builder.scene.camera.camera_to_world = turned_view(degrees);
            builder.scene.projection.order = order;
            // Turned by 25 degrees, the view sees what was far to the right; some is gone.
            const FrameWorkload seen =
                make_frame_workload(builder.scene.cloud, builder.scene.camera, 32, TileMode::Exact);
            builder.scene.culled = seen.culled;
            builder.look(0.8 * width, builder.middle_y(), 60);
            builder.look(0.55 * width, builder.middle_y() + 20, 60);
            scenes.push_back(std::move(builder.scene));
        }
    }
    return scenes;
}

std::string check_order_case(const HardScene& scene, const FrameWorkload& workload) {
    const bool by_distance = scene.projection.order == SplatOrder::Distance;
    const auto key = [&](std::uint32_t id) {
        const glm::dvec3 offset = scene.cloud.means[id] - scene.camera.position;
        return static_cast<float>(by_distance ? glm::length(offset)
                                              : glm::dot(scene.camera.camera_to_world[2], offset));
    };
    std::vector<std::uint32_t> wanted = workload.visible_of;
    std::stable_sort(wanted.begin(), wanted.end(),
                     [&key](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        // Keys a unit of single precision apart may change places.
        if (std::abs(key(workload.splats[i].id) - key(wanted[i])) > 1e-6F * key(wanted[i])) {
            return "Splat " + std::to_string(i) + " is not the next one by " +
                   name_of(scene.projection.order) + ".";
        }
    }
    FrameWorkload other = workload;
    other.projection.order = by_distance ? SplatOrder::Depth : SplatOrder::Distance;
    other = make_frame_workload(scene.cloud, scene.camera, workload.tile_size, workload.tile_mode,
                                other.projection);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        moved += workload.splats[i].id != other.splats[i].id ? 1 : 0;
    }
    return 2 * moved > wanted.size() ? "" : "Both orders are nearly the same.";
}

} // namespace degs
