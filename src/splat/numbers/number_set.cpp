// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/number_set.hpp"

#include <cmath>

#include "config/error.hpp"

namespace degs {
namespace {

/// Every stage in one format, both functions exact.
NumberSet uniform(const std::string& name, const std::string& format) {
    NumberSet set;
    set.name = name;
    const NumberFormat value = parse_format(format);
    for (NumberFormat* stage : {&set.projection,
                                &set.mean,
                                &set.slope,
                                &set.c_prime,
                                &set.radius,
                                &set.inverse_radius2,
                                &set.conic,
                                &set.q_threshold,
                                &set.colour,
                                &set.distance,
                                &set.square,
                                &set.ratio,
                                &set.edge,
                                &set.level,
                                &set.g0,
                                &set.d0,
                                &set.term,
                                &set.q,
                                &set.alpha,
                                &set.transmittance,
                                &set.weight,
                                &set.sum,
                                &set.sqrt.values,
                                &set.exp.values,
                                &set.sqrt.argument,
                                &set.exp.argument}) {
        *stage = value;
    }
    set.exp.function = TableFunction::ExpHalf;
    return set;
}

NumberSet ideal_set() {
    NumberSet set = uniform("ideal", "fp64");
    set.meaning = "double precision, exact span ends";
    return set;
}

NumberSet fp32_set() {
    NumberSet set = uniform("fp32", "fp32");
    set.meaning = "single precision, exact span ends; splats from double";
    set.projection = NumberFormat(); // fp32 would swap splats of nearly equal depth
    set.mean_form = Mean::PixelAndOffset;
    return set;
}

NumberSet fp16_set() {
    NumberSet set = uniform("fp16", "fp16");
    set.meaning = "every value and operation of the paper's equations in FP16, projected in FP32";
    set.projection = parse_format("fp32"); // determinants leave FP16 at 256 px^2
    set.derivation = Derivation::Literal;
    set.vertical = Vertical::Squared;
    set.ends = SpanEnds::Outward;
    set.exp.reduction = Reduction::Binary; // FP16 units compute 2^x
    return set;
}

NumberSet paper_set() {
    NumberSet set = uniform("paper", "fp16");
    set.projection = parse_format("fp32");
    set.meaning =
        "FP16 and tables; screen coordinates in fixed point, six exponent bits where large "
        "splats need them";
    set.mean = set.distance = set.edge = parse_format("q16.8");
    set.c_prime = set.inverse_radius2 = set.conic = parse_format("e6m9");
    set.square = parse_format("e6m10");
    set.ends = SpanEnds::Slope;
    set.multiplier = IntegerMultiplier::HalfLookup;
    set.sqrt.interpolation = Interpolation::Nearest;
    set.sqrt.entries = 256;
    set.exp.interpolation = Interpolation::Linear;
    set.exp.reduction = Reduction::Binary;
    set.exp.entries = 16;
    return set;
}

void set_tuned_tables(NumberSet& set) {
    set.sqrt.interpolation = Interpolation::Linear;
    set.sqrt.reduction = Reduction::Binary;
    set.sqrt.entries = 32;
    set.sqrt.values = parse_format("uq1.15");
    set.exp.function = TableFunction::Exp2;
    set.exp.interpolation = Interpolation::Linear;
    set.exp.reduction = Reduction::Binary;
    set.exp.entries = 16;
    set.exp.values = parse_format("uq1.15");
}

NumberSet tuned_set() {
    NumberSet set;
    set.name = "tuned";
    set.projection = parse_format("fp32");
    set.meaning = "the record and PE words of paper, spent on fixed point and exponents that fit";
    set.mean = set.distance = set.edge = parse_format("q18.12");
    set.slope = parse_format("e6m17");
    set.radius = parse_format("ue5m15b14");          // up to 131 000 px
    set.inverse_radius2 = parse_format("ue6m14b50"); // 16 384 down to 10^-15
    set.conic = parse_format("ue5m11b29");           // 4 down to 4e-9 with all its bits
    set.q_threshold = parse_format("uq3.17");
    set.colour = parse_format("ue4m12b8"); // up to 128
    set.square = parse_format("e6m12");
    set.ratio = parse_format("uq1.18");
    set.level = parse_format("uq4.16");
    set.g0 = set.q = parse_format("uq3.13"); // log2 255 < 8
    set.d0 = parse_format("e4m11b11");
    set.term = parse_format("q5.13");
    set.alpha = parse_format("uq0.16");
    // Finer than the sums: where T does not fall any more, colours must not be added any more.
    set.transmittance = parse_format("uq0.18");
    set.weight = set.sum = parse_format("uq6.16");
    set_tuned_tables(set);
    set.vertical = Vertical::FromRatio;
    set.base = Base::Vertex;
    set.multiplier = IntegerMultiplier::HalfLookup;
    set.exponent = Exponent::Binary;
    return set;
}

struct NamedSet {
    const char* name;
    NumberSet (*make)();
};
constexpr NamedSet kNamedSets[] = {{"ideal", &ideal_set},
                                   {"fp32", &fp32_set},
                                   {"fp16", &fp16_set},
                                   {"paper", &paper_set},
                                   {"tuned", &tuned_set}};

} // namespace

double NumberSet::q_limit() const {
    return exponent == Exponent::Natural ? 2 * std::log(255.0) : std::log2(255.0);
}

std::vector<RecordField> splat_record(const NumberSet& set) {
    const int mean = set.mean.storage_bits();
    const int colour = set.colour.storage_bits();
    std::vector<RecordField> fields = {{"mu_x", mean},
                                       {"mu_y", mean},
                                       {"m", set.slope.storage_bits()},
                                       {"r_x", set.radius.storage_bits()},
                                       {"1/r_y^2", set.inverse_radius2.storage_bits()},
                                       {"A", set.conic.storage_bits()},
                                       {"Q_th", set.q_threshold.storage_bits()},
                                       {"red", colour},
                                       {"green", colour},
                                       {"blue", colour},
                                       {"depth", 16},
                                       {"id", 32}};
    if (set.mean_form == Mean::PixelAndOffset) {
        fields.push_back({"pixel_x", 32});
        fields.push_back({"pixel_y", 32});
    }
    if (set.vertical != Vertical::FromRatio) {
        fields.push_back({"C'", set.c_prime.storage_bits()});
        fields.push_back({"B", set.conic.storage_bits()});
    }
    return fields;
}

int record_bits(const NumberSet& set) {
    int bits = 0;
    for (const RecordField& field : splat_record(set)) {
        bits += field.bits;
    }
    return bits;
}

std::vector<std::pair<std::string, std::string>> cost_keys(const NumberSet& set) {
    const char* const multiplier =
        set.multiplier == IntegerMultiplier::HalfLookup ? "half-lookup." : "multiply.";
    const auto key = [](const char* operation, const NumberFormat& format) {
        return operation + format.name();
    };
    return {{"record", "bits." + std::to_string(record_bits(set))},
            {"projection", key("multiply-add.", set.projection)},
            {"span.distance", key("add.", set.distance)},
            {"span.square", key("multiply.", set.square)},
            {"span.ratio", key("multiply.", set.ratio)},
            {"span.edge", key("multiply-add.", set.edge)},
            {"span.level", key("multiply-add.", set.level)},
            {"span.sqrt", set.sqrt.cost_key()},
            {"span_vector.g0", key("register.", set.g0)},
            {"span_vector.d0", key("register.", set.d0)},
            {"pe.term", key(multiplier, set.term)},
            {"pe.q", key("add.", set.q)},
            {"pe.exp", set.exp.cost_key()},
            {"pe.alpha", key("register.", set.alpha)},
            {"pe.transmittance", key("multiply.", set.transmittance)},
            {"pe.weight", key("multiply.", set.weight)},
            {"pe.sum", key("add.", set.sum)}};
}

std::vector<std::string> number_set_names() {
    std::vector<std::string> names;
    for (const NamedSet& each : kNamedSets) {
        names.emplace_back(each.name);
    }
    return names;
}

NumberSet number_set(const std::string& name) {
    std::string known;
    for (const NamedSet& each : kNamedSets) {
        if (name == each.name) {
            return each.make();
        }
        known += std::string(known.empty() ? "" : ", ") + each.name;
    }
    throw InputError("There is no number set '" + name + "'; there are " + known + ".");
}

} // namespace degs
