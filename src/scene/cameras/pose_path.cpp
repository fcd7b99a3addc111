// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/pose_path.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "scene/cameras/camera_place.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{256} << 20U;
constexpr double kLargest = 1e9;      // of positions
constexpr double kLatest = 1e10;      // of times, s: those since 1970 are below 2e9
constexpr double kLengthSlack = 1e-3; // of quaternions, as of the matrices of camera files

constexpr std::array<const char*, 8> kColumns{"time_s", "x", "y", "z", "qw", "qx", "qy", "qz"};

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) {
        return {};
    }
    return text.substr(begin, text.find_last_not_of(" \t\r") + 1 - begin);
}

/// RFC 4180 lets every cell be in quotes; neither numbers nor names of columns hold any.
std::string_view unquoted(std::string_view cell) {
    const bool quoted = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
    return quoted ? trimmed(cell.substr(1, cell.size() - 2)) : cell;
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t begin = 0;;) {
        const std::size_t end = line.find(',', begin);
        cells.push_back(unquoted(trimmed(line.substr(begin, end - begin))));
        if (end == std::string_view::npos) {
            return cells;
        }
        begin = end + 1;
    }
}

/// Positions of kColumns among the names of the first line.
std::array<std::size_t, kColumns.size()> columns_of(const CameraPlace& place,
                                                    const std::vector<std::string_view>& names) {
    std::array<std::size_t, kColumns.size()> columns{};
    if (names.size() == 1 && names.front().find(kColumns.front()) != std::string_view::npos) {
        place.fail("has one cell, " + in_quotes(names.front()) +
                   "; commas separate the columns, and no other character does.");
    }
    for (const std::string_view name : names) {
        if (!name.empty() && name.front() == '"') {
            place.fail("has the cell " + in_quotes(name) + ", whose quote does not end.");
        }
    }
    for (std::size_t i = 0; i < kColumns.size(); ++i) {
        const auto found = std::find(names.begin(), names.end(), kColumns[i]);
        const auto count = std::count(names.begin(), names.end(), kColumns[i]);
        if (count != 1) {
            place.fail(std::string(count == 0 ? "lacks" : "has twice") + " the column '" +
                       kColumns[i] +
                       "'; the first line of recorded poses names the columns time_s, x, y, z, qw, "
                       "qx, qy and qz.");
        }
        columns[i] = found - names.begin();
    }
    return columns;
}

double number_of(const CameraPlace& place, const char* column, std::string_view text) {
    const bool time = column == kColumns.front();
    const double most = time ? kLatest : kLargest;
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !(std::abs(value) <= most)) {
        place.fail("has a " + std::string(column) + " of " + in_quotes(text) +
                   (time ? ", which is not a number of seconds from -1e10 to 1e10."
                         : ", which is not a number from -1e9 to 1e9."));
    }
    return value;
}

Pose pose_from(const CameraPlace& place, const std::array<double, kColumns.size()>& v) {
    Pose pose{v[0], {v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}};
    const double length = glm::length(pose.rotation);
    if (!(std::abs(length - 1) <= kLengthSlack)) {
        place.fail("has a quaternion of length " + std::to_string(length) +
                   ", but a rotation has one of length 1.");
    }
    pose.rotation = glm::normalize(pose.rotation);
    return pose;
}

/// From the view axes of a Camera (y down, z forward) to those of a Pose, and back.
glm::dmat3 flipped(const glm::dmat3& axes) {
    return {axes[0], -axes[1], -axes[2]};
}

} // namespace

std::vector<Pose> read_poses(const std::string& file) {
    const std::string text = read_text(file, kMostBytes);
    std::array<std::size_t, kColumns.size()> columns{};
    std::size_t width = 0, number = 0;
    std::vector<Pose> poses;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = trimmed(std::string_view(text).substr(begin, end - begin));
        begin = end + 1;
        const CameraPlace place(file, "line " + std::to_string(++number));
        if (line.empty() || line.front() == '#') {
            continue;
        }
        const std::vector<std::string_view> cells = cells_of(line);
        if (width == 0) {
            columns = columns_of(place, cells);
            width = cells.size();
            continue;
        }
        if (cells.size() != width) {
            place.fail("has " + std::to_string(cells.size()) + " cells, but there are " +
                       std::to_string(width) + " columns.");
        }
        std::array<double, kColumns.size()> values{};
        for (std::size_t i = 0; i < kColumns.size(); ++i) {
            values[i] = number_of(place, kColumns[i], cells[columns[i]]);
        }
        poses.push_back(pose_from(place, values));
        if (poses.size() > 1 && !(poses[poses.size() - 2].time_s < poses.back().time_s)) {
            place.fail("has a time_s that is not later than that of the pose before.");
        }
    }
    if (poses.empty()) {
        fail_file(file, "It has no pose.");
    }
    return poses;
}

Pose pose_at(const std::vector<Pose>& poses, double time_s) {
    const auto later =
        std::upper_bound(poses.begin(), poses.end(), time_s,
                         [](double time, const Pose& pose) { return time < pose.time_s; });
    if (later == poses.begin() || later == poses.end()) {
        Pose pose = later == poses.begin() ? poses.front() : poses.back();
        pose.time_s = time_s;
        return pose;
    }
    const Pose& before = *(later - 1);
    const double share = (time_s - before.time_s) / (later->time_s - before.time_s);
    return {time_s, glm::mix(before.position, later->position, share),
            glm::normalize(glm::slerp(before.rotation, later->rotation, share))};
}

Pose pose_of(const Camera& camera, double time_s) {
    return {time_s, camera.position,
            glm::normalize(glm::quat_cast(flipped(camera.camera_to_world)))};
}

Camera placed(const Camera& camera, const Pose& pose) {
    Camera moved = camera;
    moved.position = pose.position;
    moved.camera_to_world = flipped(glm::mat3_cast(pose.rotation));
    return moved;
}

std::vector<Pose> started_at(const std::vector<Pose>& poses, const Pose& start, double scale) {
    const Pose first = poses.front();
    const glm::dquat turn = start.rotation * glm::inverse(first.rotation);
    std::vector<Pose> moved = poses;
    for (Pose& pose : moved) {
        pose.position = start.position + turn * ((pose.position - first.position) * scale);
        pose.rotation = glm::normalize(turn * pose.rotation);
    }
    return moved;
}

} // namespace degs
