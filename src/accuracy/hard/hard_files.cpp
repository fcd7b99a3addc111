// SPDX-License-Identifier: Apache-2.0
// Hard case H28: files that are not what they say.
#include <filesystem>
#include <fstream>

#include "accuracy/hard/hard_builder.hpp"
#include "degs/error.hpp"
#include "scene/ply/ply.hpp"

namespace degs {
namespace {

const char* const kProperties[] = {"x",      "y",       "z",       "f_dc_0",  "f_dc_1",
                                   "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
                                   "rot_0",  "rot_1",   "rot_2",   "rot_3"};

/// A file of `rows` rows whose header claims `count`, without one of the properties.
std::string file_of(int count, int rows, const std::string& missing) {
    std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\n";
    std::string row;
    for (const char* name : kProperties) {
        if (name != missing) {
            text += std::string("property float ") + name + "\n";
            row += "0.5 ";
        }
    }
    text += "end_header\n";
    for (int i = 0; i < rows; ++i) {
        text += row + "\n";
    }
    return text;
}

struct BrokenFile {
    const char* name;
    std::string text;
};

std::vector<BrokenFile> broken_files() {
    const std::string whole = file_of(3, 3, "");
    return {
        {"truncated.ply", whole.substr(0, whole.size() - 40)},
        {"count.ply", file_of(5, 3, "")},
        {"opacity.ply", file_of(3, 3, "opacity")},
        {"rotation.ply", file_of(3, 3, "rot_2")},
        {"points.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty "
                       "float y\nproperty float z\nend_header\n0 0 0\n"},
        {"rgb.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float "
                    "y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty "
                    "uchar blue\nend_header\n0 0 0 9 9 9\n"},
        {"header.ply", "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"},
        {"empty.ply", ""},
    };
}

} // namespace

std::string refuse_broken_files(const std::string& folder) {
    for (const BrokenFile& file : broken_files()) {
        const std::filesystem::path path = std::filesystem::path(folder) / file.name;
        std::ofstream(path, std::ios::binary) << file.text;
        std::string problem = std::string("The file '") + file.name + "' was read.";
        try {
            read_ply(path.string());
        } catch (const InputError& error) {
            const std::string words = error.what();
            const bool clear = words.find(file.name) != std::string::npos && words.back() == '.';
            problem = clear ? "" : "The sentence '" + words + "' does not name the file.";
        }
        std::filesystem::remove(path);
        if (!problem.empty()) {
            return problem;
        }
    }
    return {};
}

} // namespace degs
