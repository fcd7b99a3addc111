// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/number_set.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

using S = NumberSet;
constexpr bool kSigned = true;
constexpr bool kUnsigned = false;

/// A format of what projection and sorting read, no stage of the data path.
struct MemoryFormat {
    const char* key;
    NumberFormat NumberSet::*format;
    bool is_signed;
    const char* meaning;
};
constexpr MemoryFormat kMemoryFormats[] = {
    {"gaussian_mean", &S::gaussian_mean, kSigned,
     "means of Gaussians in memory, scene units; fp64: as the scene has them, in 32 bits"},
    {"gaussian_scale", &S::gaussian_scale, kUnsigned,
     "standard deviations of Gaussians in memory; fp64: as the scene has them"},
    {"gaussian_rotation", &S::gaussian_rotation, kSigned,
     "quaternions of Gaussians in memory; fp64: as the scene has them"},
    {"gaussian_opacity", &S::gaussian_opacity, kUnsigned,
     "opacities of Gaussians in memory; fp64: as the scene has them"},
    {"sh_dc", &S::sh_dc, kSigned,
     "SH coefficients of degree 0 in memory; fp64: as the scene has them"},
    {"sh_rest", &S::sh_rest, kSigned,
     "SH coefficients of higher degrees in memory; fp64: as the scene has them"},
    {"depth_key", &S::depth_key, kUnsigned,
     "depth by which lists are sorted; equal keys stay in the order of their indices"}};

NumberFormat with_sign(NumberFormat format) {
    format.has_sign = true;
    return format;
}

void require_ranges(const NumberSet& set, ConfigVisitor& visitor) {
    for (const MemoryFormat& stored : kMemoryFormats) {
        const NumberFormat& format = set.*stored.format;
        visitor.require(!stored.is_signed || format.has_sign,
                        {stored.key, "must have a sign", with_sign(format).name()});
    }
    visitor.require(!set.depth_key.is_fp64(), {"depth_key", "must be no finer than fp32", "fp32"});
    for (const NumberStage& stage : number_stages()) {
        const NumberFormat& format = set.*stage.format;
        visitor.require(!stage.is_signed || format.has_sign,
                        {stage.key, "must have a sign", with_sign(format).name()});
    }
    visitor.require(set.ratio.max() > 1,
                    {"ratio", "must reach beyond 1, where a row misses the ellipse", "fp16"});
    const Rounder q(set.q);
    const double limit = set.q_limit();
    visitor.require(q(2 * limit) > q(limit),
                    {"q",
                     "must reach beyond " + config_words::number(limit) + ", where alpha is 1/255",
                     "fp16",
                     {"exponent"}});
}

} // namespace

const std::vector<NumberStage>& number_stages() {
    static const std::vector<NumberStage> stages = {
        {"projection", &S::projection, kSigned, "projection",
         "all that makes splats out of Gaussians; fp64 shares the reference's"},
        // Splat record.
        {"mean", &S::mean, kSigned, "", "mu_x, mu_y in the record, px", {"mu_x", "mu_y"}},
        {"slope", &S::slope, kSigned, "", "m in the record", {"m"}},
        {"c_prime", &S::c_prime, kUnsigned, "", "C' in the record", {}, "C'"},
        {"radius", &S::radius, kUnsigned, "", "r_x in the record, px", {"r_x"}},
        {"inverse_radius2",
         &S::inverse_radius2,
         kUnsigned,
         "",
         "1 / r_y^2 in the record",
         {"1/r_y^2"}},
        {"conic", &S::conic, kUnsigned, "", "A in the record and the PE", {"A"}, "B"},
        {"q_threshold", &S::q_threshold, kUnsigned, "", "Q_th in the record", {"Q_th"}},
        {"colour",
         &S::colour,
         kUnsigned,
         "",
         "red, green, blue in the record and the PE",
         {"red", "green", "blue"}},
        // Span Unit.
        {"distance", &S::distance, kSigned, "span.distance", "dy and x - x_c, px"},
        {"square", &S::square, kSigned, "span.square", "products in the Span Unit"},
        {"ratio", &S::ratio, kUnsigned, "span.ratio", "x = dy^2 / r_y^2 and 1 - x"},
        {"edge", &S::edge, kSigned, "span.edge", "m dy, x_c, w and the ends, px"},
        {"level", &S::level, kUnsigned, "span.level", "terms of g0"},
        {"g0", &S::g0, kUnsigned, "span_vector.g0", "g0 in the Span Vector"},
        {"d0", &S::d0, kSigned, "span_vector.d0", "d0 in the Span Vector"},
        // Blending PE and Pixel Buffer.
        {"term", &S::term, kSigned, "pe.term", "n d0 and A n(n-1)"},
        {"q", &S::q, kUnsigned, "pe.q", "q of a pixel"},
        {"alpha", &S::alpha, kUnsigned, "pe.alpha", "alpha"},
        {"transmittance", &S::transmittance, kUnsigned, "pe.transmittance", "T and 1 - alpha"},
        {"weight", &S::weight, kUnsigned, "pe.weight", "alpha T and its products with the colour"},
        {"sum", &S::sum, kUnsigned, "pe.sum", "accumulated colour"}};
    return stages;
}

