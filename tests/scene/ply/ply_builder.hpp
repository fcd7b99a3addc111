// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

namespace degs::test {

/// Builds PLY files, right and wrong ones, with an encoder that shares nothing with the library.
struct PlyBuilder {
    struct Property {
        std::string type, name;
    };
    std::string format = "binary_little_endian";
    std::string before;      ///< header lines of elements in front of the vertices
    std::string after;       ///< header lines behind them
    std::string body_before; ///< data of the elements in front
    std::string body_after;
    std::string count; ///< as written in the header; the number of rows if empty
    std::string line_end = "\n";
    std::vector<Property> properties;
    std::vector<std::vector<double>> rows;

    /// The layout of the original code, degree 0..3.
    static PlyBuilder splat(int rest_count = 0) {
        PlyBuilder ply;
        ply.add({"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"});
        for (int i = 0; i < rest_count; ++i) {
            ply.add({"f_rest_" + std::to_string(i)});
        }
        ply.add({"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"});
        return ply;
    }
    void add(const std::vector<std::string>& names, const std::string& type = "float") {
        for (const std::string& name : names) {
            properties.push_back({type, name});
        }
    }
    void remove(const std::string& name) {
        properties.erase(std::remove_if(properties.begin(), properties.end(),
                                        [&](const Property& p) { return p.name == name; }),
                         properties.end());
    }
    /// One row whose values `value` gives by property name.
    void add_row(const std::function<double(const std::string&)>& value) {
        std::vector<double> row;
        for (const Property& property : properties) {
            row.push_back(value(property.name));
        }
        rows.push_back(std::move(row));
    }

    std::string header() const {
        std::string text = "ply\nformat " + format + " 1.0\ncomment made for a test\n" + before +
                           "element vertex " +
                           (count.empty() ? std::to_string(rows.size()) : count) + "\n";
        for (const Property& property : properties) {
            text += "property " + property.type + " " + property.name + "\n";
        }
        text += after + "end_header\n";
        std::string out;
        for (const char c : text) {
            out += c == '\n' ? line_end : std::string(1, c);
        }
        return out;
    }
    std::string body() const {
        std::string out;
        for (const std::vector<double>& row : rows) {
            for (std::size_t i = 0; i < row.size(); ++i) {
                out += encode(properties[i].type, row[i]);
            }
            out += format == "ascii" ? line_end : "";
        }
        return out;
    }
    std::string file() const { return header() + body_before + body() + body_after; }

    std::string encode(const std::string& type, double value) const {
        if (format == "ascii") {
            char text[40];
            std::snprintf(text, sizeof text, "%.17g ", value);
            return text;
        }
        if (type == "float" || type == "float32") {
            return bytes(static_cast<float>(value));
        }
        if (type == "double" || type == "float64") {
            return bytes(value);
        }
        return encode_integer(type, static_cast<std::int64_t>(value));
    }

private:
    std::string encode_integer(const std::string& type, std::int64_t value) const {
        if (type == "char" || type == "int8" || type == "uchar" || type == "uint8") {
            return bytes(static_cast<std::uint8_t>(value));
        }
        if (type == "short" || type == "int16" || type == "ushort" || type == "uint16") {
            return bytes(static_cast<std::uint16_t>(value));
        }
        return bytes(static_cast<std::uint32_t>(value));
    }
    template <class Value>
    std::string bytes(Value value) const { // tests run on little-endian machines
        std::string out(sizeof value, '\0');
        std::memcpy(out.data(), &value, sizeof value);
        if (format == "binary_big_endian") {
            std::reverse(out.begin(), out.end());
        }
        return out;
    }
};

} // namespace degs::test
