// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_camera.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/byte_order.hpp"
#include "scene/cameras/camera_place.hpp"
#include "scene/ply/ply_rows.hpp"
#include "scene/ply/ply_values.hpp"

namespace degs {
namespace {

constexpr const char* kExtrinsic = "extrinsic";
constexpr const char* kIntrinsic = "intrinsic";
constexpr const char* kImageSize = "image_size";
constexpr const char* kColorSpace = "color_space";
constexpr std::uint64_t kMostNumbers = 16; ///< of one of these elements

using PlyColumns = std::map<std::string, std::vector<double>>;

bool is_metadata(const PlyElement& element) {
    const bool named = element.name == kExtrinsic || element.name == kIntrinsic ||
                       element.name == kImageSize || element.name == kColorSpace;
    return named && element.count <= kMostNumbers && element.properties.size() == 1 &&
           element.properties[0].name == element.name && !element.has_lists();
}

std::vector<double> column_of(PlyRows& rows, const PlyElement& element) {
    const PlyColumn column = rows.column(element.name);
    std::vector<char> bytes(element.count * rows.row_bytes());
    rows.read(bytes.data(), element.count);
    std::vector<double> values;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        with_type(column.type, [&](auto type) {
            values.push_back(static_cast<double>(load_value<decltype(type)>(
                bytes.data() + i * rows.row_bytes() + column.offset, rows.swap_bytes())));
        });
    }
    return values;
}

PlyColumns metadata_of(InputFile& file, const PlyHeader& header) {
    PlyColumns columns;
    const auto first = std::find_if(header.elements.begin(), header.elements.end(), is_metadata);
    if (first == header.elements.end()) {
        return columns;
    }
    file.seek(header.data_begin);
    PlyRows rows(file, header, *first);
    columns[first->name] = column_of(rows, *first);
    for (auto element = first + 1; element != header.elements.end(); ++element) {
        if (is_metadata(*element)) {
            rows.move_to(*element);
            columns[element->name] = column_of(rows, *element);
        }
    }
    return columns;
}

std::string plain_number(double value) {
    std::string text = std::to_string(value);
    text.erase(text.find_last_not_of('0') + 1);
    return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

/// Size, focal lengths and principal point of the view, px.
struct PhotoLens {
    double fx, fy, cx, cy, width, height;
};

PhotoLens lens_of(const std::vector<double>& k, const std::vector<double>& size) {
    return size.empty() ? PhotoLens{k[0], k[1], k[2] / 2, k[3] / 2, k[2], k[3]}
                        : PhotoLens{k[0], k[4], k[2], k[5], size[0], size[1]};
}

Camera photo_camera(const std::string& path, const PhotoLens& lens,
                    const std::vector<double>& extrinsic) {
    const CameraPlace place(path, "the camera in the elements intrinsic, extrinsic and image_size");
    Camera camera;
    camera.name = "photograph";
    camera.width = checked_side(place, "width", lens.width, plain_number(lens.width));
    camera.height = checked_side(place, "height", lens.height, plain_number(lens.height));
    camera.fx = checked_focal_length(place, "fx", lens.fx, plain_number(lens.fx));
    camera.fy = checked_focal_length(place, "fy", lens.fy, plain_number(lens.fy));
    set_principal_point(place, lens.cx, lens.cy, camera);
    glm::dmat3 world_to_camera(1.0);
    glm::dvec3 shift(0.0);
    const bool turned = extrinsic.size() == 12; // the rotation column by column
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double value = extrinsic[4 * row + column];
            (turned ? world_to_camera[row][column] : world_to_camera[column][row]) = value;
        }
        shift[row] = extrinsic[4 * row + 3];
    }
    check_rotation(place, kExtrinsic, world_to_camera);
    if (!std::isfinite(shift.x + shift.y + shift.z)) {
        place.fail("has a translation that is not finite.");
    }
    camera.camera_to_world = glm::transpose(world_to_camera);
    camera.position = -(camera.camera_to_world * shift);
    return camera;
}

void add_photo_camera(const std::string& path, PlyColumns& columns, SceneContent& content) {
    const std::vector<double>& k = columns[kIntrinsic];
    const std::vector<double>& size = columns[kImageSize];
    const std::vector<double>& extrinsic = columns[kExtrinsic];
    const bool known = (k.size() == 9 && size.size() == 2) || (k.size() == 4 && size.empty());
    if (!known || (extrinsic.size() != 16 && extrinsic.size() != 12)) {
        content.notes.push_back(
            "The file has " + std::to_string(k.size()) + ", " + std::to_string(extrinsic.size()) +
            " and " + std::to_string(size.size()) +
            " numbers in its elements intrinsic, extrinsic and image_size, of which a camera needs "
            "9, 16 and 2; its camera was passed over.");
        return;
    }
    content.cameras.push_back(photo_camera(path, lens_of(k, size), extrinsic));
}

} // namespace

void read_ply_metadata(InputFile& file, const PlyHeader& header, SceneContent& content) {
    PlyColumns columns = metadata_of(file, header);
    if (columns.count(kIntrinsic) != 0) {
        add_photo_camera(file.path(), columns, content);
    }
    const std::vector<double>& space = columns[kColorSpace];
    if (!space.empty() && space[0] == 1) {
        content.notes.emplace_back(kLinearColoursNote);
    } else if (!space.empty() && space[0] != 0) {
        content.notes.push_back("The color_space " + plain_number(space[0]) +
                                " of the file is unknown (known are 0 for sRGB and 1 for linear); "
                                "its colours are taken as they are.");
    }
}

std::vector<Camera> read_ply_cameras(const std::string& path) {
    InputFile file(path);
    const PlyHeader header = read_ply_header(file);
    SceneContent content;
    read_ply_metadata(file, header, content);
    return std::move(content.cameras);
}

} // namespace degs
