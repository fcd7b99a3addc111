// SPDX-License-Identifier: Apache-2.0
// The compressed PLY of PlayCanvas, against an encoder that shares nothing with the reader.
#include <algorithm>
#include <cmath>
#include <random>

#include "scene/ply/ply.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

/// Random packed words, with chunks whose bounds differ.
struct CompressedFile {
    std::string format = "binary_little_endian";
    std::size_t count = 600;
    int rest = 0; ///< f_rest properties
    bool colour_bounds = true;
    std::size_t chunks = 3;
    std::vector<std::vector<double>> chunk_rows;
    std::vector<std::vector<std::uint32_t>> words; ///< position, rotation, scale, colour
    std::vector<std::vector<int>> harmonics;

    void fill() {
        std::mt19937 numbers(5);
        const auto random = [&numbers] { return static_cast<std::uint32_t>(numbers()); };
        for (std::size_t c = 0; c < chunks; ++c) {
            const double o = static_cast<double>(c);
            chunk_rows.push_back({-1 - o, -2, -3, 1, 2 + o, 3, -8, -7, -6 - o, -1, -2, -3});
            if (colour_bounds) {
                const std::vector<double> colours{-0.25, 0, 0.125, 1.5, 1, 0.75 + o};
                chunk_rows.back().insert(chunk_rows.back().end(), colours.begin(), colours.end());
            }
        }
        for (std::size_t i = 0; i < count; ++i) {
            words.push_back({random(), random(), random(), random()});
            harmonics.emplace_back();
            for (int k = 0; k < rest; ++k) {
                harmonics.back().push_back(static_cast<int>(random() % 256));
            }
        }
    }

    std::string file() const {
        test::PlyBuilder ply;
        ply.format = format;
        std::string header = "ply\nformat " + format + " 1.0\nelement chunk " +
                             std::to_string(chunk_rows.size()) + "\n";
        for (const char* const group : {"", "scale_"}) {
            for (const char* const end : {"min_", "max_"}) {
                for (const char* const axis : {"x", "y", "z"}) {
                    header += std::string("property float ") + end + group + axis + "\n";
                }
            }
        }
        for (const char* const name : {"min_r", "min_g", "min_b", "max_r", "max_g", "max_b"}) {
            header += colour_bounds ? std::string("property float ") + name + "\n" : "";
        }
        header += "element vertex " + std::to_string(count) + "\n";
        for (const char* const name : {"position", "rotation", "scale", "color"}) {
            header += std::string("property uint packed_") + name + "\n";
        }
        if (rest > 0) {
            header += "element sh " + std::to_string(count) + "\n";
        }
        for (int k = 0; k < rest; ++k) {
            header += "property uchar f_rest_" + std::to_string(k) + "\n";
        }
        return header + "end_header\n" + body(ply);
    }

    std::string body(const test::PlyBuilder& ply) const {
        std::string bytes;
        for (const std::vector<double>& row : chunk_rows) {
            for (const double value : row) {
                bytes += ply.encode("float", value);
            }
        }
        for (const std::vector<std::uint32_t>& row : words) {
            for (const std::uint32_t word : row) {
                bytes += ply.encode("uint", word);
            }
        }
        for (const std::vector<int>& row : harmonics) {
            for (const int byte : row) {
                bytes += ply.encode("uchar", byte);
            }
        }
        return bytes;
    }
};

double part(std::uint32_t word, int high_bit, int bits) {
    const std::uint32_t whole = (1U << bits) - 1;
    return static_cast<double>((word >> (high_bit - bits + 1)) & whole) / whole;
}

void expect_decoded(const CompressedFile& made, const GaussianCloud& cloud) {
    ASSERT_EQ(cloud.size(), made.count);
    for (std::size_t i = 0; i < made.count; ++i) {
        const std::vector<double>& chunk = made.chunk_rows[i / 256];
        const int high[] = {31, 20, 10}, bits[] = {11, 10, 11};
        for (int axis = 0; axis < 3; ++axis) {
            const double t = part(made.words[i][0], high[axis], bits[axis]);
            ASSERT_NEAR(cloud.means[i][axis], chunk[axis] * (1 - t) + chunk[3 + axis] * t, 1e-12);
            const double s = part(made.words[i][2], high[axis], bits[axis]);
            ASSERT_NEAR(std::log(cloud.scales[i][axis] * 1.0),
                        chunk[6 + axis] * (1 - s) + chunk[9 + axis] * s, 1e-6);
            const double c = part(made.words[i][3], 31 - 8 * axis, 8);
            const double rgb =
                made.colour_bounds ? chunk[12 + axis] * (1 - c) + chunk[15 + axis] * c : c;
            ASSERT_NEAR(0.5 + 0.28209479177387814 * cloud.sh_of(i)[axis], rgb, 1e-6);
        }
        ASSERT_NEAR(cloud.opacities[i], (made.words[i][3] & 255) / 255.0, 1e-7);
        const auto largest = static_cast<int>(made.words[i][1] >> 30);
        for (int k = 0, high_bit = 29; k < 4; ++k) { // w x y z
            if (k != largest) {
                const double value = (part(made.words[i][1], high_bit, 10) - 0.5) * std::sqrt(2.0);
                ASSERT_NEAR(cloud.rotations[i][k], value, 1e-6);
                high_bit -= 10;
            } else {
                ASSERT_GE(cloud.rotations[i][k], 0);
            }
        }
        const int rest = made.rest / 3;
        for (int k = 0; k < made.rest; ++k) {
            const int byte = made.harmonics[i][k];
            const double t = byte == 0 ? 0 : byte == 255 ? 1 : (byte + 0.5) / 256;
            ASSERT_NEAR(cloud.sh_of(i)[(k % rest + 1) * 3 + k / rest], t * 8 - 4, 1e-6);
        }
    }
}

