// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <vector>

#include "base/byte_order.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"

namespace degs {
namespace {

constexpr double kLowest = -110; ///< exp and sigmoid of it round to 0 in float
constexpr double kHighest = 20;  ///< sigmoid of it rounds to 1 in float

std::string header_of(const GaussianCloud& cloud) {
    std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex " +
                         std::to_string(cloud.size()) + "\n";
    const auto declare = [&](const std::string& name) {
        header += "property float " + name + "\n";
    };
    const auto declare_many = [&](const std::string& prefix, int count) {
        for (int i = 0; i < count; ++i) {
            declare(prefix + std::to_string(i));
        }
    };
    for (const char* const name : {"x", "y", "z", "nx", "ny", "nz"}) {
        declare(name);
    }
    declare_many("f_dc_", 3);
    declare_many("f_rest_", 3 * (cloud.sh_coefficients() - 1));
    declare("opacity");
    declare_many("scale_", 3);
    declare_many("rot_", 4);
    return header + "end_header\n";
}

float bounded_log(double value) {
    return static_cast<float>(std::max(std::log(value), kLowest));
}

float logit(double opacity) {
    return static_cast<float>(
        std::clamp(std::log(opacity) - std::log1p(-opacity), kLowest, kHighest));
}

/// All values of a row in the order of the header.
void append_row(const GaussianCloud& cloud, std::size_t i, std::vector<float>& row) {
    const glm::vec3 mean(cloud.means[i]);
    row.insert(row.end(), {mean.x, mean.y, mean.z, 0, 0, 0});
    const float* const sh = cloud.sh_of(i);
    row.insert(row.end(), sh, sh + 3);
    for (int channel = 0; channel < 3; ++channel) {
        for (int k = 1; k < cloud.sh_coefficients(); ++k) {
            row.push_back(sh[k * 3 + channel]);
        }
    }
    row.push_back(logit(cloud.opacities[i]));
    for (int axis = 0; axis < 3; ++axis) {
        row.push_back(bounded_log(cloud.scales[i][axis]));
    }
    const glm::vec4& q = cloud.rotations[i];
    row.insert(row.end(), {q.x, q.y, q.z, q.w});
}

void write_values(std::ostream& out, std::vector<float>& values) {
    if (host_is_big_endian()) {
        for (float& value : values) {
            value = load_value<float>(reinterpret_cast<const char*>(&value), true);
        }
    }
    out.write(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
    values.clear();
}

} // namespace

void write_ply(const GaussianCloud& cloud, const std::string& path) {
    constexpr std::size_t kBlock = 1 << 18; // values
    write_whole(path, [&](std::ostream& out) {
        out << header_of(cloud);
        std::vector<float> values;
        for (std::size_t i = 0; i < cloud.size(); ++i) {
            append_row(cloud, i, values);
            if (values.size() >= kBlock) {
                write_values(out, values);
            }
        }
        write_values(out, values);
    });
}

} // namespace degs
