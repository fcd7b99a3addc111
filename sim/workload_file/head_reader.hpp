// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "splat/numbers/number_format.hpp"

namespace degs::sim {

/// Takes checked values out of a JSON value. Every mistake is an InputError that names the file,
/// the place in the value and what is allowed there.
class HeadReader {
public:
    /// The value outlives the reader.
    HeadReader(std::string path, std::string place, const nlohmann::json& json);

    // Members of an object.
    bool has(const std::string& name) const;
    HeadReader part(const std::string& name) const;
    std::vector<HeadReader> list(const std::string& name) const;
    std::string text(const std::string& name) const;
    /// The place of a text among those that are allowed.
    std::size_t text(const std::string& name, const std::vector<const char*>& allowed) const;
    std::vector<std::string> texts(const std::string& name) const;
    bool flag(const std::string& name) const;
    int number(const std::string& name, int least, int most) const;
    std::uint64_t count(const std::string& name, std::uint64_t least, std::uint64_t most) const;
    double real(const std::string& name, double least, double most) const;
    glm::dvec3 vector(const std::string& name) const { return part(name).vector(); }
    NumberFormat format(const std::string& name) const;

    // The value itself.
    std::uint64_t count(std::uint64_t least, std::uint64_t most) const;
    glm::dvec3 vector() const;

    /// Throws "'<place of the member>' <sentence>." unless `good`.
    void check(const std::string& name, bool good, const std::string& sentence) const;

private:
    HeadReader value(const std::string& name) const;
    double real(double least, double most) const;
    [[noreturn]] void refuse(const std::string& allowed) const;

    std::string path_, place_;
    const nlohmann::json* json_;
};

} // namespace degs::sim
