// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/stored_gaussians.hpp"

#include <algorithm>
#include <vector>

namespace degs {
namespace {

constexpr std::size_t kSamples = 4096;

/// The origin of means on one axis.
double origin_on(const GaussianCloud& cloud, int axis) {
    const std::size_t step = std::max<std::size_t>(1, cloud.size() / kSamples);
    std::vector<double> samples;
    for (std::size_t i = 0; i < cloud.size(); i += step) {
        samples.push_back(cloud.means[i][axis]);
    }
    if (samples.empty()) {
        return 0;
    }
    std::sort(samples.begin(), samples.end());
    const std::size_t margin = samples.size() / 100;
    const bool around = samples[margin] <= 0 && samples[samples.size() - 1 - margin] >= 0;
    return around ? 0 : samples[samples.size() / 2];
}

} // namespace

StoredGaussians::StoredGaussians(const GaussianCloud& cloud, const ProjectionNumbers& numbers)
    : cloud_(cloud), as_they_are_(numbers.scale.is_fp64() && numbers.rotation.is_fp64() &&
                                  numbers.opacity.is_fp64()),
      rounds_means_(!numbers.mean.is_fp64()),
      rounds_sh_(!numbers.sh_dc.is_fp64() || !numbers.sh_rest.is_fp64()), mean_(numbers.mean),
      scale_(numbers.scale), rotation_(numbers.rotation), opacity_(numbers.opacity),
      sh_dc_(numbers.sh_dc), sh_rest_(numbers.sh_rest), most_scale_(numbers.scale.max()),
      most_sh_dc_(numbers.sh_dc.max()), most_sh_rest_(numbers.sh_rest.max()) {
    if (rounds_means_) {
        origin_ = {origin_on(cloud, 0), origin_on(cloud, 1), origin_on(cloud, 2)};
    }
}

glm::dvec3 StoredGaussians::rounded_mean(std::size_t index) const {
    const glm::dvec3 from = cloud_.means[index] - origin_;
    return origin_ + glm::dvec3(mean_(from.x), mean_(from.y), mean_(from.z));
}

const float* StoredGaussians::sh(std::size_t index, Sh& room) const {
    const float* const given = cloud_.sh_of(index);
    if (!rounds_sh_) {
        return given;
    }
    const int count = 3 * cloud_.sh_coefficients();
    for (int i = 0; i < count; ++i) {
        const double rounded = i < 3 ? sh_dc_(given[i]) : sh_rest_(given[i]);
        const double most = i < 3 ? most_sh_dc_ : most_sh_rest_;
        room[i] = static_cast<float>(std::clamp(rounded, -most, most));
    }
    return room.data();
}

} // namespace degs
