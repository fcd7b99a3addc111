// SPDX-License-Identifier: Apache-2.0
#include "splat/number_set.hpp"

#include <cmath>

#include "splat/error.hpp"

namespace degs {
namespace {

/// Every stage in one format, both functions exact.
NumberSet uniform(const std::string& name, const std::string& format) {
    NumberSet set;
    set.name = name;
    const ValueFormat value = parse_format(format);
    for (ValueFormat* stage :
         {&set.mean, &set.slope, &set.c_prime, &set.radius, &set.inverse_radius2, &set.conic,
          &set.q_threshold, &set.colour, &set.distance, &set.square, &set.ratio, &set.edge,
          &set.level, &set.g0, &set.d0, &set.term, &set.q, &set.alpha, &set.transmittance,
          &set.weight, &set.sum, &set.sqrt.values, &set.exp.values, &set.sqrt.argument,
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
    set.meaning = "single precision, exact span ends";
    set.mean_form = Mean::PixelAndOffset;
    return set;
}

NumberSet fp16_set() {
    NumberSet set = uniform("fp16", "fp16");
    set.meaning = "every value and operation of the paper's equations in FP16";
    set.derivation = Derivation::Literal;
    set.vertical = Vertical::Squared;
    set.ends = Ends::Outward;
    set.exp.reduction = Reduction::Binary; // FP16 units compute 2^x
    return set;
}

} // namespace

double NumberSet::q_limit() const {
    return exponent == Exponent::Natural ? 2 * std::log(255.0) : std::log2(255.0);
}

std::vector<std::string> number_set_names() {
    return {"ideal", "fp32", "fp16", "paper", "tuned"};
}

NumberSet number_set(const std::string& name) {
    if (name == "ideal") {
        return ideal_set();
    }
    if (name == "fp32") {
        return fp32_set();
    }
    return fp16_set();
}

} // namespace degs
