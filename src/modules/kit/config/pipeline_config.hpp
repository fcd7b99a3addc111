// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "config/config.hpp"
#include "cost/technology.hpp"
#include "modules/kit/config/number_choice.hpp"
#include "modules/kit/job/traffic.hpp"
#include "splat/frame/frame_workload.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs {

/// Formats of the values of Gaussians in memory, in the order of record_set_names().
enum class Records { Fp32, Fp16, Tuned };

/// The choices of every data path, whichever accelerator uses it.
struct PipelineConfig {
    NumberChoice numbers;
    Records records = Records::Fp16; ///< how many bytes a Gaussian takes in memory
    bool round_records = false;      ///< are Gaussians rounded to these formats before projection?
    StopRule stop_rule = StopRule::Refuse;
    TileMode tiles = TileMode::Box;
    RenderingRules rules;
    void describe(ConfigVisitor& visitor);
    /// Sets the sizes of Gaussians in `traffic`, whose keys are in section `traffic` of `visitor`,
    /// and requires what the keys give to hold the formats; a list entry also holds an index of 16
    /// bits at least (MemoryMap checks that of a frame).
    void describe_records(ConfigVisitor& visitor, TrafficConfig& traffic) const;
    /// Formats of Gaussians in memory, rounded to or not, and of depth keys.
    ProjectionNumbers stored_numbers() const { return set(true).projection_numbers(); }
    /// Bits of a pixel's transmittance and colour in the formats of `numbers`.
    int pixel_bits() const;
    /// Width of `numbers`; single parts in other formats do not count.
    cost::Precision precision() const;
    /// Exact span ends: the pixels inside the ellipse.
    DataPathOptions data_path() const { return options(SpanEnds::Exact, 0); }

protected:
    /// `numbers` with the formats of `records`, if Gaussians are rounded to them.
    DataPathOptions options(SpanEnds ends, int delta) const;

private:
    /// The parts of `numbers` behind the formats of `records`, which they change.
    std::vector<std::string> parts(bool with_records) const;
    NumberSet set(bool with_records) const;
};

} // namespace degs
