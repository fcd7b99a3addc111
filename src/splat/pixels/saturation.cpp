// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/saturation.hpp"

#include <cmath>

#include "splat/pixels/quantized_row.hpp"

namespace degs {
namespace {

/// Counts the splats of one field.
class Field {
public:
    Field(const char* stage, const NumberFormat& format)
        : found_{stage, format.name(), format.max(), 0} {}
    bool beyond(double value) const { return !(std::abs(value) < found_.limit); }
    void count(bool is_beyond) { found_.splats += is_beyond ? 1 : 0; }
    const Saturation& found() const { return found_; }

private:
    Saturation found_;
};

std::vector<Saturation> saturated_stages(const NumberSet& set, const FrameWorkload& frame) {
    const QuantizedRow row(set);
    Field mean("mean", set.mean), slope("slope", set.slope), c_prime("c_prime", set.c_prime);
    Field radius("radius", set.radius), inverse("inverse_radius2", set.inverse_radius2);
    Field conic("conic", set.conic), threshold("q_threshold", set.q_threshold);
    Field colour("colour", set.colour);
    const bool stores_c_prime = set.vertical != Vertical::FromRatio;
    constexpr double kHalfPixel2 = 0.25; // px^2
    for (const ProjectedSplat& splat : frame.splats) {
        const QuantizedSplat record = row.record(splat);
        mean.count(mean.beyond(record.mean_x) || mean.beyond(record.mean_y));
        slope.count(slope.beyond(record.slope));
        c_prime.count(stores_c_prime && c_prime.beyond(record.c_prime));
        radius.count(radius.beyond(record.radius));
        inverse.count(inverse.beyond(record.inverse_radius2) &&
                      splat.cov_c * splat.q_end() >= kHalfPixel2);
        conic.count(conic.beyond(record.a));
        threshold.count(threshold.beyond(record.q_threshold));
        colour.count(colour.beyond(record.colour[0]) || colour.beyond(record.colour[1]) ||
                     colour.beyond(record.colour[2]));
    }
    std::vector<Saturation> found;
    for (const Field* field :
         {&mean, &slope, &c_prime, &radius, &inverse, &conic, &threshold, &colour}) {
        if (field->found().splats != 0) {
            found.push_back(field->found());
        }
    }
    return found;
}

} // namespace

std::vector<Saturation> saturated_stages(const DataPathOptions& options,
                                         const FrameWorkload& frame) {
    if (options.set) {
        return saturated_stages(*options.set, frame);
    }
    switch (options.numbers) {
    case Arithmetic::Fp32:
    case Arithmetic::Fp64:
    case Arithmetic::Ideal:
        return {};
    default:
        return saturated_stages(number_set(name_of(options.numbers)), frame);
    }
}

} // namespace degs
