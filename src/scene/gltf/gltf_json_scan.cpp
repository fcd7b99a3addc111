// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include <nlohmann/json.hpp>

#include "scene/files/input_file.hpp"
#include "scene/gltf/gltf_source.hpp"

namespace degs {
namespace {

using ScannedJson = nlohmann::json;

constexpr std::size_t kMostJsonDepth = 64;
constexpr std::uint64_t kMostJsonValues = 1U << 18U;

/// Sees every value of a JSON text without keeping it. Memory: one frame per open object or array.
class GltfJsonScan : public nlohmann::json_sax<ScannedJson> {
public:
    explicit GltfJsonScan(std::string path) : path_(std::move(path)) {}

    std::vector<GltfBuffer> take_buffers() { return std::move(buffers_); }

    bool null() override { return count_value(); }
    bool boolean(bool /*value*/) override { return count_value(); }
    bool number_integer(number_integer_t value) override {
        return value < std::numeric_limits<std::int32_t>::min()
                   ? refuse_integer(std::to_string(value))
                   : count_value();
    }
    bool number_unsigned(number_unsigned_t value) override {
        if (in_buffer() && key_ == "byteLength") {
            buffers_.back().bytes = value;
        }
        return value > std::numeric_limits<std::uint32_t>::max()
                   ? refuse_integer(std::to_string(value))
                   : count_value();
    }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override {
        return count_value();
    }
    bool string(string_t& value) override {
        if (in_buffer() && key_ == "uri") {
            buffers_.back().uri = std::move(value);
        }
        return count_value();
    }
    bool binary(binary_t& /*value*/) override { return count_value(); }

    bool start_object(std::size_t /*elements*/) override {
        if (frames_.size() == 2 && frames_[1].array && frames_[1].name == "buffers") {
            buffers_.emplace_back();
        }
        return open(false);
    }
    bool key(string_t& name) override {
        key_ = name;
        return true;
    }
    bool end_object() override { return close(); }
    bool start_array(std::size_t /*elements*/) override { return open(true); }
    bool end_array() override { return close(); }

    bool parse_error(std::size_t position, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        fail_file(path_, "the JSON of the glTF is malformed at its byte " +
                             std::to_string(position) + ".");
    }

private:
    struct Frame {
        bool array;
        bool extras;      ///< at or below a member `extras`, which belongs to applications
        std::string name; ///< the key of this value; empty inside an array
    };

    bool open(bool array) {
        count_value();
        if (frames_.size() == kMostJsonDepth) {
            fail_file(path_, "the JSON of the glTF is nested deeper than " +
                                 std::to_string(kMostJsonDepth) + " levels.");
        }
        const bool extras = !frames_.empty() && (frames_.back().extras || own_key() == "extras");
        frames_.push_back({array, extras, own_key()});
        return true;
    }
    bool close() {
        frames_.pop_back();
        return true;
    }
    std::string own_key() const {
        return frames_.empty() || frames_.back().array ? std::string{} : key_;
    }
    bool in_buffer() const {
        return frames_.size() == 3 && !frames_[2].array && frames_[1].array &&
               frames_[1].name == "buffers";
    }
    bool count_value() {
        if (++values_ > kMostJsonValues) {
            fail_file(path_, "the JSON of the glTF holds more than " +
                                 std::to_string(kMostJsonValues) +
                                 " values; many instances of a mesh are written shorter with "
                                 "EXT_mesh_gpu_instancing.");
        }
        return true;
    }
    bool refuse_integer(const std::string& value) {
        if (frames_.empty() || frames_.back().extras || own_key() == "extras") {
            return count_value();
        }
        fail_file(path_, "the JSON of the glTF holds the integer " + value +
                             (own_key().empty() ? "" : " in '" + visible_key() + "'") +
                             ", which has more than 32 bits.");
    }
    std::string visible_key() const {
        std::string text = key_.substr(0, 40);
        for (char& c : text) {
            c = c < ' ' || c > '~' ? '?' : c;
        }
        return text;
    }

    std::string path_;
    std::string key_;
    std::vector<Frame> frames_;
    std::vector<GltfBuffer> buffers_;
    std::uint64_t values_ = 0;
};

} // namespace

std::vector<GltfBuffer> scan_gltf_json(const std::string& path, const char* begin,
                                       const char* end) {
    GltfJsonScan scan(path);
    ScannedJson::sax_parse(begin, end, &scan);
    return scan.take_buffers();
}

} // namespace degs
