// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/config/pipeline_config.hpp"

#include <algorithm>

#include "tlm/ceil_div.hpp"

namespace degs {
namespace {

const std::vector<std::string>& record_formats_of(Records records) {
    return record_formats(static_cast<std::size_t>(records));
}

} // namespace

void PipelineConfig::describe(ConfigVisitor& visitor) {
    numbers.describe(visitor);
    visitor.replaced("formats",
                     "parts of a number set stand behind its name, as in pipeline.numbers: "
                     "tuned:alpha=uq1.15, or in a number file that pipeline.numbers names");
    visitor.choice(
        "stop_rule", stop_rule, {"refuse", "after"},
        "refuse: the splat that would push T under 1e-4 is not blended (reference code); "
        "after: it is, then the pixel ends (paper, Sec. II-A)");
    visitor.choice("tiles", tiles, tile_mode_names(), kTileModesDoc);
    visitor.section("rules", rules,
                    "what renderers of the same Gaussians disagree about; the defaults are those "
                    "of the reference code");
    visitor.choice("records", records, record_set_names(),
                   "formats of Gaussians in memory, from which traffic.geometry_bytes and "
                   "sh_value_bytes follow: 44 B and 4 B per SH value, 22 B and 2 B, 27 B and 2 B");
    visitor.boolean("round_records", round_records,
                    "round Gaussians to these formats before projection; no paper says that it "
                    "rounds, so records only count as bytes [assumed]");
}

void PipelineConfig::describe_records(ConfigVisitor& visitor, TrafficConfig& traffic) const {
    const ProjectionNumbers stored = stored_numbers();
    traffic.set_formats(stored);
    const auto require = [&](const char* key, const char* what, int bytes, int least) {
        visitor.require(bytes == 0 || least <= bytes,
                        {key,
                         std::string("must hold ") + what + ", " + std::to_string(least) + " B",
                         std::to_string(least),
                         {"pipeline.records", "pipeline.numbers"}});
    };
    const int bits = std::max(stored.sh_bits(0), (stored.sh_bits(1) - stored.sh_bits(0)) / 3);
    require("traffic.geometry_bytes", "mean, scale, rotation and opacity of a Gaussian",
            traffic.geometry_bytes, ceil_div(stored.mean_bits() + stored.shape_bits(), 8));
    require("traffic.sh_value_bytes", "an SH coefficient", traffic.sh_value_bytes,
            ceil_div(bits, 3 * 8));
    constexpr int kLeastIndexBits = 16;
    const NumberFormat& key = stored.depth_key;
    const int entry = ceil_div(key.storage_bits() + kLeastIndexBits, 8);
    visitor.require(key == ProjectionNumbers().depth_key || entry <= traffic.list_entry_bytes,
                    {"traffic.list_entry_bytes",
                     "must hold a depth key of " + key.name() + " and an index of 16 bits at least",
                     std::to_string(entry),
                     {"pipeline.numbers"}});
}

std::vector<std::string> PipelineConfig::parts(bool with_records) const {
    std::vector<std::string> all =
        with_records ? record_formats_of(records) : std::vector<std::string>();
    all.insert(all.end(), numbers.parts.begin(), numbers.parts.end());
    return all;
}

NumberSet PipelineConfig::set(bool with_records) const {
    return number_set(set_of(numbers.base).name, parts(with_records));
}

int PipelineConfig::pixel_bits() const {
    return degs::pixel_bits(set(false));
}

cost::Precision PipelineConfig::precision() const {
    switch (numbers.base) {
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
    const DataPathOptions named = named_numbers(name_of(numbers.base), parts(round_records));
    return {numbers.base, ends, delta, stop_rule, named.set, named.projection, rules};
}

} // namespace degs
