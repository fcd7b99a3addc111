// SPDX-License-Identifier: Apache-2.0
#include "scene/camera_entry.hpp"

#include <cmath>
#include <limits>

#include "scene/input_file.hpp"

namespace degs {
namespace {

using Json = nlohmann::json;

constexpr int kMaxSide = 65536;          // px
constexpr double kMaxFocal = 1e9;        // px
constexpr double kOrthonormality = 1e-3; // largest deviation of an entry of R^T R from identity

/// One entry of the array, with the file and position for messages.
class CameraEntry {
public:
    CameraEntry(const std::string& path, std::size_t index, const Json& json)
        : path_(path), index_(index), json_(json) {}

    Camera parse() const {
        constexpr int kMaxInt = std::numeric_limits<int>::max();
        Camera camera;
        camera.id =
            json_.contains("id") ? integer("id", -kMaxInt, kMaxInt) : static_cast<int>(index_);
        camera.name = name();
        camera.width = integer("width", 1, kMaxSide);
        camera.height = integer("height", 1, kMaxSide);
        camera.fx = focal("fx");
        camera.fy = focal("fy");
        camera.position = vector(at("position"), "position");
        camera.camera_to_world = rotation();
        return camera;
    }

private:
    [[noreturn]] void fail(const std::string& sentence) const {
        fail_camera(path_, index_, sentence);
    }

    const Json& at(const char* key) const {
        const auto found = json_.find(key);
        if (found == json_.end()) {
            fail("has no key '" + std::string(key) +
                 "'; needed are width, height, position, rotation, fx and fy.");
        }
        return *found;
    }

    std::string name() const {
        const auto found = json_.find("img_name");
        if (found == json_.end()) {
            return "camera " + std::to_string(index_);
        }
        if (!found->is_string()) {
            fail("has an img_name that is not a text.");
        }
        return found->get<std::string>();
    }

    /// `what` is a key or a place inside one.
    double number(const Json& value, const std::string& what) const {
        if (!value.is_number()) {
            fail("has a " + what + " that is not a number.");
        }
        const auto number = value.get<double>();
        if (!std::isfinite(number)) {
            fail("has a " + what + " that is not finite.");
        }
        return number;
    }

    int integer(const char* key, int low, int high) const {
        const double value = number(at(key), key);
        if (!(value >= low && value <= high) || value != std::floor(value)) {
            fail("has a " + std::string(key) + " of " + at(key).dump() +
                 "; allowed are integers from " + std::to_string(low) + " to " +
                 std::to_string(high) + ".");
        }
        return static_cast<int>(value);
    }

    double focal(const char* key) const {
        const double value = number(at(key), key);
        if (!(value > 0 && value <= kMaxFocal)) {
            fail("has a focal length " + std::string(key) + " of " + at(key).dump() +
                 "; allowed are more than 0 and at most 1e9 pixels.");
        }
        return value;
    }

    glm::dvec3 vector(const Json& value, const std::string& what) const {
        if (!value.is_array() || value.size() != 3) {
            fail("has a " + what + " that is not an array of 3 numbers.");
        }
        return {number(value[0], what + "[0]"), number(value[1], what + "[1]"),
                number(value[2], what + "[2]")};
    }

    glm::dmat3 rotation() const {
        const Json& rows = at("rotation");
        if (!rows.is_array() || rows.size() != 3) {
            fail("has a rotation that is not an array of 3 rows of 3 numbers.");
        }
        glm::dmat3 transposed; // GLM constructs columns, the file has rows
        for (int i = 0; i < 3; ++i) {
            transposed[i] = vector(rows[i], "rotation[" + std::to_string(i) + "]");
        }
        check_rotation(transposed);
        return glm::transpose(transposed);
    }

    void check_rotation(const glm::dmat3& matrix) const {
        const glm::dmat3 product = glm::transpose(matrix) * matrix;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                if (!(std::abs(product[i][j] - (i == j ? 1 : 0)) <= kOrthonormality)) {
                    fail("has a rotation whose rows are not orthogonal unit vectors within 1e-3.");
                }
            }
        }
        if (!(glm::determinant(matrix) > 0)) {
            fail(
                "has a rotation that mirrors (determinant -1); only proper rotations are allowed.");
        }
    }

    const std::string& path_;
    std::size_t index_;
    const Json& json_;
};

} // namespace

void fail_camera(const std::string& path, std::size_t index, const std::string& sentence) {
    fail_file(path, "camera " + std::to_string(index) + " " + sentence);
}

Camera parse_camera(const std::string& path, std::size_t index, const nlohmann::json& entry) {
    return CameraEntry(path, index, entry).parse();
}

} // namespace degs
