// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/config/pipeline_config.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

/// In the order of Records.
const std::vector<const char*>& record_names() {
    static const std::vector<const char*> names{"numbers", "fp32", "fp16", "paper", "tuned"};
    return names;
}

} // namespace

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
    visitor.choice("records", records, record_names(),
                   "formats of the values of Gaussians in memory, to which projection rounds them: "
                   "those of the number set of that name; numbers: of `numbers` itself; "
                   "traffic.geometry_bytes and sh_value_bytes follow");
    NumberSet set = number_set(set_of(numbers).name, record_formats());
    visitor.begin_section("formats",
                          "single parts of `numbers` in other formats; set: as they are there");
    formats.describe(visitor, set);
    visitor.end_section();
}

void PipelineConfig::require_records(ConfigVisitor& visitor, int geometry_bytes, int sh_value_bytes,
                                     int list_entry_bytes) const {
    const ProjectionNumbers stored = projection_numbers();
    const int geometry = ceil_div(stored.mean_bits() + stored.shape_bits(), 8);
    visitor.require(geometry_bytes == 0 || geometry <= geometry_bytes,
                    {"traffic.geometry_bytes",
                     "must hold mean, scale, rotation and opacity of a Gaussian, " +
                         std::to_string(geometry) + " B",
                     std::to_string(geometry),
                     {"pipeline.records", "pipeline.formats"}});
    const int sh = std::max(ceil_div(stored.sh_bits(0), 3 * 8),
                            ceil_div(stored.sh_bits(1) - stored.sh_bits(0), 9 * 8));
    visitor.require(sh_value_bytes == 0 || sh <= sh_value_bytes,
                    {"traffic.sh_value_bytes",
                     "must hold an SH coefficient, " + std::to_string(sh) + " B",
                     std::to_string(sh),
                     {"pipeline.records", "pipeline.formats"}});
    constexpr int kLeastIndexBits = 16;
    const NumberFormat& key = stored.depth_key;
    const int bytes = ceil_div(key.storage_bits() + kLeastIndexBits, 8);
    visitor.require(key == ProjectionNumbers().depth_key || bytes <= list_entry_bytes,
                    {"traffic.list_entry_bytes",
                     "must hold a depth key of " + key.name() + " and an index of 16 bits at least",
                     std::to_string(bytes),
                     {"pipeline.formats.depth_key"}});
}

std::vector<std::string> PipelineConfig::record_formats() const {
    const std::string name = record_names()[static_cast<std::size_t>(records)];
    return records == Records::Numbers ? std::vector<std::string>()
                                       : number_set(name).gaussian_formats();
}

NumberSet PipelineConfig::changed_set() const {
    return formats.applied_to(number_set(set_of(numbers).name, record_formats()));
}

int PipelineConfig::pixel_bits() const {
    return degs::pixel_bits(changed_set());
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
    std::vector<std::string> changes = record_formats();
    const std::vector<std::string> more = formats.assignments();
    changes.insert(changes.end(), more.begin(), more.end());
    const DataPathOptions named = named_numbers(name_of(numbers), changes);
    return {numbers, ends, delta, stop_rule, named.set, named.projection, rules};
}

} // namespace degs
