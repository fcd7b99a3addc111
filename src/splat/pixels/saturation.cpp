// SPDX-License-Identifier: Apache-2.0
#include "splat/pixels/saturation.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "splat/frame/pixel_rules.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {
namespace {

/// Counts the splats of one field.
class Field {
public:
    Field(const char* stage, const NumberFormat& format)
        : found_{stage, format.name(), format.max(), 0} {}
    bool beyond(double value) const { return !(std::abs(value) < found_.limit); }
    bool count(bool is_beyond) {
        found_.splats += is_beyond ? 1 : 0;
        return is_beyond;
    }
    const Saturation& found() const { return found_; }

private:
    Saturation found_;
};

double brightest(const QuantizedSplat& record) {
    return std::max(
        {std::abs(record.colour[0]), std::abs(record.colour[1]), std::abs(record.colour[2])});
}

/// The splat record.
class RecordFields {
public:
    explicit RecordFields(const NumberSet& set)
        : mean_("mean", set.mean), slope_("slope", set.slope), c_prime_("c_prime", set.c_prime),
          radius_("radius", set.radius), inverse_("inverse_radius2", set.inverse_radius2),
          conic_("conic", set.conic), threshold_("q_threshold", set.q_threshold),
          colour_("colour", set.colour), stores_c_prime_(set.vertical != Vertical::FromRatio) {}

    /// Whether a field of the record is beyond its format.
    bool count(const ProjectedSplat& splat, const QuantizedSplat& record) {
        constexpr double kHalfPixel2 = 0.25; // px^2
        bool any = mean_.count(mean_.beyond(record.mean_x) || mean_.beyond(record.mean_y));
        any |= slope_.count(slope_.beyond(record.slope));
        any |= c_prime_.count(stores_c_prime_ && c_prime_.beyond(record.c_prime));
        any |= radius_.count(radius_.beyond(record.radius));
        any |= inverse_.count(inverse_.beyond(record.inverse_radius2) &&
                              splat.cov_c * splat.q_end() >= kHalfPixel2);
        any |= conic_.count(conic_.beyond(record.a));
        any |= threshold_.count(threshold_.beyond(record.q_threshold));
        return colour_.count(colour_.beyond(brightest(record))) || any;
    }
    std::vector<const Field*> all() const {
        return {&mean_, &slope_, &c_prime_, &radius_, &inverse_, &conic_, &threshold_, &colour_};
    }

private:
    Field mean_, slope_, c_prime_, radius_, inverse_, conic_, threshold_, colour_;
    bool stores_c_prime_;
};

/// What Span Units and PEs make of a record: the largest values that pixels of the splat inside the
/// image need, each found from the ellipse.
class RowFields {
public:
    RowFields(const NumberSet& set, const FrameWorkload& frame)
        : frame_(frame), from_start_(set.base == Base::Start), distance_("distance", set.distance),
          edge_("edge", set.edge), g0_("g0", set.g0), d0_("d0", set.d0), term_("term", set.term),
          weight_("weight", set.weight) {}

    void count(const ProjectedSplat& splat, const QuantizedSplat& record) {
        const PixelBox image = frame_.camera.window();
        const double wide = std::sqrt(splat.q_end() * splat.cov_a);
        const double high = std::sqrt(splat.q_end() * splat.cov_c);
        const double columns = farthest(splat.mu_x, image.x0, image.x1);
        const double rows = farthest(splat.mu_y, image.y0, image.y1);
        distance_.count(distance_.beyond(std::min(high, rows)) ||
                        distance_.beyond(std::min(record.radius, columns)));
        edge_.count(edge_.beyond(std::min(std::abs(record.mean_x) + wide,
                                          farthest(record.pixel_x, image.x0, image.x1))));
        g0_.count(g0_.beyond(record.limit));
        d0_.count(d0_.beyond(record.a * (2 * std::min(record.radius, columns) + 1)));
        term_.count(term_.beyond(largest_term(record)));
        weight_.count(weight_.beyond(std::min(kAlphaMax, splat.opacity) * brightest(record)));
    }
    std::vector<const Field*> all() const {
        return {&distance_, &edge_, &g0_, &d0_, &term_, &weight_};
    }

private:
    static double farthest(double from, double first, double last) {
        return std::max(std::abs(first - from), std::abs(last - from));
    }
    /// The larger one of n d0 and A n (n - 1) in the row of the mean, from its left end or vertex.
    double largest_term(const QuantizedSplat& record) const {
        const double last = frame_.tile_size - 1;
        if (from_start_) {
            const double n = std::min(2 * record.radius, last);
            return record.a * n * std::max(std::abs(2 * record.radius - 1), n - 1);
        }
        const double n = std::min(record.radius, last);
        return record.a * n * (n + 1);
    }

    const FrameWorkload& frame_;
    bool from_start_;
    Field distance_, edge_, g0_, d0_, term_, weight_;
};

std::vector<Saturation> saturated_stages(const NumberSet& set, const FrameWorkload& frame) {
    const QuantizedRow row(set);
    RecordFields records(set);
    RowFields rows(set, frame);
    for (const ProjectedSplat& splat : frame.splats) {
        const QuantizedSplat record = row.record(splat);
        if (!records.count(splat, record)) { // else what follows is of a wrong record
            rows.count(splat, record);
        }
    }
    std::vector<Saturation> found;
    for (const std::vector<const Field*>& fields : {records.all(), rows.all()}) {
        for (const Field* field : fields) {
            if (field->found().splats != 0) {
                found.push_back(field->found());
            }
        }
    }
    return found;
}

/// The formats of a run; none for those that reach as far as the host's.
std::optional<NumberSet> set_of(const DataPathOptions& options) {
    if (options.set) {
        return *options.set;
    }
    switch (options.numbers) {
    case Arithmetic::Fp32:
    case Arithmetic::Fp64:
    case Arithmetic::Ideal:
        return {};
    default:
        return number_set(name_of(options.numbers));
    }
}

} // namespace

std::vector<Saturation> saturated_stages(const DataPathOptions& options,
                                         const FrameWorkload& frame) {
    const std::optional<NumberSet> set = set_of(options);
    return set ? saturated_stages(*set, frame) : std::vector<Saturation>{};
}

std::optional<Saturation> end_of_sums(const DataPathOptions& options) {
    const std::optional<NumberSet> set = set_of(options);
    return set ? std::optional<Saturation>({"sum", set->sum.name(), set->sum.max(), 0})
               : std::nullopt;
}

} // namespace degs
