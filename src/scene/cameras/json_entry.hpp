// SPDX-License-Identifier: Apache-2.0
// The values of one JSON object in a camera file.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/cameras/camera_place.hpp"

namespace degs {

/// Every failure is an InputError that names the file, the entry and the key.
class JsonEntry {
public:
    /// `needed` lists the keys that an entry must have, for messages. All of them outlive this
    /// object.
    JsonEntry(const CameraPlace& place, const nlohmann::json& json, const char* needed)
        : place_(place), json_(json), needed_(needed) {}

    bool has(const char* key) const { return json_.contains(key); }
    const nlohmann::json& at(const char* key) const;
    /// Finite.
    double number(const char* key) const;
    /// Above 0 and finite.
    double positive(const char* key) const;
    int integer(const char* key, int low, int high) const;
    int side(const char* key) const;
    double focal_length(const char* key) const;
    std::string text(const char* key) const;
    glm::dvec3 vector(const char* key) const;
    /// Finite ones, as many as there are.
    std::vector<double> numbers(const char* key) const;
    /// 3 rows of 3 numbers.
    glm::dmat3 rows(const char* key) const;
    /// Up to 4 rows of 4 numbers, at least 3; a fourth one must be 0 0 0 1.
    glm::dmat4 affine(const char* key) const;
    /// A matrix as affine() reads it, of a rotation, a uniform scale and a translation; no
    /// mirroring.
    glm::dmat4 similarity(const char* key) const;

private:
    double number_in(const nlohmann::json& value, const std::string& what) const;
    glm::dvec3 vector_in(const nlohmann::json& value, const std::string& what) const;
    std::string dump(const char* key) const { return dump_json(at(key)); }

    const CameraPlace& place_;
    const nlohmann::json& json_;
    const char* needed_;
};

} // namespace degs
