// SPDX-License-Identifier: Apache-2.0
#include "modules/pipeline_config.hpp"

namespace degs {

void PipelineConfig::describe(ConfigVisitor& visitor) {
    visitor.choice("numbers", numbers, {"fp32", "fp64"}, "arithmetic of spans, alpha and blending");
    visitor.choice(
        "stop_rule", stop_rule, {"refuse", "after"},
        "refuse: the splat that would push T under 1e-4 is not blended (reference code); "
        "after: it is, then the pixel ends (paper, Sec. II-A)");
    visitor.choice("tiles", tiles, {"exact", "ref"},
                   "tile lists: the ellipse's tiles, or the 3-sigma square's");
}

} // namespace degs
