// SPDX-License-Identifier: Apache-2.0
// Number sets by name.
#include <algorithm>
#include <string_view>

#include "config/config_source.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"
#include "splat/numbers/number_set.hpp"

namespace degs {
namespace {

/// Every stage in one format, both functions exact.
NumberSet uniform(const std::string& name, const std::string& format) {
    NumberSet set;
    set.name = name;
    const NumberFormat value = parse_format(format);
    for (const NumberStage& stage : number_stages()) {
        set.*stage.format = value;
    }
    for (TableSpec* table : {&set.sqrt, &set.exp}) {
        table->values = table->argument = value;
    }
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

struct RecordSet {
    const char* name;
    std::vector<std::string> formats;
};
const std::vector<RecordSet>& record_sets() {
    static const std::vector<RecordSet> sets{
        {"fp32", {}}, // 44 B, as the scene has them
        {"fp16",      // 22 B
         {"gaussian_mean=fp16", "gaussian_scale=fp16", "gaussian_rotation=fp16",
          "gaussian_opacity=fp16", "sh_dc=fp16", "sh_rest=fp16"}},
        // 27 B: words of 16 bits but for means, whose rounding moves splats against each other and
        // changes their order (docs/numbers.md).
        {"tuned",
         {"gaussian_mean=e5m22", "gaussian_scale=ue5m11b14", "gaussian_rotation=q1.15",
          "gaussian_opacity=uq0.16", "sh_dc=e4m11b8", "sh_rest=e4m11b9"}}};
    return sets;
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

std::vector<std::string> number_set_names() {
    std::vector<std::string> names;
    for (const NamedSet& each : kNamedSets) {
        names.emplace_back(each.name);
    }
    return names;
}

NumberSet number_set(const std::string& name) {
    for (const NamedSet& each : kNamedSets) {
        if (name == each.name) {
            return each.make();
        }
    }
    throw InputError("There is no number set '" + name + "'; there are " +
                     config_words::list(number_set_names()) + ".");
}

NumberSet number_set(const std::string& name, const std::vector<std::string>& assignments,
                     const std::string& option) {
    NumberSet set = number_set(name);
    ConfigSource::from_overrides(with_record_formats(assignments, option), option).load(set);
    for (const std::string& assignment : assignments) {
        set.name += " " + assignment;
    }
    return set;
}

const std::vector<const char*>& record_set_names() {
    static const std::vector<const char*> names = [] {
        std::vector<const char*> all;
        for (const RecordSet& set : record_sets()) {
            all.push_back(set.name);
        }
        return all;
    }();
    return names;
}

const std::vector<std::string>& record_formats(std::size_t set) {
    return record_sets().at(set).formats;
}

namespace {

constexpr std::string_view kRecords = "records=";

/// The records that an assignment names. Throws InputError for an unknown name.
const RecordSet& record_set(const std::string& assignment, const std::string& option) {
    const std::string name = assignment.substr(kRecords.size());
    const std::vector<RecordSet>& sets = record_sets();
    const auto set = std::find_if(sets.begin(), sets.end(),
                                  [&name](const RecordSet& each) { return each.name == name; });
    if (set == sets.end()) {
        const std::vector<const char*>& names = record_set_names();
        throw InputError(option + " " + assignment + ": there are no records '" + name +
                         "'; there are " + config_words::list({names.begin(), names.end()}) + ".");
    }
    return *set;
}

} // namespace

std::vector<std::string> with_record_formats(const std::vector<std::string>& assignments,
                                             const std::string& option) {
    std::vector<std::string> all;
    for (const std::string& assignment : assignments) {
        if (assignment.compare(0, kRecords.size(), kRecords) != 0) {
            all.push_back(assignment);
            continue;
        }
        const RecordSet& set = record_set(assignment, option);
        all.insert(all.end(), set.formats.begin(), set.formats.end());
    }
    return all;
}

} // namespace degs
