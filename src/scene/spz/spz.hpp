// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "scene/files/scene_content.hpp"

namespace degs {

/// Decodes a whole SPZ file that lies in memory: versions 1 to 3 (gzip) and 4 (ZSTD), as
/// nianticlabs/spz reads them. Positions, rotations and colours stay in the axes of the file, which
/// `axes` of the result names: those of its coordinate-system record, else RUB, the convention of
/// SPZ (then axes_assumed is set). Positions of version 1 may be infinite or NaN. Degree 4 of the
/// spherical harmonics is dropped with a note. Before the positions of the Gaussians are decoded,
/// no memory is taken for a number that the header merely claims; afterwards 248 bytes per Gaussian
/// of degree 3. InputError "<where>: <sentence>" for anything that is not such a file.
SceneContent decode_spz(const std::string& where, std::string_view bytes);

/// Reads an .spz file and decodes it. InputError also if it cannot be read.
SceneContent read_spz(const std::string& path);

} // namespace degs
