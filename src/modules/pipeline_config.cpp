// SPDX-License-Identifier: Apache-2.0
#include "modules/pipeline_config.hpp"

namespace degs {

void PipelineConfig::describe(ConfigVisitor& visitor) {
    visitor.choice("numbers", numbers, number_format_names(),
                   "arithmetic of spans, alpha and blending: the machine's fp32 or fp64 (ideal is "
                   "fp64), or the formats of a number set");
    visitor.choice(
        "stop_rule", stop_rule, {"refuse", "after"},
        "refuse: the splat that would push T under 1e-4 is not blended (reference code); "
        "after: it is, then the pixel ends (paper, Sec. II-A)");
    visitor.choice("tiles", tiles, {"exact", "ref"},
                   "tile lists: the ellipse's tiles, or the 3-sigma square's");
}

} // namespace degs
