// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/json_entry.hpp"

#include <cmath>

namespace degs {
namespace {

using Json = nlohmann::json;

} // namespace

const Json& JsonEntry::at(const char* key) const {
    const auto found = json_.find(key);
    if (found == json_.end()) {
        place_.fail("has no key '" + std::string(key) + "'; needed are " + needed_ + ".");
    }
    return *found;
}

double JsonEntry::number_in(const Json& value, const std::string& what) const {
    if (!value.is_number()) {
        place_.fail("has a " + what + " that is not a number.");
    }
    const auto number = value.get<double>();
    if (!std::isfinite(number)) {
        place_.fail("has a " + what + " that is not finite.");
    }
    return number;
}

double JsonEntry::number(const char* key) const {
    return number_in(at(key), key);
}

double JsonEntry::positive(const char* key) const {
    const double value = number(key);
    if (!(value > 0)) {
        place_.fail("has a " + std::string(key) + " of " + dump(key) +
                    "; allowed are numbers above 0.");
    }
    return value;
}

int JsonEntry::integer(const char* key, int low, int high) const {
    const double value = number(key);
    if (!(value >= low && value <= high) || value != std::floor(value)) {
        place_.fail("has a " + std::string(key) + " of " + dump(key) +
                    "; allowed are integers from " + std::to_string(low) + " to " +
                    std::to_string(high) + ".");
    }
    return static_cast<int>(value);
}

int JsonEntry::side(const char* key) const {
    return checked_side(place_, key, number(key), dump(key));
}

double JsonEntry::focal_length(const char* key) const {
    return checked_focal_length(place_, key, number(key), dump(key));
}

std::string JsonEntry::text(const char* key) const {
    if (!at(key).is_string()) {
        place_.fail("has a key '" + std::string(key) + "' that is not a text.");
    }
    return at(key).get<std::string>();
}

glm::dvec3 JsonEntry::vector_in(const Json& value, const std::string& what) const {
    if (!value.is_array() || value.size() != 3) {
        place_.fail("has a " + what + " that is not an array of 3 numbers.");
    }
    return {number_in(value[0], what + "[0]"), number_in(value[1], what + "[1]"),
            number_in(value[2], what + "[2]")};
}

glm::dvec3 JsonEntry::vector(const char* key) const {
    return vector_in(at(key), key);
}

std::vector<double> JsonEntry::numbers(const char* key) const {
    const Json& list = at(key);
    if (!list.is_array()) {
        place_.fail("has a " + std::string(key) + " that is not an array of numbers.");
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < list.size(); ++i) {
        numbers.push_back(number_in(list[i], key + ("[" + std::to_string(i) + "]")));
    }
    return numbers;
}

glm::dmat3 JsonEntry::rows(const char* key) const {
    const Json& rows = at(key);
    if (!rows.is_array() || rows.size() != 3) {
        place_.fail("has a " + std::string(key) + " that is not an array of 3 rows of 3 numbers.");
    }
    glm::dmat3 transposed; // GLM constructs columns, the file has rows
    for (int i = 0; i < 3; ++i) {
        transposed[i] = vector_in(rows[i], key + ("[" + std::to_string(i) + "]"));
    }
    return glm::transpose(transposed);
}

glm::dmat4 JsonEntry::affine(const char* key) const {
    const Json& rows = at(key);
    if (!rows.is_array() || rows.size() < 3 || rows.size() > 4) {
        place_.fail("has a " + std::string(key) +
                    " that is not an array of 3 or 4 rows of 4 numbers.");
    }
    glm::dmat4 transposed(1.0);
    for (int i = 0; i < static_cast<int>(rows.size()); ++i) {
        const std::string row = key + ("[" + std::to_string(i) + "]");
        if (!rows[i].is_array() || rows[i].size() != 4) {
            place_.fail("has a " + row + " that is not an array of 4 numbers.");
        }
        for (int j = 0; j < 4; ++j) {
            transposed[i][j] = number_in(rows[i][j], row + "[" + std::to_string(j) + "]");
        }
    }
    if (transposed[3] != glm::dvec4(0, 0, 0, 1)) {
        place_.fail("has a " + std::string(key) + " whose last row is not 0 0 0 1.");
    }
    return glm::transpose(transposed);
}

glm::dmat4 JsonEntry::similarity(const char* key) const {
    const glm::dmat4 matrix = affine(key);
    const double scale = std::cbrt(glm::determinant(glm::dmat3(matrix)));
    if (!(scale > 0) || !std::isfinite(scale)) {
        place_.fail("has a " + std::string(key) +
                    " that cannot be undone; allowed are a rotation, a uniform scale and a "
                    "translation.");
    }
    check_rotation(place_, key, glm::dmat3(matrix) / scale);
    return matrix;
}

} // namespace degs
