// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "scene/camera_entry.hpp"
#include "scene/input_file.hpp"

namespace degs {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxFileBytes = 256U << 20U;
constexpr std::array<const char*, 8> kKeys{"id", "img_name", "width",    "height",
                                           "fx", "fy",       "position", "rotation"};
constexpr int kMostValues = 13; ///< of a key: a rotation is an array of 3 arrays of 3 numbers
constexpr int kMostDepth = 64;  ///< of arrays and objects inside each other
constexpr std::size_t kMostKeys = 256; ///< of a camera

/// Listens to the parser of the JSON library. It keeps the values of one camera at a time, and of
/// these only the keys that it needs, so that a file cannot take memory that its cameras do not.
class CameraListener {
public:
    explicit CameraListener(const std::string& path) : path_(path) {}

    /// Whether the parser is to keep what it has found; `depth` counts the arrays and objects
    /// around it. Throws InputError.
    bool hear(int depth, Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        switch (event) {
        case Event::key:
            return depth != kInEntry || hear_key(value.get_ref<const std::string&>());
        case Event::object_end:
            return depth != kEntry || end_entry(value);
        case Event::array_end:
            return true;
        default:
            hear_value(depth, event, value);
            return true;
        }
    }

    std::vector<Camera> take() { return std::move(cameras_); }

private:
    static constexpr int kFile = 0, kEntry = 1, kInEntry = 2;

    [[noreturn]] void fail(const std::string& sentence) const {
        fail_camera(path_, cameras_.size(), sentence);
    }

    void hear_value(int depth, Json::parse_event_t event, const Json& value) {
        const bool array = event == Json::parse_event_t::array_start;
        const bool object = event == Json::parse_event_t::object_start;
        if (depth == kFile && !array) {
            fail_file(path_, "a camera file is a JSON array of cameras, and this is a single " +
                                 std::string(object ? "object" : value.type_name()) + ".");
        }
        if (depth == kEntry && !object) {
            fail("is not an object with the keys width, height, position, rotation, fx and fy.");
        }
        if (depth >= kInEntry && wanted_ && ++values_ > kMostValues) {
            fail("has more values in its '" + key_ + "' than any key needs.");
        }
        if (depth > kMostDepth) {
            fail("has arrays or objects more than " + std::to_string(kMostDepth) +
                 " deep inside each other.");
        }
    }

    bool hear_key(const std::string& key) {
        if (!seen_.insert(key).second) {
            fail("has the key '" + key + "' twice.");
        }
        if (seen_.size() > kMostKeys) {
            fail("has more than " + std::to_string(kMostKeys) + " keys.");
        }
        wanted_ = std::find(kKeys.begin(), kKeys.end(), key) != kKeys.end();
        values_ = 0;
        key_ = wanted_ ? key : std::string();
        return wanted_;
    }

    bool end_entry(const Json& entry) {
        cameras_.push_back(parse_camera(path_, cameras_.size(), entry));
        seen_.clear();
        return false;
    }

    const std::string& path_;
    std::vector<Camera> cameras_;
    std::set<std::string> seen_; ///< keys of this entry
    std::string key_;            ///< the last of them, if it is wanted
    bool wanted_ = false;
    int values_ = 0; ///< of that key so far
};

} // namespace

std::vector<Camera> read_cameras(const std::string& path) {
    InputFile file(path);
    file.require_at_most(kMaxFileBytes);
    CameraListener listener(path);
    try {
        const Json rest =
            Json::parse(file.stream(), [&](int depth, Json::parse_event_t event, Json& value) {
                return listener.hear(depth, event, value);
            });
    } catch (const Json::parse_error& error) {
        fail_file(path, "this is not valid JSON (at byte " + std::to_string(error.byte) +
                            "); a camera file is a JSON array of cameras.");
    } catch (const Json::exception&) { // a number beyond double
        fail_file(path, "a number in this JSON file is out of range.");
    }
    std::vector<Camera> cameras = listener.take();
    if (cameras.empty()) {
        fail_file(path, "the array holds no camera; at least one is needed.");
    }
    return cameras;
}

} // namespace degs
