// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog_meta.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/scene_folder.hpp"

namespace degs {
namespace {

using Json = nlohmann::json;

class MetaParser {
public:
    MetaParser(const std::string& where, const Json& root) : where_(where), root_(root) {}

    SogMeta parse() {
        const Json* const version =
            root_.is_object() && root_.contains("version") ? &root_["version"] : nullptr;
        if (!root_.is_object() || (version != nullptr && *version != 1 && *version != 2)) {
            fail("must be an object of version 1 or 2");
        }
        version_2_ = version != nullptr && *version == 2;
        meta_.antialiased = root_.contains("antialias") && root_["antialias"] == true;
        take_model();
        meta_.count = version_2_ ? whole(root_, "count") : shape_of_means();
        const Json& means = section("means");
        check_bounds(means, 3);
        for (int axis = 0; axis < 3; ++axis) {
            meta_.low[axis] = number(means, "mins", axis);
            meta_.high[axis] = number(means, "maxs", axis);
        }
        meta_.means_low = file(means, "means", 0);
        meta_.means_high = file(means, "means", 1);
        meta_.scales = file(section("scales"), "scales", 0);
        meta_.quats = file(section("quats"), "quats", 0);
        meta_.sh0 = file(section("sh0"), "sh0", 0);
        fill_tables();
        if (root_.contains("shN")) {
            parse_rest(section("shN"));
        }
        return std::move(meta_);
    }

private:
    void take_model() {
        if (!root_.contains("model")) {
            return;
        }
        if (!root_["model"].is_string()) {
            fail("has a 'model' that is no text");
        }
        meta_.model = root_["model"].get<std::string>();
    }

    [[noreturn]] void fail(const std::string& what) const {
        fail_file(where_, "its meta.json " + what + ", so this is no SOG scene.");
    }

    const Json& section(const char* name) const {
        if (!root_.contains(name) || !root_[name].is_object()) {
            fail(std::string("needs an object '") + name + "'");
        }
        return root_[name];
    }

    std::uint64_t whole(const Json& object, const char* name) const {
        if (!object.contains(name) || !object[name].is_number_unsigned()) {
            fail(std::string("needs a whole number '") + name + "'");
        }
        return object[name].get<std::uint64_t>();
    }

    std::uint64_t shape_of_means() const {
        const Json& means = section("means");
        if (!means.contains("shape") || !means["shape"].is_array() || means["shape"].empty() ||
            !means["shape"][0].is_number_unsigned()) {
            fail("needs the number of Gaussians in 'means.shape'");
        }
        return means["shape"][0].get<std::uint64_t>();
    }

    double finite(const Json& value, const char* name) const {
        if (!value.is_number() || !std::isfinite(value.get<double>())) {
            fail(std::string("needs finite numbers in '") + name + "'");
        }
        return value.get<double>();
    }

    double number(const Json& object, const char* name, std::size_t index) const {
        if (!object.contains(name) || !object[name].is_array() || object[name].size() <= index) {
            fail(std::string("needs a list '") + name + "' of more than " + std::to_string(index) +
                 " numbers");
        }
        return finite(object[name][index], name);
    }

    /// Longer lists would belong to something that is not known here.
    void check_bounds(const Json& object, std::size_t numbers) const {
        for (const char* const name : {"mins", "maxs"}) {
            if (object.contains(name) && object[name].size() > numbers) {
                fail(std::string("has a list '") + name + "' of more than " +
                     std::to_string(numbers) + " numbers");
            }
        }
    }

    std::string file(const Json& object, const char* name, std::size_t index) const {
        if (!object.contains("files") || !object["files"].is_array() ||
            object["files"].size() <= index || !object["files"][index].is_string()) {
            fail(std::string("needs the names of images in '") + name + ".files'");
        }
        std::string called = object["files"][index].get<std::string>();
        if (has_control_characters(called)) {
            fail(std::string("has a name with a control character in '") + name + ".files'");
        }
        return called;
    }

    /// Bytes beyond a shorter code book stand for its last value.
    SogMeta::ByteTable code_book(const Json& object, const char* name) const {
        if (!object.contains("codebook") || !object["codebook"].is_array() ||
            object["codebook"].empty() || object["codebook"].size() > 256) {
            fail(std::string("needs a list '") + name + ".codebook' of 1 to 256 numbers");
        }
        const Json& book = object["codebook"];
        SogMeta::ByteTable table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            table[i] = static_cast<float>(finite(book[std::min(i, book.size() - 1)], name));
        }
        return table;
    }

    static SogMeta::ByteTable between(double low, double high) {
        SogMeta::ByteTable table{};
        for (std::size_t i = 0; i < table.size(); ++i) {
            table[i] = static_cast<float>(low + (high - low) * (static_cast<double>(i) / 255));
        }
        return table;
    }

    void fill_tables() {
        const Json& scales = section("scales");
        const Json& sh0 = section("sh0");
        if (version_2_) {
            meta_.scale.fill(code_book(scales, "scales"));
            meta_.colour.fill(code_book(sh0, "sh0"));
            meta_.opacity = between(0, 1);
            return;
        }
        check_bounds(scales, 3);
        check_bounds(sh0, 4);
        for (std::size_t i = 0; i < 3; ++i) {
            meta_.scale[i] = between(number(scales, "mins", i), number(scales, "maxs", i));
            meta_.colour[i] = between(number(sh0, "mins", i), number(sh0, "maxs", i));
        }
        meta_.opacity = between(number(sh0, "mins", 3), number(sh0, "maxs", 3));
        meta_.logits = true;
        for (float& opacity : meta_.opacity) {
            opacity = static_cast<float>(1 / (1 + std::exp(-static_cast<double>(opacity))));
        }
    }

    void parse_rest(const Json& rest) {
        if (version_2_) {
            const std::uint64_t bands = whole(rest, "bands");
            if (bands > 3) {
                fail("has 'shN.bands' beyond 3");
            }
            meta_.degree = static_cast<int>(bands);
            meta_.palette = whole(rest, "count");
        } else {
            meta_.degree = -1;
        }
        if (meta_.degree == 0) {
            return;
        }
        if (version_2_) {
            meta_.rest = code_book(rest, "shN");
        } else {
            if (!rest.contains("mins") || !rest.contains("maxs")) {
                fail("needs numbers 'mins' and 'maxs' in 'shN'");
            }
            meta_.rest = between(finite(rest["mins"], "mins"), finite(rest["maxs"], "maxs"));
        }
        meta_.centroids = file(rest, "shN", 0);
        meta_.labels = file(rest, "shN", 1);
    }

    const std::string& where_;
    const Json& root_;
    bool version_2_ = true;
    SogMeta meta_;
};

} // namespace

SogMeta parse_sog_meta(const std::string& where, const std::string& text) {
    const Json root = parse_json(text);
    if (root.is_discarded()) {
        fail_file(where, "its meta.json is no JSON, so this is no SOG scene.");
    }
    return MetaParser(where, root).parse();
}

} // namespace degs
