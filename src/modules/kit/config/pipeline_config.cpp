// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/config/pipeline_config.hpp"

namespace degs {

void PipelineConfig::describe(ConfigVisitor& visitor) {
    visitor.choice("numbers", numbers, arithmetic_names(),
                   "arithmetic of spans, alpha and blending: the machine's fp32 or fp64 (also "
                   "ideal), or a number set; configs/degs-*.yaml say paper or tuned");
    visitor.choice(
        "stop_rule", stop_rule, {"refuse", "after"},
        "refuse: the splat that would push T under 1e-4 is not blended (reference code); "
        "after: it is, then the pixel ends (paper, Sec. II-A)");
    visitor.choice(
        "tiles", tiles, {"exact", "reference"},
        "tiles that list a splat; exact: those that the ellipse touches, whose rows and columns "
        "preprocessing knows for span parsing [assumed]; reference: those of the 3-sigma square, "
        "radius ceil(3 sqrt(lambda_max)) (paper, Sec. II-A; reference code)");
    visitor.section("rules", rules,
                    "what renderers of the same Gaussians disagree about; the defaults are those "
                    "of the reference code");
    NumberSet set = set_of(numbers);
    visitor.begin_section("formats",
                          "single parts of `numbers` in other formats; set: as they are there");
    formats.describe(visitor, set);
    visitor.end_section();
}

void PipelineConfig::require_records(ConfigVisitor& visitor, int sh_value_bytes,
                                     int list_entry_bytes) const {
    const ProjectionNumbers stored = formats.applied_to(set_of(numbers)).projection_numbers();
    const ProjectionNumbers untouched;
    const auto require_sh = [&](const NumberFormat& format, const char* key) {
        const int bytes = (format.storage_bits() + 7) / 8;
        visitor.require(format == untouched.sh_dc || bytes <= sh_value_bytes,
                        {"traffic.sh_value_bytes",
                         "must hold an SH coefficient of " + format.name(),
                         std::to_string(bytes),
                         {key}});
    };
    require_sh(stored.sh_dc, "pipeline.formats.sh_dc");
    require_sh(stored.sh_rest, "pipeline.formats.sh_rest");
    constexpr int kLeastIndexBits = 16;
    const NumberFormat& key = stored.depth_key;
    const int bytes = (key.storage_bits() + kLeastIndexBits + 7) / 8;
    visitor.require(key == untouched.depth_key || bytes <= list_entry_bytes,
                    {"traffic.list_entry_bytes",
                     "must hold a depth key of " + key.name() + " and an index of 16 bits at least",
                     std::to_string(bytes),
                     {"pipeline.formats.depth_key"}});
}

int PipelineConfig::pixel_bits() const {
    return degs::pixel_bits(formats.applied_to(set_of(numbers)));
}

cost::Precision PipelineConfig::precision() const {
    switch (numbers) {
    case Arithmetic::Fp32:
        return cost::Precision::Single;
    case Arithmetic::Fp64:
    case Arithmetic::Ideal:
        return cost::Precision::Double;
    default:
        return cost::Precision::Half;
    }
}

DataPathOptions PipelineConfig::options(SpanEnds ends, int delta) const {
    const DataPathOptions named = named_numbers(name_of(numbers), formats.assignments());
    return {numbers, ends, delta, stop_rule, named.set, named.projection, rules};
}

} // namespace degs
