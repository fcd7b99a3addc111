// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>

namespace degs {

/// Three scalars of any arithmetic, machine floats or Rounded; sums run from x to z, as glm's do.
template <class Scalar>
struct Vector3 {
    Scalar x, y, z;

    friend Vector3 operator-(const Vector3& p, const Vector3& q) {
        return {p.x - q.x, p.y - q.y, p.z - q.z};
    }
    friend Vector3 operator*(const Vector3& p, const Vector3& q) { // per component
        return {p.x * q.x, p.y * q.y, p.z * q.z};
    }
    friend Vector3 operator*(const Vector3& p, Scalar s) { return {p.x * s, p.y * s, p.z * s}; }
};

template <class Scalar>
Scalar dot(const Vector3<Scalar>& p, const Vector3<Scalar>& q) {
    return p.x * q.x + p.y * q.y + p.z * q.z;
}

template <class Scalar>
Vector3<Scalar> cross(const Vector3<Scalar>& p, const Vector3<Scalar>& q) {
    return {p.y * q.z - q.y * p.z, p.z * q.x - q.z * p.x, p.x * q.y - q.x * p.y};
}

/// Every component rounded once to the numbers' format.
template <class Numbers>
Vector3<typename Numbers::Scalar> vector_in(const Numbers& numbers, const glm::dvec3& v) {
    return {numbers(v.x), numbers(v.y), numbers(v.z)};
}

} // namespace degs
