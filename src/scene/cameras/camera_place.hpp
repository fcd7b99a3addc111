// SPDX-License-Identifier: Apache-2.0
// What the readers of camera files have in common: messages that name the entry, and the rules that
// every camera obeys.
#pragma once

#include <string>

#include <glm/glm.hpp>

#include "splat/model/camera.hpp"

namespace degs {

constexpr int kMostCameraSide = 65536;   ///< px
constexpr double kMostFocalLength = 1e9; ///< px

/// The entry of a file that is being read.
class CameraPlace {
public:
    /// `entry` is the subject of the sentences, e.g. "camera 3". `path` outlives this object.
    CameraPlace(const std::string& path, std::string entry)
        : path_(path), entry_(std::move(entry)) {}

    /// Throws InputError "<path>: <entry> <sentence>".
    [[noreturn]] void fail(const std::string& sentence) const;

    const std::string& path() const { return path_; }
    const std::string& entry() const { return entry_; }

private:
    const std::string& path_;
    std::string entry_;
};

/// `value` as a side of an image. `name` and `text` are the key and the value as the file has them.
/// Throws InputError unless it is an integer from 1 to kMostCameraSide.
int checked_side(const CameraPlace& place, const std::string& name, double value,
                 const std::string& text);

/// Throws InputError unless 0 < `value` <= kMostFocalLength.
double checked_focal_length(const CameraPlace& place, const std::string& name, double value,
                            const std::string& text);

/// Throws InputError unless the rows of the matrix are orthogonal unit vectors within 1e-3 and it
/// does not mirror. `name` is the key.
void check_rotation(const CameraPlace& place, const std::string& name, const glm::dmat3& matrix);

/// Puts the principal point `cx`, `cy` px from the upper left corner of the image, so that the
/// centre of its first pixel lies at 0.5, 0.5. Throws InputError if that takes a raster with a side
/// of more than kMostRasterSide.
void set_principal_point(const CameraPlace& place, double cx, double cy, Camera& camera);

} // namespace degs
