// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <utility>

#include "scene/cameras/colmap_files.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kLeastCameraBytes = 24 + 3 * 8; ///< of a camera with one focal length
constexpr std::uint64_t kLeastImageBytes = 4 + 7 * 8 + 4 + 1 + 8; ///< without a name and points
constexpr std::uint64_t kPointBytes = 24;

/// Little-endian values of a file; every failure names the record.
class ColmapReader {
public:
    explicit ColmapReader(const std::string& path) : file_(path) {}

    /// The number of records, after which `least_bytes` each must fit into the rest of the file.
    std::uint64_t records(const char* kind, std::uint64_t least_bytes) {
        if (file_.size() < sizeof(std::uint64_t)) {
            fail_file(file_.path(), "the file has " + std::to_string(file_.size()) +
                                        " bytes, and the count at its start takes 8.");
        }
        const auto count = get<std::uint64_t>(CameraPlace(file_.path(), "the count"));
        if (count > file_.remaining() / least_bytes) {
            fail_file(file_.path(), "the file announces " + std::to_string(count) + " " + kind +
                                        " of at least " + std::to_string(least_bytes) +
                                        " bytes, and has " + std::to_string(file_.remaining()) +
                                        " bytes left.");
        }
        return count;
    }

    void require(const CameraPlace& place, std::uint64_t bytes) const {
        if (file_.remaining() < bytes) {
            place.fail("is cut off: it needs " + std::to_string(bytes) +
                       " more bytes, and the file has " + std::to_string(file_.remaining()) + ".");
        }
    }

    template <class Value>
    Value get(const CameraPlace& place) {
        require(place, sizeof(Value));
        char bytes[sizeof(Value)];
        file_.read_exactly(bytes, sizeof bytes);
        Value value;
        std::memcpy(&value, bytes, sizeof value); // the supported machines are little-endian
        return value;
    }

    std::string name(const CameraPlace& place) {
        std::string name;
        for (char c = get<char>(place); c != '\0'; c = get<char>(place)) {
            if (name.size() == kMostImageName) {
                place.fail("has a name of more than " + std::to_string(kMostImageName) + " bytes.");
            }
            name += c;
        }
        return name;
    }

    void skip_points(const CameraPlace& place) {
        const auto points = get<std::uint64_t>(place);
        if (points > file_.remaining() / kPointBytes) {
            place.fail("announces " + std::to_string(points) +
                       " points of 24 bytes, and the file has " +
                       std::to_string(file_.remaining()) + " bytes left.");
        }
        file_.skip(points * kPointBytes);
    }

    void expect_end() const {
        if (file_.remaining() != 0) {
            fail_file(file_.path(), "the file has " + std::to_string(file_.remaining()) +
                                        " bytes behind its last record.");
        }
    }

private:
    InputFile file_;
};

} // namespace

ColmapCameras read_colmap_cameras_binary(const std::string& path) {
    ColmapReader reader(path);
    const std::uint64_t count = reader.records("cameras", kLeastCameraBytes);
    ColmapCameras cameras;
    for (std::uint64_t i = 0; i < count; ++i) {
        const CameraPlace place(path, "camera " + std::to_string(i));
        const auto id = reader.get<std::uint32_t>(place);
        const ColmapModel& model = colmap_model(place, reader.get<std::int32_t>(place));
        const auto width = static_cast<double>(reader.get<std::uint64_t>(place));
        const auto height = static_cast<double>(reader.get<std::uint64_t>(place));
        std::vector<double> parameters(model.parameters);
        for (double& value : parameters) {
            value = reader.get<double>(place);
        }
        cameras.add(colmap_camera(place, id, model, width, height, parameters));
    }
    reader.expect_end();
    return cameras;
}

std::vector<Camera> read_colmap_images_binary(const std::string& path,
                                              const ColmapCameras& cameras) {
    ColmapReader reader(path);
    const std::uint64_t count = reader.records("images", kLeastImageBytes);
    std::vector<Camera> views;
    views.reserve(count);
    for (std::uint64_t i = 0; i < count; ++i) {
        const CameraPlace place(path, "image " + std::to_string(i));
        const auto id = reader.get<std::uint32_t>(place);
        ColmapPose pose;
        for (double& value : pose.rotation) {
            value = reader.get<double>(place);
        }
        for (double& value : pose.translation) {
            value = reader.get<double>(place);
        }
        const auto camera = reader.get<std::uint32_t>(place);
        std::string name = reader.name(place);
        reader.skip_points(place);
        views.push_back(cameras.view(place, id, camera, pose, std::move(name)));
    }
    reader.expect_end();
    return views;
}

} // namespace degs
