// SPDX-License-Identifier: Apache-2.0
#include "sim/view/view.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/ratio.hpp"
#include "config/input_files.hpp"
#include "degs/error.hpp"
#include "scene/files/image_io.hpp"
#include "sim/process/stopwatch.hpp"
#include "sim/text/comma_parts.hpp"
#include "sim/text/progress.hpp"
#include "sim/text/words.hpp"
#include "sim/view/frame_checks.hpp"

namespace degs::sim {
namespace {

/// `sides` in double, so that no product of two int overflows.
void check_pixels(double width, double height) {
    if (width * height > static_cast<double>(kMostPixels)) {
        throw InputError("An image of " + decimal_text(width) + " x " + decimal_text(height) +
                         " pixels is too large; at most " + grouped(kMostPixels) +
                         " pixels (8192 x 4320) are allowed.");
    }
    if (std::max(width, height) > kMostImageSide) {
        throw InputError("An image of " + decimal_text(width) + " x " + decimal_text(height) +
                         " pixels cannot be written as PNG; at most " + grouped(kMostImageSide) +
                         " pixels to a side are allowed.");
    }
}

struct Resolution {
    const char* name;
    int height; ///< px
};
constexpr std::array<Resolution, 5> kResolutions{
    {{"720p", 720}, {"1080p", 1080}, {"2k", 1440}, {"4k", 2160}, {"8k", 4320}}};

std::string in_small_letters(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// The height of a resolution, px; none if its name is not known.
std::optional<int> known_height(const std::string& name) {
    for (const Resolution& resolution : kResolutions) {
        if (in_small_letters(name) == resolution.name) {
            return resolution.height;
        }
    }
    return {};
}

/// resolution_names() for a message.
std::string all_names() {
    std::string words;
    for (const std::string& name : resolution_names()) {
        words.append(words.empty() ? "" : ", ").append(name);
    }
    return words;
}

/// The numbers of a text that is nothing but them and the character of `between` behind each.
template <class Number, std::size_t count>
std::optional<std::array<Number, count>> numbers_of(const std::string& text,
                                                    const std::string& between) {
    std::array<Number, count> numbers{};
    const char* at = text.data();
    const char* const end = at + text.size();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const auto [rest, error] = std::from_chars(at, end, numbers[i]);
        const bool last = i == between.size();
        if (error != std::errc() || (last ? rest != end : rest == end || *rest != between[i])) {
            return {};
        }
        at = rest + 1;
    }
    return numbers;
}

} // namespace

void check_positive(const char* option, std::optional<int> value) {
    if (value && *value < 1) {
        throw InputError(std::string(option) + " is " + std::to_string(*value) +
                         ", but an image needs at least 1 pixel.");
    }
}

std::optional<int> camera_position(const std::string& text) {
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    const bool good = error == std::errc() && rest == end && value >= 0;
    return good ? std::optional<int>(value) : std::nullopt;
}

std::vector<int> group_cameras(const std::string& text) {
    constexpr std::size_t kMostViews = 64;
    std::vector<int> cameras;
    for (const std::string& part : comma_parts(text)) {
        const std::optional<int> position = camera_position(part);
        if (!position) {
            cameras.clear();
            break;
        }
        cameras.push_back(*position);
    }
    if (cameras.size() < 2 || cameras.size() > kMostViews) {
        throw InputError("--views is '" + text +
                         "', but must be 2 to 64 positions in the scene's list of cameras, "
                         "separated by commas, as in 0,1.");
    }
    return cameras;
}

std::string positions_words(const std::vector<int>& positions) {
    std::string text;
    for (const int position : positions) {
        text += (text.empty() ? "" : ",") + std::to_string(position);
    }
    return text;
}

int one_camera(const std::string& text) {
    if (text == "all" || text.find(',') != std::string::npos) {
        throw InputError("--camera is '" + text +
                         "', but this command renders one view; 'degs compare' takes several.");
    }
    if (const std::optional<int> position = camera_position(text)) {
        return *position;
    }
    throw InputError("--camera is '" + text +
                     "', but must be a position in the scene's list of cameras, from 0; a file of "
                     "cameras is named by --camera-file.");
}

std::vector<std::string> resolution_names() {
    std::vector<std::string> names;
    names.reserve(kResolutions.size());
    for (const Resolution& resolution : kResolutions) {
        names.emplace_back(resolution.name);
    }
    return names;
}

int resolution_height(const std::string& name) {
    if (const std::optional<int> height = known_height(name)) {
        return *height;
    }
    throw InputError("The resolution '" + name + "' is not known; allowed are " + all_names() +
                     ".");
}

ImageSize image_size(const std::string& text) {
    if (const auto sides = numbers_of<int, 2>(in_small_letters(text), "x")) {
        if ((*sides)[0] < 1 || (*sides)[1] < 1) {
            throw InputError("The resolution '" + text +
                             "' is no image; both sides must be at least 1 pixel.");
        }
        if (std::max((*sides)[0], (*sides)[1]) > kMostCameraSide) {
            throw InputError("The resolution '" + text + "' is too large; a side may have " +
                             std::to_string(kMostCameraSide) + " pixels.");
        }
        return {(*sides)[0], (*sides)[1]};
    }
    if (const std::optional<int> height = known_height(text)) {
        return {{}, height};
    }
    throw InputError("The resolution '" + text + "' is not known; allowed are " + all_names() +
                     ", and WIDTHxHEIGHT in pixels, as in 2064x2208.");
}

PixelBox crop_of(const std::string& text) {
    const std::optional<std::array<int, 4>> read = numbers_of<int, 4>(text, ",,x");
    const std::array<int, 4> numbers = read.value_or(std::array<int, 4>{}); // X, Y, W, H
    bool good = read.has_value();
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        good = good && numbers[i] >= (i < 2 ? 0 : 1) && numbers[i] <= kMostRasterSide;
    }
    if (!good) {
        throw InputError("--crop is '" + text +
                         "', but must be X,Y,WxH: the first column and row, and the width and "
                         "height in pixels of the part of the image, as in 64,32,320x240.");
    }
    return {numbers[0], numbers[1], numbers[0] + numbers[2] - 1, numbers[1] + numbers[3] - 1};
}

