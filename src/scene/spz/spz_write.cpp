// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz_write.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

#include <zlib.h>
#include <zstd.h>

#include "base/grouped_number.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "scene/spz/spz_header.hpp"

namespace degs {
namespace {

constexpr int kUsualFractionalBits = 12;
constexpr double kCodeLimit = 8388607; ///< 24 bits with a sign
constexpr std::uint32_t kRubRecord = 0xADBE0003, kRubSystem = 4;
constexpr int kZstdLevel = 12; ///< as in the reference encoder

const Axes kRub{{1, -1, -1}};

void put_little(std::string& out, std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) {
        out += static_cast<char>(value >> (8 * i));
    }
}

class SpzEncoder {
public:
    SpzEncoder(const GaussianCloud& cloud, const std::string& path, const SpzWriteOptions& options)
        : cloud_(cloud), path_(path), options_(options) {
        if (options.version != 3 && options.version != 4) {
            fail_file(path, "SPZ version " + std::to_string(options.version) +
                                " cannot be written; 3 and 4 can.");
        }
        if (cloud.empty() || cloud.size() > std::numeric_limits<std::int32_t>::max()) {
            fail_file(path, "an SPZ file holds 1 to 2147483647 Gaussians.");
        }
        choose_fractional_bits();
    }

    /// The whole file.
    std::string encode() {
        encode_attributes();
        return options_.version == 3 ? file_3() : file_4();
    }

    std::vector<std::string> notes() const {
        std::vector<std::string> sentences;
        add_note(sentences, scales_, "scales left exp(-10) to exp(5.94)");
        add_note(sentences, colours_, "coefficients of degree 0 left -3.33 to 3.33");
        add_note(sentences, rest_, "higher coefficients left -1 to 0.99");
        if (bits_ < kUsualFractionalBits) {
            sentences.push_back("Positions were rounded to 2^-" + std::to_string(bits_) +
                                ", because some are 2048 or more from the origin.");
        }
        return sentences;
    }

private:
    static void add_note(std::vector<std::string>& sentences, std::uint64_t count,
                         const std::string& what) {
        if (count > 0) {
            sentences.push_back(grouped(count) + " " + what +
                                ", the range of SPZ, and were set to its ends.");
        }
    }

    void choose_fractional_bits() {
        bool finite = true;
        double farthest = 0;
        for (const glm::dvec3& mean : cloud_.means) {
            for (int axis = 0; axis < 3; ++axis) {
                finite = finite && std::isfinite(mean[axis]);
                farthest = std::max(farthest, std::abs(mean[axis]));
            }
        }
        const auto fits = [&] { return std::round(std::ldexp(farthest, bits_)) <= kCodeLimit; };
        while (bits_ > 0 && !fits()) {
            --bits_;
        }
        if (!finite || !fits()) {
            fail_file(path_, "SPZ cannot hold coordinates of 8388608 or more.");
        }
    }

    /// Rounds to 0..255 and counts what lies more than half a code outside.
    static char byte_of(double code, std::uint64_t& outside) {
        outside += code >= -0.5 && code <= 255.5 ? 0 : 1;
        return static_cast<char>(static_cast<int>(std::round(std::clamp(code, 0.0, 255.0))));
    }

    void encode_attributes() {
        const std::size_t rest = cloud_.sh_coefficients() * 3 - 3;
        const std::size_t each[] = {9, 1, 3, 3, 4, rest};
        for (std::size_t a = 0; a < attributes_.size(); ++a) {
            attributes_[a].reserve(each[a] * cloud_.size());
        }
        std::uint64_t never = 0;
        for (std::size_t i = 0; i < cloud_.size(); ++i) {
            put_mean(cloud_.means[i]);
            attributes_[1] += byte_of(cloud_.opacities[i] * 255.0, never);
            const float* const sh = cloud_.sh_of(i);
            for (int channel = 0; channel < 3; ++channel) {
                attributes_[2] += byte_of((sh[channel] * 0.15 + 0.5) * 255, colours_);
                const double scale = cloud_.scales[i][channel];
                attributes_[3] += byte_of((std::log(scale) + 10) * 16, scales_);
            }
            put_rotation(cloud_.rotations[i]);
            put_rest(sh);
        }
    }

    void put_mean(const glm::dvec3& mean) {
        for (int axis = 0; axis < 3; ++axis) {
            const double code = std::round(std::ldexp(mean[axis] * kRub.signs[axis], bits_));
            put_little(attributes_[0], static_cast<std::uint64_t>(static_cast<std::int64_t>(code)),
                       3);
        }
    }

