// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

/// What the views of a frame (the eyes of a headset) have in common; each step includes those
/// before it. `Nothing`: every view is a frame of its own. `Geometry`: a Gaussian's geometry is
/// read once and projected for every view. `Sh`: its SH coefficients are read once, too, if any
/// view shows it, and evaluated for every view that does. `Colour`: they are evaluated once, for
/// the middle of the views, which changes the images.
enum class ViewSharing { Nothing, Geometry, Sh, Colour };

/// As in configurations and reports.
inline const char* name_of(ViewSharing shared) {
    switch (shared) {
    case ViewSharing::Nothing:
        return "nothing";
    case ViewSharing::Geometry:
        return "geometry";
    case ViewSharing::Sh:
        return "sh";
    default:
        return "colour";
    }
}

} // namespace degs
