// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/compressed_ply.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/byte_order.hpp"
#include "scene/ply/ply_rows.hpp"
#include "scene/ply/ply_values.hpp"
#include "splat/model/spherical_harmonics.hpp"

namespace degs {
namespace {

constexpr std::size_t kChunkRows = 256;
constexpr std::size_t kBlockRows = 4096;
constexpr std::array<const char*, 4> kPacked{"packed_position", "packed_rotation", "packed_scale",
                                             "packed_color"};
constexpr std::array<const char*, 18> kBounds{
    "min_x",       "min_y",       "min_z",       "max_x",       "max_y",       "max_z",
    "min_scale_x", "min_scale_y", "min_scale_z", "max_scale_x", "max_scale_y", "max_scale_z",
    "min_r",       "min_g",       "min_b",       "max_r",       "max_g",       "max_b"};
constexpr std::size_t kBoundsWithoutColour = 12; ///< of older files

/// Low and high bounds of one group of three values.
struct Bounds {
    glm::dvec3 low{0.0}, high{1.0};
};
/// The ranges of 256 vertices.
struct Chunk {
    Bounds position, log_scale, colour;
};

Bounds bounds_at(const std::array<double, 18>& values, std::size_t at) {
    return {{values[at], values[at + 1], values[at + 2]},
            {values[at + 3], values[at + 4], values[at + 5]}};
}

double unit(std::uint32_t packed, int shift, int bits) {
    const std::uint32_t mask = (1U << bits) - 1;
    return static_cast<double>(packed >> shift & mask) / mask;
}

glm::dvec3 between(const Bounds& bounds, const glm::dvec3& t) {
    return bounds.low + (bounds.high - bounds.low) * t;
}

glm::dvec3 unpack_11_10_11(std::uint32_t packed) {
    return {unit(packed, 21, 11), unit(packed, 11, 10), unit(packed, 0, 11)};
}

/// Two bits name the largest of w, x, y, z, which is left out.
glm::vec4 unpack_rotation(std::uint32_t packed) {
    const int largest = static_cast<int>(packed >> 30);
    glm::dvec4 q(0.0);
    double squares = 0;
    for (int i = 0, shift = 20; i < 4; ++i) {
        if (i != largest) {
            q[i] = (unit(packed, shift, 10) - 0.5) * std::sqrt(2.0);
            squares += q[i] * q[i];
            shift -= 10;
        }
    }
    q[largest] = std::sqrt(std::max(0.0, 1 - squares));
    return q;
}

double unpack_rest(std::uint32_t byte) {
    const double t = byte == 0 ? 0 : byte >= 255 ? 1 : (byte + 0.5) / 256;
    return (t - 0.5) * 8;
}

class CompressedReader {
public:
    CompressedReader(InputFile& file, const PlyHeader& header)
        : file_(file), header_(header), vertex_(*header.find("vertex")) {}

    GaussianCloud read() {
        read_chunks();
        check_vertices();
        const PlyElement* const sh = header_.find("sh");
        cloud_.sh_degree = sh == nullptr ? 0 : degree_of(*sh);
        read_vertices();
        if (cloud_.sh_degree > 0) {
            read_harmonics(*sh);
        }
        return std::move(cloud_);
    }

private:
    void require(const PlyElement& element, const std::string& property, PlyType type,
                 const char* type_name) const {
        for (const PlyProperty& p : element.properties) {
            if (p.name == property && p.type == type && !p.list_count) {
                return;
            }
        }
        fail_file(file_.path(), "element '" + element.name + "' of a compressed PLY needs the " +
                                    "property '" + property + "' of type " + type_name + ".");
    }

    /// Blocks of rows of one element: each(bytes of the row, its index).
    template <class Each>
    void for_rows(const PlyElement& element, PlyRows& rows, Each&& each) {
        std::vector<char> bytes(std::min<std::uint64_t>(kBlockRows, element.count) *
                                rows.row_bytes());
        for (std::uint64_t first = 0; first < element.count; first += kBlockRows) {
            const std::size_t count = std::min<std::uint64_t>(kBlockRows, element.count - first);
            rows.read(bytes.data(), count);
            for (std::size_t i = 0; i < count; ++i) {
                each(bytes.data() + i * rows.row_bytes(), first + i);
            }
        }
    }

    PlyRows rows_of(const PlyElement& element) {
        file_.seek(header_.data_begin);
        return {file_, header_, element};
    }

    static double value(const PlyRows& rows, const char* row, const PlyColumn& column) {
        double result = 0;
        with_type(column.type, [&](auto type) {
            result = static_cast<double>(
                load_value<decltype(type)>(row + column.offset, rows.swap_bytes()));
        });
        return result;
    }