TEST(CompressedPly, DecodesEveryField) {
    for (const char* const format : {"binary_little_endian", "ascii", "binary_big_endian"}) {
        for (const int rest : {0, 9, 24, 45}) {
            for (const bool bounds : {true, false}) {
                CompressedFile made;
                made.format = format;
                made.rest = rest;
                made.colour_bounds = bounds;
                made.fill();
                const test::Folder folder;
                const SceneContent content = read_ply(folder.write("c.ply", made.file()));
                expect_decoded(made, content.cloud);
                EXPECT_TRUE(content.notes.empty());
            }
        }
    }
}

std::string complaint_about_compressed(const std::string& bytes) {
    const test::Folder folder;
    const std::string path = folder.write("bad.ply", bytes);
    return test::complaint([&] { read_ply(path); });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

TEST(HostileCompressedPly, LiesAreOneSentence) {
    CompressedFile made;
    made.count = 300;
    made.rest = 9;
    made.chunks = 2;
    made.fill();
    const std::string good = made.file();
    ASSERT_EQ(complaint_about_compressed(good), "");
    const auto complain = [&](const std::string& from, const std::string& to) {
        return complaint_about_compressed(replaced(good, from, to));
    };
    EXPECT_THAT(complain("chunk 2", "chunk 1"), IsSentenceWith("too few"));
    EXPECT_THAT(complain("chunk 2", "chunk 3"), IsSentenceWith("too many"));
    EXPECT_THAT(complain("vertex 300", "vertex 4000000000"), IsSentenceWith("too few"));
    EXPECT_THAT(complain("sh 300", "sh 299"), IsSentenceWith("element 'sh'"));
    EXPECT_THAT(complain("chunk 2", "chunk 99999999999"), IsSentenceWith("truncated"));
    EXPECT_THAT(complain("uint packed_scale", "float packed_scale"),
                IsSentenceWith("'packed_scale' of type uint"));
    EXPECT_THAT(complain("packed_color", "packed_colour"), IsSentenceWith("'packed_color'"));
    EXPECT_THAT(complain("uchar f_rest_3", "uint f_rest_3"), IsSentenceWith("'f_rest_3'"));
    EXPECT_THAT(complain("f_rest_8", "f_rest_9"), IsSentenceWith("'f_rest_8'"));
    EXPECT_THAT(complain("max_scale_z", "max_scale_w"), IsSentenceWith("'max_scale_z'"));
    EXPECT_THAT(complain("max_b", "max_q"), IsSentenceWith("'max_b'"));
    for (std::size_t size = good.find("end_header"); size < good.size(); size += 97) {
        ASSERT_THAT(complaint_about_compressed(good.substr(0, size)), IsSentenceWith("bad.ply: "));
    }
    made.format = "ascii";
    const std::string text = made.file();
    const std::string word = std::to_string(made.words[0][0]);
    for (const char* const number : {"-1", "nan", "5e9"}) {
        EXPECT_THAT(complaint_about_compressed(replaced(text, word, number)),
                    IsSentenceWith("from 0 to 4294967295"));
    }
}

TEST(CompressedPly, ActivatedScalesAreAWarning) {
    const auto says = [](double side, double low, double high) {
        CompressedFile made;
        made.fill();
        for (std::vector<double>& bounds : made.chunk_rows) {
            for (int axis = 0; axis < 3; ++axis) {
                bounds[axis] = -side / 2;
                bounds[3 + axis] = side / 2;
                bounds[6 + axis] = low;
                bounds[9 + axis] = high;
            }
        }
        const test::Folder folder;
        const std::vector<std::string> notes = read_ply(folder.write("a.ply", made.file())).notes;
        return std::any_of(notes.begin(), notes.end(), [](const std::string& note) {
            return note.find("hold its scales as they are") != std::string::npos;
        });
    };
    EXPECT_TRUE(says(2, 0.1, 0.5));
    EXPECT_TRUE(says(300, 0.001, 0.05));
    EXPECT_FALSE(says(300, 0.1, 2));
    EXPECT_FALSE(says(2, -6, 0.5));
}

} // namespace
} // namespace degs