void NumberSet::describe(ConfigVisitor& visitor) {
    for (const NumberStage& stage : number_stages()) {
        describe_format(visitor, stage.key, this->*stage.format, stage.meaning);
    }
    for (const MemoryFormat& stored : kMemoryFormats) {
        describe_format(visitor, stored.key, this->*stored.format, stored.meaning);
    }
    visitor.choice("derivation", derivation, {"reference", "literal"},
                   "descriptor in double, or in its own formats");
    visitor.choice("vertical", vertical, {"squared", "stepwise", "ratio"},
                   "(dy^2) k, (dy k) dy, or C' dy^2 from x");
    visitor.choice("mean_form", mean_form, {"coordinate", "offset"},
                   "the mean as it is, or as pixel and offset");
    visitor.choice("span_base", base, {"start", "vertex"},
                   "pixel of n = 0: the span's first, or the nearest to x_c");
    visitor.replaced("base", "the pixel of n = 0 is span_base");
    visitor.choice("multiplier", multiplier, {"whole", "half_lookup"}, "of integers n and n(n-1)");
    visitor.integer("lookup_bits", lookup_bits, 1, 15,
                    "bits of the lower half of an integer with half_lookup [assumed]");
    visitor.choice("exponent", exponent, {"natural", "binary"},
                   "q counts nats of exp(-q/2), or orders of 2^-q");
    exp.function = exponent == Exponent::Natural ? TableFunction::ExpHalf : TableFunction::Exp2;
    visitor.boolean("q_mask", q_mask, "do PEs drop pixels outside the ellipse?");
    visitor.real("guard", guard, 0.0, 16.0,
                 "px by which exact ends move outwards before ceil and floor");
    visitor.section("sqrt", sqrt, "table of sqrt(1 - x)");
    visitor.section("exp", exp, "table of the exponential");
    require_ranges(*this, visitor);
}

bool NumberSet::makes_splats(const std::string& key) {
    return key == "projection" ||
           std::any_of(std::begin(kMemoryFormats), std::end(kMemoryFormats),
                       [&key](const MemoryFormat& stored) { return key == stored.key; });
}

double NumberSet::q_limit() const {
    return exponent == Exponent::Natural ? 2 * std::log(255.0) : std::log2(255.0);
}

std::vector<RecordField> splat_record(const NumberSet& set) {
    std::vector<RecordField> fields;
    for (const NumberStage& stage : number_stages()) {
        const int bits = (set.*stage.format).storage_bits();
        for (const char* field : stage.fields) {
            fields.push_back({field, bits});
        }
        if (stage.direct_field != nullptr && set.vertical != Vertical::FromRatio) {
            fields.push_back({stage.direct_field, bits});
        }
    }
    if (set.mean_form == Mean::PixelAndOffset) {
        fields.push_back({"pixel_x", 32});
        fields.push_back({"pixel_y", 32});
    }
    fields.push_back({"depth", 16});
    fields.push_back({"id", 32});
    return fields;
}

int record_bits(const NumberSet& set) {
    int bits = 0;
    for (const RecordField& field : splat_record(set)) {
        bits += field.bits;
    }
    return bits;
}

int pixel_bits(const NumberSet& set) {
    return set.transmittance.storage_bits() + 3 * set.sum.storage_bits();
}

} // namespace degs