    void read_chunks() {
        const PlyElement& element = *header_.find("chunk");
        const std::size_t used = element.has("min_r") ? kBounds.size() : kBoundsWithoutColour;
        for (std::size_t i = 0; i < used; ++i) {
            require(element, kBounds[i], PlyType::Float32, "float");
        }
        const std::uint64_t needed =
            vertex_.count / kChunkRows + (vertex_.count % kChunkRows != 0 ? 1 : 0);
        const auto refuse_chunks = [&](const char* how_many) {
            fail_file(file_.path(), "the file has " + std::to_string(element.count) +
                                        " chunks of 256 Gaussians, too " + how_many + " for its " +
                                        std::to_string(vertex_.count) + " Gaussians.");
        };
        if (element.count < needed) {
            refuse_chunks("few");
        }
        PlyRows rows = rows_of(element); // checks the size
        if (element.count > needed) {
            refuse_chunks("many");
        }
        std::vector<PlyColumn> columns;
        for (std::size_t i = 0; i < used; ++i) {
            columns.push_back(rows.column(kBounds[i]));
        }
        chunks_.reserve(element.count);
        for_rows(element, rows, [&](const char* row, std::uint64_t) {
            std::array<double, 18> values{};
            for (std::size_t i = 0; i < used; ++i) {
                values[i] = value(rows, row, columns[i]);
            }
            Chunk chunk{bounds_at(values, 0), bounds_at(values, 6), {}};
            chunk.colour = used == kBounds.size() ? bounds_at(values, 12) : Bounds{};
            chunks_.push_back(chunk);
        });
    }

    void check_vertices() const {
        for (const char* const property : kPacked) {
            require(vertex_, property, PlyType::UInt32, "uint");
        }
    }

    int degree_of(const PlyElement& sh) const {
        const std::size_t count = sh.properties.size();
        const int degree = count == 9 ? 1 : count == 24 ? 2 : count == 45 ? 3 : 0;
        if (degree == 0 || sh.count != vertex_.count) {
            fail_file(file_.path(), "element 'sh' of a compressed PLY needs 9, 24 or 45 properties "
                                    "and a row for each Gaussian; it has " +
                                        std::to_string(count) + " properties and " +
                                        std::to_string(sh.count) + " rows.");
        }
        for (std::size_t i = 0; i < count; ++i) {
            require(sh, "f_rest_" + std::to_string(i), PlyType::UInt8, "uchar");
        }
        return degree;
    }

    void allocate() {
        const std::size_t count = vertex_.count;
        cloud_.means.resize(count);
        cloud_.scales.resize(count);
        cloud_.rotations.resize(count);
        cloud_.opacities.resize(count);
        cloud_.sh.resize(count * cloud_.sh_coefficients() * 3);
    }

    void read_vertices() {
        PlyRows rows = rows_of(vertex_); // checks the size
        allocate();
        std::array<PlyColumn, 4> columns;
        std::transform(kPacked.begin(), kPacked.end(), columns.begin(),
                       [&](const char* name) { return rows.column(name); });
        for_rows(vertex_, rows, [&](const char* row, std::uint64_t i) {
            std::array<std::uint32_t, 4> packed{};
            for (std::size_t k = 0; k < packed.size(); ++k) {
                packed[k] = word(value(rows, row, columns[k]));
            }
            unpack(chunks_[i / kChunkRows], packed, i);
        });
        rows.finish();
    }

    /// ASCII files may hold any number.
    std::uint32_t word(double number) const {
        if (!(number >= 0 && number <= 4294967295.0)) {
            fail_file(file_.path(), "a packed value is not an integer from 0 to 4294967295.");
        }
        return static_cast<std::uint32_t>(number);
    }

    void unpack(const Chunk& chunk, const std::array<std::uint32_t, 4>& packed, std::uint64_t i) {
        cloud_.means[i] = between(chunk.position, unpack_11_10_11(packed[0]));
        cloud_.rotations[i] = unpack_rotation(packed[1]);
        cloud_.scales[i] = glm::exp(between(chunk.log_scale, unpack_11_10_11(packed[2])));
        const std::uint32_t colour = packed[3];
        const glm::dvec3 rgb =
            between(chunk.colour, {unit(colour, 24, 8), unit(colour, 16, 8), unit(colour, 8, 8)});
        float* const sh = cloud_.sh.data() + i * cloud_.sh_coefficients() * 3;
        for (int channel = 0; channel < 3; ++channel) {
            sh[channel] = static_cast<float>((rgb[channel] - 0.5) / kShY0);
        }
        cloud_.opacities[i] = static_cast<float>(unit(colour, 0, 8));
    }

    void read_harmonics(const PlyElement& element) {
        PlyRows rows = rows_of(element);
        const int rest = cloud_.sh_coefficients() - 1;
        std::vector<PlyColumn> columns;
        columns.reserve(std::size_t{3} * rest);
        for (int i = 0; i < 3 * rest; ++i) {
            columns.push_back(rows.column("f_rest_" + std::to_string(i)));
        }
        for_rows(element, rows, [&](const char* row, std::uint64_t i) {
            float* const sh = cloud_.sh.data() + i * (rest + 1) * 3;
            for (int k = 0; k < 3 * rest; ++k) { // channel-major in the file
                const std::uint32_t byte = word(value(rows, row, columns[k]));
                sh[(k % rest + 1) * 3 + k / rest] = static_cast<float>(unpack_rest(byte));
            }
        });
    }

    InputFile& file_;
    const PlyHeader& header_;
    const PlyElement& vertex_;
    std::vector<Chunk> chunks_;
    GaussianCloud cloud_;
};

} // namespace

bool is_compressed_ply(const PlyHeader& header) {
    const PlyElement* const vertex = header.find("vertex");
    return vertex != nullptr && vertex->has("packed_position") && header.find("chunk") != nullptr;
}

GaussianCloud read_compressed_ply(InputFile& file, const PlyHeader& header) {
    return CompressedReader(file, header).read();
}

} // namespace degs