Foveation foveation_of(const std::string& text) {
    const std::optional<std::array<double, 4>> read = numbers_of<double, 4>(text, ",::");
    const auto [x, y, fovea, periphery] = read.value_or(std::array<double, 4>{});
    // Phrased so that NaN fails.
    if (!(read && x >= 0 && x <= 1 && y >= 0 && y <= 1 && fovea > 0 && fovea <= periphery &&
          periphery <= 90)) {
        throw InputError("--foveation is '" + text +
                         "', but must be X,Y:FOVEA:PERIPHERY: the point looked at in shares 0 .. 1 "
                         "of width and height, and how many degrees from there the fovea ends and "
                         "the periphery begins, above 0, in this order and up to 90, as in "
                         "0.5,0.5:10:25.");
    }
    return {{x, y}, fovea, periphery};
}

Camera resize(const Camera& camera, std::optional<int> width, std::optional<int> height) {
    check_positive("--width", width);
    check_positive("--height", height);
    const double aspect = ratio_of(camera.width, camera.height);
    const double new_width = width ? *width : height ? std::round(*height * aspect) : camera.width;
    const double new_height = height ? *height : std::round(new_width / aspect);
    check_pixels(std::max(new_width, 1.0), std::max(new_height, 1.0));
    Camera resized = camera;
    if (width || height) {
        resized = camera.scaled_to_width(std::max(1, static_cast<int>(new_width)));
        resized.height = height.value_or(resized.height);
    }
    return resized;
}

Camera resize_and_crop(const Camera& camera, std::optional<int> width, std::optional<int> height,
                       const std::string& crop) {
    Camera whole = resize(camera, width, height);
    if (crop.empty()) {
        return whole;
    }
    const PixelBox part = crop_of(crop);
    if (part.x1 >= whole.width || part.y1 >= whole.height) {
        throw InputError("--crop is '" + crop + "', which leaves the image of " +
                         std::to_string(whole.width) + " x " + std::to_string(whole.height) +
                         " pixels.");
    }
    return whole.cropped(part);
}

void check_view(const ViewRequest& request) {
    check_positive("--width", request.width);
    check_positive("--height", request.height);
    if (!request.resolution.empty()) {
        image_size(request.resolution);
    }
    if (!request.crop.empty()) {
        crop_of(request.crop);
    }
    if (request.scene.empty()) {
        throw InputError("The scene has an empty name; a file or synthetic:NAME is needed.");
    }
    remember_input(request.scene); // files that another process reads, too
    remember_input(request.camera_file);
}

Camera camera_of(const ViewRequest& request, const Scene& scene) {
    const ImageSize size = request.resolution.empty() ? ImageSize{request.width, request.height}
                                                      : image_size(request.resolution);
    return resize_and_crop(select_camera(scene, request.camera), size.width, size.height,
                           request.crop);
}

View load_view(const ViewRequest& request) {
    check_view(request);
    const Progress progress("loading " + request.scene);
    const Stopwatch clock;
    View view;
    view.scene = load_scene(request.scene, request.camera_file);
    view.camera = camera_of(request, view.scene);
    view.load_s = clock.seconds();
    return view;
}

} // namespace degs::sim
