// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/number_override.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>

#include "config/error.hpp"

namespace degs {
namespace {

/// Stores a value; returns what it must be instead, or nothing.
using Store = std::function<std::string(NumberSet&, const std::string&)>;

struct NumberPart {
    NumberKey key;
    Store store;
};

template <class Get>
NumberPart format(const char* name, const char* meaning, const Get& get) {
    return {{name, std::string("format: ") + meaning},
            [get](NumberSet& set, const std::string& value) -> std::string {
                try {
                    get(set) = parse_format(value);
                } catch (const InputError&) {
                    return "fp64, fp32, fp16, bf16, [u]eEmM[bB] (E 2 to 8, M 1 to 23 bits, values "
                           "within fp32's range) or [u]qI.F (2 to 32 bits)";
                }
                return "";
            }};
}

NumberPart stage(const char* name, const char* meaning, NumberFormat NumberSet::*member) {
    return format(name, meaning, [member](NumberSet& set) -> NumberFormat& { return set.*member; });
}

/// `words` in the order of the enumeration.
template <class Put>
NumberPart choice(const std::string& name, const char* meaning,
                  const std::vector<std::string>& words, const Put& put) {
    std::string allowed;
    for (const std::string& word : words) {
        allowed += (allowed.empty() ? "" : &word == &words.back() ? " or " : ", ") + word;
    }
    return {{name, allowed + ": " + meaning},
            [words, allowed, put](NumberSet& set, const std::string& value) -> std::string {
                const auto at = std::find(words.begin(), words.end(), value);
                if (at == words.end()) {
                    return allowed;
                }
                put(set, static_cast<int>(at - words.begin()));
                return "";
            }};
}

template <class Number, class Get>
NumberPart number(const std::string& name, const char* meaning, Number low, Number high,
                  const char* allowed, const Get& get) {
    return {{name, std::string(allowed) + ": " + meaning},
            [=](NumberSet& set, const std::string& value) -> std::string {
                Number read{};
                const char* const end = value.data() + value.size();
                const auto result = std::from_chars(value.data(), end, read);
                if (result.ec != std::errc() || result.ptr != end ||
                    !(read >= low && read <= high)) {
                    return allowed;
                }
                get(set) = read;
                return "";
            }};
}

void add_stages(std::vector<NumberPart>& parts) {
    using S = NumberSet;
    const std::vector<NumberPart> stages = {
        stage("projection", "all that makes splats out of Gaussians; fp64 shares the reference's",
              &S::projection),
        stage("mean", "mu_x, mu_y in the record, px", &S::mean),
        stage("slope", "m in the record", &S::slope),
        stage("c_prime", "C' in the record", &S::c_prime),
        stage("radius", "r_x in the record, px", &S::radius),
        stage("inverse_radius2", "1 / r_y^2 in the record", &S::inverse_radius2),
        stage("conic", "A in the record and the PE", &S::conic),
        stage("q_threshold", "Q_th in the record", &S::q_threshold),
        stage("colour", "red, green, blue in the record and the PE", &S::colour),
        stage("distance", "dy and x - x_c, px", &S::distance),
        stage("square", "products in the Span Unit", &S::square),
        stage("ratio", "x = dy^2 / r_y^2 and 1 - x", &S::ratio),
        stage("edge", "m dy, x_c, w and the ends, px", &S::edge),
        stage("level", "terms of g0", &S::level),
        stage("g0", "g0 in the Span Vector", &S::g0),
        stage("d0", "d0 in the Span Vector", &S::d0),
        stage("term", "n d0 and A n(n-1)", &S::term),
        stage("q", "q of a pixel", &S::q),
        stage("alpha", "alpha", &S::alpha),
        stage("transmittance", "T and 1 - alpha", &S::transmittance),
        stage("weight", "alpha T and its products with the colour", &S::weight),
        stage("sum", "accumulated colour", &S::sum)};
    parts.insert(parts.end(), stages.begin(), stages.end());
}

void add_orders(std::vector<NumberPart>& parts) {
    const std::vector<NumberPart> orders = {
        choice("derivation", "descriptor in double, or in its own formats",
               {"reference", "literal"},
               [](NumberSet& set, int i) { set.derivation = static_cast<Derivation>(i); }),
        choice("vertical", "(dy^2) k, (dy k) dy, or C' dy^2 from x",
               {"squared", "stepwise", "ratio"},
               [](NumberSet& set, int i) { set.vertical = static_cast<Vertical>(i); }),
        choice("mean_form", "the mean as it is, or as pixel and offset", {"coordinate", "offset"},
               [](NumberSet& set, int i) { set.mean_form = static_cast<Mean>(i); }),
        choice("base", "pixel of n = 0: the span's first, or the nearest to x_c",
               {"start", "vertex"}, [](NumberSet& set, int i) { set.base = static_cast<Base>(i); }),
        choice("multiplier", "of integers n and n(n-1)", {"whole", "half_lookup"},
               [](NumberSet& set, int i) { set.multiplier = static_cast<IntegerMultiplier>(i); }),
        choice("exponent", "q counts nats of exp(-q/2), or orders of 2^-q", {"natural", "binary"},
               [](NumberSet& set, int i) {
                   set.exponent = static_cast<Exponent>(i);
                   set.exp.function = i == 0 ? TableFunction::ExpHalf : TableFunction::Exp2;
               }),
        choice("q_mask", "do PEs drop pixels outside the ellipse?", {"false", "true"},
               [](NumberSet& set, int i) { set.q_mask = i != 0; }),
        number("guard", "px by which exact ends move outwards before ceil and floor", 0.0, 16.0,
               "0 to 16", [](NumberSet& set) -> double& { return set.guard; })};
    parts.insert(parts.end(), orders.begin(), orders.end());
}

void add_table(std::vector<NumberPart>& parts, const std::string& table,
               TableSpec NumberSet::*member) {
    const auto spec = [member](NumberSet& set) -> TableSpec& { return set.*member; };
    parts.push_back(choice(table + ".interpolation", "no table, or what a cell holds",
                           {"exact", "nearest", "linear"}, [spec](NumberSet& set, int i) {
                               spec(set).interpolation = static_cast<Interpolation>(i);
                           }));
    parts.push_back(choice(
        table + ".reduction", "argument as it is, or reduced to a power of two", {"none", "binary"},
        [spec](NumberSet& set, int i) { spec(set).reduction = static_cast<Reduction>(i); }));
    parts.push_back(number(table + ".entries", "cells of the table", 1, 4096, "1 to 4096",
                           [spec](NumberSet& set) -> int& { return spec(set).entries; }));
    parts.push_back(number(table + ".range", "of the argument, if it is not reduced", 1e-3, 1e3,
                           "0.001 to 1000",
                           [spec](NumberSet& set) -> double& { return spec(set).range; }));
    parts.push_back(format((table + ".values").c_str(), "entries and results",
                           [spec](NumberSet& set) -> NumberFormat& { return spec(set).values; }));
}

const std::vector<NumberPart>& parts() {
    static const std::vector<NumberPart> all = [] {
        std::vector<NumberPart> list;
        add_stages(list);
        add_orders(list);
        add_table(list, "sqrt", &NumberSet::sqrt);
        add_table(list, "exp", &NumberSet::exp);
        list.push_back(format("exp.argument",
                              "q log2(e) / 2, in front of the table of a natural exponent",
                              [](NumberSet& set) -> NumberFormat& { return set.exp.argument; }));
        return list;
    }();
    return all;
}

[[noreturn]] void refuse(const std::string& part, const NumberFormat& format,
                         const std::string& need) {
    std::string sentence = "The number format " + format.name();
    sentence.append(" of ").append(part).append(" ").append(need).append(".");
    throw InputError(sentence);
}

} // namespace

const std::vector<NumberKey>& number_keys() {
    static const std::vector<NumberKey> keys = [] {
        std::vector<NumberKey> list;
        for (const NumberPart& part : parts()) {
            list.push_back(part.key);
        }
        return list;
    }();
    return keys;
}

std::string override_number(NumberSet& set, const std::string& name, const std::string& value) {
    std::string names;
    for (const NumberPart& part : parts()) {
        if (part.key.name == name) {
            const std::string allowed = part.store(set, value);
            if (allowed.empty()) {
                set.name.append(" ").append(name).append("=").append(value);
                return "";
            }
            return "must be " + allowed;
        }
        names.append(names.empty() ? "" : ", ").append(part.key.name);
    }
    return "is no part of a number set; there are " + names;
}

void check_numbers(const NumberSet& set) {
    const std::pair<const char*, const NumberFormat&> with_sign[] = {{"projection", set.projection},
                                                                     {"mean", set.mean},
                                                                     {"slope", set.slope},
                                                                     {"distance", set.distance},
                                                                     {"edge", set.edge},
                                                                     {"square", set.square},
                                                                     {"d0", set.d0},
                                                                     {"term", set.term}};
    for (const auto& [name, format] : with_sign) {
        if (!format.has_sign) {
            refuse(name, format, "has no sign, but its values may be negative");
        }
    }
    if (!(set.ratio.max() > 1)) {
        refuse("ratio", set.ratio, "must reach beyond 1, where a row misses the ellipse");
    }
    const Rounder q(set.q);
    if (!(q(2 * set.q_limit()) > q(set.q_limit()))) {
        refuse("q", set.q,
               "must reach beyond " + std::to_string(set.q_limit()) + ", where alpha is 1/255");
    }
    for (const TableSpec* table : {&set.sqrt, &set.exp}) {
        (void)LookupTable(*table); // has its own words
    }
}

NumberSet number_set(const std::string& name, const std::vector<std::string>& assignments) {
    NumberSet set = number_set(name);
    for (const std::string& assignment : assignments) {
        const std::size_t sign = assignment.find('=');
        const std::string part = assignment.substr(0, sign);
        const std::string rule = override_number(
            set, part, sign == std::string::npos ? "" : assignment.substr(sign + 1));
        if (!rule.empty()) {
            std::string sentence = "In '" + assignment;
            throw InputError(sentence.append("', '").append(part).append("' ").append(rule) + ".");
        }
    }
    check_numbers(set);
    return set;
}

} // namespace degs