    /// A half turn about x: y and z change sign.
    void put_rotation(const glm::vec4& wxyz) {
        const glm::dvec4 q =
            glm::normalize(glm::dvec4(wxyz.y, -wxyz.z, -wxyz.w, wxyz.x)); // x y z w
        int largest = 0;
        for (int i = 1; i < 4; ++i) {
            largest = std::abs(q[i]) > std::abs(q[largest]) ? i : largest;
        }
        std::uint32_t bits = static_cast<std::uint32_t>(largest);
        for (int i = 0; i < 4; ++i) {
            if (i != largest) {
                const bool negative = (q[i] < 0) != (q[largest] < 0);
                const double magnitude = std::abs(q[i]) * std::sqrt(2.0) * 511;
                const auto code =
                    static_cast<std::uint32_t>(std::min(std::round(magnitude), 511.0));
                bits = bits << 10 | (negative ? 512U : 0U) | code;
            }
        }
        put_little(attributes_[4], bits, 4);
    }

    void put_rest(const float* sh) {
        for (int k = 1; k < cloud_.sh_coefficients(); ++k) {
            for (int channel = 0; channel < 3; ++channel) {
                attributes_[5] += byte_of(sh[3 * k + channel] * sh_signs_[k] * 128.0 + 128, rest_);
            }
        }
    }

    std::string head() const {
        std::string out;
        put_little(out, kSpzMagic, 4);
        put_little(out, options_.version, 4);
        put_little(out, cloud_.size(), 4);
        put_little(out, cloud_.sh_degree, 1);
        put_little(out, bits_, 1);
        put_little(out, kSpzHasRecords | (options_.antialiased ? kSpzAntialiased : 0), 1);
        return out;
    }

    static std::string record() {
        std::string out;
        put_little(out, kRubRecord, 4);
        put_little(out, 4, 4);
        put_little(out, kRubSystem, 4);
        return out;
    }

    std::string file_3() const {
        std::string file;
        z_stream state{};
        constexpr int kGzip = 16;
        if (deflateInit2(&state, Z_DEFAULT_COMPRESSION, Z_DEFLATED, kGzip + MAX_WBITS, 9,
                         Z_DEFAULT_STRATEGY) != Z_OK) {
            fail_file(path_, "zlib could not be started.");
        }
        append_deflated(state, head() + '\0', file);
        for (const std::string& attribute : attributes_) {
            append_deflated(state, attribute, file);
        }
        append_deflated(state, record(), file, Z_FINISH);
        deflateEnd(&state);
        return file;
    }

    static void append_deflated(z_stream& state, const std::string& bytes, std::string& file,
                                int flush = Z_NO_FLUSH) {
        constexpr std::size_t kBlock = 1 << 20;
        for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
            const std::size_t step = std::min(kBlock, bytes.size() - at);
            state.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + at));
            state.avail_in = static_cast<uInt>(step);
            do {
                char out[1 << 14];
                state.next_out = reinterpret_cast<Bytef*>(out);
                state.avail_out = sizeof out;
                deflate(&state, at + step == bytes.size() ? flush : Z_NO_FLUSH);
                file.append(out, sizeof out - state.avail_out);
            } while (state.avail_out == 0);
        }
    }

    std::string file_4() const {
        std::string table, streams;
        int used = 0;
        for (const std::string& attribute : attributes_) {
            if (attribute.empty()) {
                continue;
            }
            std::string packed(ZSTD_compressBound(attribute.size()), '\0');
            const std::size_t size = ZSTD_compress(packed.data(), packed.size(), attribute.data(),
                                                   attribute.size(), kZstdLevel);
            if (ZSTD_isError(size) != 0) {
                fail_file(path_, std::string("libzstd could not compress it (") +
                                     ZSTD_getErrorName(size) + ").");
            }
            put_little(table, size, 8);
            put_little(table, attribute.size(), 8);
            streams.append(packed, 0, size);
            ++used;
        }
        std::string file = head();
        put_little(file, used, 1);
        put_little(file, kSpz4HeaderBytes + record().size(), 4);
        file.resize(kSpz4HeaderBytes, '\0');
        return file + record() + table + streams;
    }

    const GaussianCloud& cloud_;
    const std::string& path_;
    SpzWriteOptions options_;
    int bits_ = kUsualFractionalBits; ///< of positions, behind the point
    std::array<float, 16> sh_signs_ = sh_signs(Axes{}, kRub);
    std::array<std::string, 6> attributes_;
    std::uint64_t scales_ = 0, colours_ = 0, rest_ = 0; ///< values clamped
};

} // namespace

std::vector<std::string> write_spz(const GaussianCloud& cloud, const std::string& path,
                                   const SpzWriteOptions& options) {
    SpzEncoder encoder(cloud, path, options);
    const std::string file = encoder.encode();
    write_whole(path, [&](std::ostream& out) {
        out.write(file.data(), static_cast<std::streamsize>(file.size()));
    });
    return encoder.notes();
}

} // namespace degs
