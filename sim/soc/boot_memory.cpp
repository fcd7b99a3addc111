// SPDX-License-Identifier: Apache-2.0
#include "sim/soc/boot_memory.hpp"

#include <algorithm>
#include <cstring>
#include <string>

#include "degs/error.hpp"
#include "driver/firmware/map.h"
#include "platform/scene_copy.hpp"

namespace degs::sim {
namespace {

constexpr std::uint64_t kPage = 4096;

view view_of(const Camera& camera) {
    view to{};
    to.width = static_cast<std::uint32_t>(camera.width);
    to.height = static_cast<std::uint32_t>(camera.height);
    to.origin_x = static_cast<std::uint32_t>(camera.origin.x);
    to.origin_y = static_cast<std::uint32_t>(camera.origin.y);
    to.shift_x = camera.shift.x;
    to.shift_y = camera.shift.y;
    to.focal_x = camera.fx;
    to.focal_y = camera.fy;
    for (int axis = 0; axis < 3; ++axis) {
        for (int i = 0; i < 3; ++i) {
            to.axes[3 * axis + i] = camera.camera_to_world[axis][i];
        }
        to.position[axis] = camera.position[axis];
    }
    return to;
}

/// Gives out pages of the shared memory, one after the other.
class Pages {
public:
    explicit Pages(std::uint64_t capacity)
        : end_(std::min(capacity, (std::uint64_t{1} << 32U) - BOOT_TABLE)) {}
    /// The offset of the reserved bytes.
    std::uint64_t reserve(std::uint64_t bytes) {
        const std::uint64_t size = (bytes + kPage - 1) / kPage * kPage;
        if (size > rest()) {
            throw InputError(
                "The scene does not fit into the memory that a core of 32 bits sees: " +
                std::to_string(size - rest()) + " bytes are missing.");
        }
        next_ += size;
        return next_ - size;
    }
    std::uint64_t rest() const { return end_ - next_; }

private:
    std::uint64_t next_ = 0, end_;
};

std::uint32_t address_of(std::uint64_t offset) {
    return static_cast<std::uint32_t>(BOOT_TABLE + offset);
}

} // namespace

BootMap boot_map() {
    static_assert(EXIT == CONSOLE + 4, "one device has both");
    return {REGISTERS, CONSOLE, BOOT_TABLE};
}

std::vector<unsigned char> boot_memory(const GaussianCloud& cloud, const Camera& camera,
                                       std::uint64_t capacity) {
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(cloud, geometry, sh);
    Pages pages(capacity);
    boot_table table{};
    pages.reserve(sizeof table);
    const std::uint64_t geometry_at = pages.reserve(geometry.size());
    const std::uint64_t sh_at = pages.reserve(sh.size());
    table.views[table.frames++] = view_of(camera);
    table.geometry = address_of(geometry_at);
    table.sh = address_of(sh_at);
    table.count = static_cast<std::uint32_t>(cloud.size());
    table.sh_degree = static_cast<std::uint32_t>(cloud.sh_degree);
    table.frame_buffer = address_of(pages.reserve(camera.pixels() * 4));
    table.workspace_bytes = static_cast<std::uint32_t>(pages.rest());
    table.workspace = address_of(pages.reserve(pages.rest()));
    std::vector<unsigned char> bytes(sh_at + sh.size());
    std::memcpy(bytes.data(), &table, sizeof table);
    std::copy(geometry.begin(), geometry.end(), bytes.begin() + geometry_at);
    std::copy(sh.begin(), sh.end(), bytes.begin() + sh_at);
    return bytes;
}

} // namespace degs::sim
