// SPDX-License-Identifier: Apache-2.0
#include "scene/splat_file/splat_file.hpp"

#include <algorithm>
#include <cmath>

#include "base/byte_order.hpp"
#include "scene/files/input_file.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr std::size_t kRecordBytes = 32;
constexpr std::size_t kBlockRecords = 1 << 15;

float float_at(const char* bytes) {
    return load_value<float>(bytes, host_is_big_endian());
}

int byte_at(const char* bytes) {
    return static_cast<unsigned char>(*bytes);
}

void append_record(const char* bytes, GaussianCloud& cloud) {
    cloud.means.emplace_back(float_at(bytes), float_at(bytes + 4), float_at(bytes + 8));
    cloud.scales.emplace_back(float_at(bytes + 12), float_at(bytes + 16), float_at(bytes + 20));
    for (int channel = 0; channel < 3; ++channel) {
        cloud.sh.push_back(
            static_cast<float>((byte_at(bytes + 24 + channel) / 255.0 - 0.5) / kShY0));
    }
    cloud.opacities.push_back(static_cast<float>(byte_at(bytes + 27) / 255.0));
    glm::vec4 rotation;
    for (int i = 0; i < 4; ++i) {
        rotation[i] = static_cast<float>(byte_at(bytes + 28 + i) - 128) / 128;
    }
    cloud.rotations.push_back(rotation);
}

/// Numbers that a scene can hold; random bytes rarely do.
bool plausible(const GaussianCloud& cloud, std::size_t i) {
    constexpr double kFar = 1e9;
    const glm::dvec3& mean = cloud.means[i];
    const glm::vec3& scale = cloud.scales[i];
    bool good = glm::dot(cloud.rotations[i], cloud.rotations[i]) > 0;
    for (int axis = 0; axis < 3; ++axis) {
        good = good && std::abs(mean[axis]) < kFar && scale[axis] >= 0 && scale[axis] < kFar;
    }
    return good;
}

} // namespace

SceneContent read_splat_file(const std::string& path) {
    InputFile file(path);
    if (file.size() % kRecordBytes != 0) {
        fail_file(path, "a .splat file holds 32 bytes per Gaussian, but " +
                            std::to_string(file.size()) +
                            " bytes are no multiple of 32; the file is truncated or of another "
                            "format.");
    }
    const std::size_t count = file.size() / kRecordBytes;
    SceneContent content;
    GaussianCloud& cloud = content.cloud;
    cloud.means.reserve(count);
    cloud.scales.reserve(count);
    cloud.rotations.reserve(count);
    cloud.opacities.reserve(count);
    cloud.sh.reserve(3 * count);
    std::vector<char> block(std::min(count, kBlockRecords) * kRecordBytes);
    std::size_t good = 0;
    for (std::size_t first = 0; first < count; first += kBlockRecords) {
        const std::size_t records = std::min(kBlockRecords, count - first);
        file.read_exactly(block.data(), records * kRecordBytes);
        for (std::size_t i = 0; i < records; ++i) {
            append_record(block.data() + i * kRecordBytes, cloud);
            good += plausible(cloud, first + i) ? 1 : 0;
        }
    }
    if (2 * good <= count) {
        fail_file(path, "only " + std::to_string(good) + " of " + std::to_string(count) +
                            " records of 32 bytes can be Gaussians, so this is no .splat file.");
    }
    return content;
}

} // namespace degs
