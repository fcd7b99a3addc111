// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <string_view>
#include <utility>

#include "scene/cameras/colmap_files.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

constexpr std::size_t kMostLine = 65536; ///< bytes of a line that describes a camera or an image

/// The lines of a text file, counted from 1. What a line of 2D points holds is not kept.
class ColmapLines {
public:
    explicit ColmapLines(const std::string& path) : file_(path) {
        std::string mark(kByteOrderMark.size(), '\0');
        mark.resize(file_.read_some(mark.data(), mark.size()));
        if (mark != kByteOrderMark) {
            file_.seek(0);
        }
    }

    /// The next line that is neither empty nor a comment.
    bool next(std::string& line) {
        while (read(line)) {
            const std::size_t first = line.find_first_not_of(" \t");
            if (first != std::string::npos && line[first] != '#') {
                return true;
            }
        }
        return false;
    }

    /// Words of the next line, whatever its length; 0 at the end of the file.
    std::size_t count_words() {
        ++number_;
        std::size_t words = 0;
        bool inside = false;
        std::istream& in = file_.stream();
        for (int c = in.get(); c != std::char_traits<char>::eof() && c != '\n'; c = in.get()) {
            const bool blank = c == ' ' || c == '\t' || c == '\r';
            words += !blank && !inside ? 1 : 0;
            inside = !blank;
        }
        return words;
    }

    CameraPlace place() const { return {file_.path(), "line " + std::to_string(number_)}; }

private:
    bool read(std::string& line) {
        ++number_;
        line.clear();
        std::istream& in = file_.stream();
        int c = in.get();
        if (c == std::char_traits<char>::eof()) {
            return false;
        }
        for (; c != std::char_traits<char>::eof() && c != '\n'; c = in.get()) {
            if (line.size() == kMostLine) {
                place().fail("is longer than " + std::to_string(kMostLine) + " bytes.");
            }
            line += static_cast<char>(c);
        }
        if (!line.empty() && line.back() == '\r') {
            line.pop_back();
        }
        return true;
    }

    InputFile file_;
    std::size_t number_ = 0;
};

/// The words of a line, one after the other.
class ColmapWords {
public:
    ColmapWords(const CameraPlace& place, std::string_view line) : place_(place), rest_(line) {}

    /// `what` is the column, e.g. "WIDTH".
    std::string_view word(const std::string& what) {
        const std::string_view found = next();
        if (found.empty()) {
            place_.fail("has no " + what + ".");
        }
        return found;
    }

    double real(const std::string& what) {
        double value = 0;
        parse(what, value, "a number");
        return value;
    }

    std::uint32_t id(const std::string& what) {
        std::uint32_t value = 0;
        parse(what, value, "an integer from 0 to 4294967295");
        return value;
    }

    /// Everything that is left, without blanks around it: names of images may contain some.
    std::string_view rest() {
        trim();
        const std::size_t last = rest_.find_last_not_of(" \t");
        return last == std::string_view::npos ? rest_ : rest_.substr(0, last + 1);
    }

    void expect_end() {
        if (!next().empty()) {
            place_.fail("has more parameters than its camera model takes.");
        }
    }

private:
    void trim() {
        const std::size_t begin = rest_.find_first_not_of(" \t");
        rest_.remove_prefix(std::min(begin, rest_.size()));
    }

    std::string_view next() {
        trim();
        const std::size_t end = std::min(rest_.find_first_of(" \t"), rest_.size());
        const std::string_view found = rest_.substr(0, end);
        rest_.remove_prefix(end);
        return found;
    }

    template <class Value>
    void parse(const std::string& what, Value& value, const char* allowed) {
        const std::string_view text = word(what);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc() || end != text.data() + text.size()) {
            place_.fail("has a " + what + " of " + in_quotes(text) + ", which is not " + allowed +
                        ".");
        }
    }

    const CameraPlace& place_;
    std::string_view rest_;
};

} // namespace

ColmapCameras read_colmap_cameras_text(const std::string& path) {
    ColmapLines lines(path);
    ColmapCameras cameras;
    for (std::string line; lines.next(line);) {
        const CameraPlace place = lines.place();
        ColmapWords words(place, line);
        const std::uint32_t id = words.id("CAMERA_ID");
        const ColmapModel& model = colmap_model(place, std::string(words.word("MODEL")));
        const double width = words.real("WIDTH");
        const double height = words.real("HEIGHT");
        std::vector<double> parameters(model.parameters);
        for (int i = 0; i < model.parameters; ++i) {
            parameters[i] = words.real("parameter " + std::to_string(i));
        }
        words.expect_end();
        cameras.add(colmap_camera(place, id, model, width, height, parameters));
    }
    return cameras;
}

std::vector<Camera> read_colmap_images_text(const std::string& path, const ColmapCameras& cameras) {
    ColmapLines lines(path);
    std::vector<Camera> views;
    for (std::string line; lines.next(line);) {
        const CameraPlace place = lines.place();
        ColmapWords words(place, line);
        const std::uint32_t id = words.id("IMAGE_ID");
        ColmapPose pose;
        for (const auto& [name, index] :
             {std::pair("QW", 0), std::pair("QX", 1), std::pair("QY", 2), std::pair("QZ", 3)}) {
            pose.rotation[index] = words.real(name);
        }
        for (const auto& [name, index] :
             {std::pair("TX", 0), std::pair("TY", 1), std::pair("TZ", 2)}) {
            pose.translation[index] = words.real(name);
        }
        const std::uint32_t camera = words.id("CAMERA_ID");
        std::string name(words.rest());
        if (name.empty()) {
            place.fail("has no NAME.");
        }
        if (name.size() > kMostImageName) {
            place.fail("has a NAME of more than " + std::to_string(kMostImageName) + " bytes.");
        }
        views.push_back(cameras.view(place, id, camera, pose, std::move(name)));
        if (const std::size_t count = lines.count_words(); count % 3 != 0) {
            lines.place().fail("has " + std::to_string(count) +
                               " numbers; the 2D points of the image above are threes of numbers, "
                               "and an image without points is followed by an empty line.");
        }
    }
    return views;
}

} // namespace degs
