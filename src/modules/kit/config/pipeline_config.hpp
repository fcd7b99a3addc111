// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "config/config_changes.hpp"
#include "cost/technology.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// Whose formats the values of Gaussians have in memory: those of `numbers`, or of a named set.
enum class Records { Numbers, Fp32, Fp16, Paper, Tuned };

/// The choices of every data path, whichever accelerator uses it.
struct PipelineConfig {
    Arithmetic numbers = Arithmetic::Fp32;
    /// The same for all accelerators, so that they are compared with equal records; docs/numbers.md
    /// says why these.
    Records records = Records::Tuned;
    StopRule stop_rule = StopRule::Refuse;
    TileMode tiles = TileMode::Exact;
    RenderingRules rules;
    ConfigChanges formats; ///< of the number set that `numbers` names
    void describe(ConfigVisitor& visitor);
    /// Records of `geometry_bytes`, SH values of `sh_value_bytes` (0: as the formats need) and list
    /// entries hold the formats of `records` and `formats`; an entry also holds an index of 16 bits
    /// at least (MemoryMap checks that of a frame). Keys of the records are in section `traffic` of
    /// `visitor`.
    void require_records(ConfigVisitor& visitor, int geometry_bytes, int sh_value_bytes,
                         int list_entry_bytes) const;
    /// Formats of Gaussians in memory, of depth keys and of the projection.
    ProjectionNumbers projection_numbers() const { return changed_set().projection_numbers(); }
    /// Bits of a pixel's transmittance and colour in the formats of `numbers` and `formats`.
    int pixel_bits() const;
    /// Width of `numbers`; single parts in other formats do not count.
    cost::Precision precision() const;
    /// Exact span ends: the pixels inside the ellipse.
    DataPathOptions data_path() const { return options(SpanEnds::Exact, 0); }

protected:
    /// `numbers` with the formats of `records` and the changes of `formats`.
    DataPathOptions options(SpanEnds ends, int delta) const;

private:
    /// "key=value" for the formats of `records`.
    std::vector<std::string> record_formats() const;
    NumberSet changed_set() const;
};

} // namespace degs
