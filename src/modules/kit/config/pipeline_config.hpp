// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "config/config_changes.hpp"
#include "cost/technology.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// The choices of every data path, whichever accelerator uses it.
struct PipelineConfig {
    Arithmetic numbers = Arithmetic::Fp32;
    StopRule stop_rule = StopRule::Refuse;
    TileMode tiles = TileMode::Exact;
    RenderingRules rules;
    ConfigChanges formats; ///< of the number set that `numbers` names
    void describe(ConfigVisitor& visitor);
    /// Formats of SH coefficients and depth keys, if `formats` sets them, fit such records; an
    /// entry also holds an index of 16 bits at least (MemoryMap checks that of a frame). Keys of
    /// the records are in section `traffic` of `visitor`.
    void require_records(ConfigVisitor& visitor, int sh_value_bytes, int list_entry_bytes) const;
    /// Bits of a pixel's transmittance and colour in the formats of `numbers` and `formats`.
    int pixel_bits() const;
    /// Width of `numbers`; single parts in other formats do not count.
    cost::Precision precision() const;
    /// Exact span ends: the pixels inside the ellipse.
    DataPathOptions data_path() const { return options(SpanEnds::Exact, 0); }

protected:
    /// `numbers` with the changes of `formats`.
    DataPathOptions options(SpanEnds ends, int delta) const;
};

} // namespace degs
