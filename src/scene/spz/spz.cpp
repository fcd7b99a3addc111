// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <utility>
#include <vector>

#include "scene/files/activation_scan.hpp"
#include "scene/files/half_float.hpp"
#include "scene/files/input_file.hpp"
#include "scene/spz/spz_header.hpp"
#include "scene/spz/spz_streams.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxRatio = 1032;        ///< deflate cannot do better
constexpr std::uint64_t kMaxZstdRatio = 1 << 17; ///< nor a run of ZSTD
constexpr std::size_t kMaxRecordBytes = 1 << 16; ///< of all extension records
constexpr std::size_t kStripBytes = 1 << 16;
constexpr double kColourScale = 0.15;

using Bytes = const unsigned char*;
/// decode(bytes, first, count): Gaussians first .. first + count - 1 of one attribute.
using Decode = std::function<void(Bytes bytes, std::size_t first, std::size_t count)>;

/// All values that a byte can stand for.
struct ByteTables {
    std::array<float, 256> opacity{}, colour{}, scale{}, sh{}, turn{};
    ByteTables() {
        for (int b = 0; b < 256; ++b) {
            opacity[b] = static_cast<float>(b / 255.0);
            colour[b] = static_cast<float>((b / 255.0 - 0.5) / kColourScale);
            scale[b] = static_cast<float>(std::exp(b / 16.0 - 10.0));
            sh[b] = static_cast<float>((b - 128) / 128.0);
            turn[b] = static_cast<float>(b / 127.5 - 1.0);
        }
    }
};

const ByteTables& tables() {
    static const ByteTables made;
    return made;
}

double fixed_point(Bytes bytes, double step) {
    const std::uint32_t bits = bytes[0] | bytes[1] << 8 | std::uint32_t{bytes[2]} << 16;
    return static_cast<double>(static_cast<std::int32_t>(bits << 8) >> 8) * step;
}

double half_at(Bytes bytes) {
    return half_value(static_cast<std::uint16_t>(bytes[0] | bytes[1] << 8));
}

glm::vec4 first_three(Bytes b) {
    const std::array<float, 256>& turn = tables().turn;
    const float x = turn[b[0]], y = turn[b[1]], z = turn[b[2]];
    return {std::sqrt(std::max(0.0F, 1 - x * x - y * y - z * z)), x, y, z};
}

/// Two bits name the largest of x, y, z, w; ten bits (sign, magnitude) hold each of the others, the
/// last one lowest.
glm::vec4 smallest_three(Bytes b) {
    std::uint32_t bits = b[0] | b[1] << 8 | b[2] << 16 | std::uint32_t{b[3]} << 24;
    const std::uint32_t largest = bits >> 30;
    const float unit = static_cast<float>(std::sqrt(0.5) / 511);
    glm::vec4 xyzw(0);
    float squares = 0;
    for (int i = 3; i >= 0; --i) {
        if (i != static_cast<int>(largest)) {
            const float magnitude = static_cast<float>(bits & 511) * unit;
            xyzw[i] = (bits & 512) != 0 ? -magnitude : magnitude;
            squares += magnitude * magnitude;
            bits >>= 10;
        }
    }
    xyzw[static_cast<int>(largest)] = std::sqrt(std::max(0.0F, 1 - squares));
    return {xyzw.w, xyzw.x, xyzw.y, xyzw.z};
}

class SpzDecoder {
public:
    SpzDecoder(std::string where, std::string_view bytes)
        : where_(std::move(where)), file_(bytes) {}

    SceneContent decode() {
        const bool plain = file_.size() >= 4 && load_u32(file_.data()) == kSpzMagic;
        SpzRecords records = plain ? decode_version_4() : decode_gzip();
        content_.axes_assumed = !records.axes;
        content_.axes = records.axes.value_or(*parse_axes("RUB"));
        content_.traits.antialiased = (header_.flags & kSpzAntialiased) != 0;
        content_.notes.insert(content_.notes.end(), records.notes.begin(), records.notes.end());
        note_flags_and_degree();
        if (std::string note = activated_note(content_.cloud); !note.empty()) {
            content_.notes.push_back(std::move(note));
        }
        return std::move(content_);
    }

private:
    SpzRecords decode_gzip() {
        const std::unique_ptr<ByteStream> stream = gzip_stream(where_, file_);
        char head[kSpzHeaderBytes];
        stream->read_exactly(head, sizeof head);
        header_ = parse_spz_header(where_, head);
        if (header_.version == 4) {
            fail_file(where_,
                      "SPZ version 4 holds ZSTD streams and may not be compressed by gzip.");
        }
        check_claims(kMaxRatio);
        for (int attribute = 0; attribute < 6; ++attribute) {
            decode_attribute(attribute, *stream);
        }
        const std::string rest = read_rest(*stream);
        if ((header_.flags & kSpzHasRecords) == 0 && !rest.empty()) {
            fail_file(where_, "its compressed data holds more bytes than its header promises.");
        }
        return parse_spz_records(where_, rest);
    }

    /// What follows the attributes: records.
    std::string read_rest(ByteStream& stream) const {
        std::string rest(kMaxRecordBytes + 1, '\0');
        rest.resize(stream.read_some(rest.data(), rest.size()));
        if (rest.size() > kMaxRecordBytes) {
            fail_file(where_, "more than " + std::to_string(kMaxRecordBytes) +
                                  " bytes follow behind its Gaussians.");
        }
        return rest;
    }

    SpzRecords decode_version_4() {
        if (file_.size() < kSpz4HeaderBytes) {
            fail_file(where_, "the file is shorter than the 32 bytes of an SPZ header.");
        }
        header_ = parse_spz_header(where_, file_.data());
        if (header_.version != 4) {
            fail_file(where_, "SPZ version " + std::to_string(header_.version) +
                                  " must be compressed by gzip, and this file is not.");
        }
        check_claims(kMaxZstdRatio);
        const std::uint64_t table = load_u32(file_.data() + 16);
        const auto streams = static_cast<unsigned char>(file_[15]);
        const std::uint64_t expected = header_.sh_degree == 0 ? 5 : 6;
        if (streams != expected || table < kSpz4HeaderBytes ||
            table + streams * 16 > file_.size()) {
            fail_file(where_, "its table of contents must hold " + std::to_string(expected) +
                                  " streams and lie behind the header, inside the file.");
        }
        decode_streams(table, streams);
        const bool has = (header_.flags & kSpzHasRecords) != 0;
        if (!has && table > kSpz4HeaderBytes) {
            fail_file(where_, std::to_string(table - kSpz4HeaderBytes) +
                                  " bytes lie between its header and its table of contents, and "
                                  "its flags announce no records.");
        }
        return has ? parse_spz_records(where_,
                                       file_.substr(kSpz4HeaderBytes, table - kSpz4HeaderBytes))
                   : SpzRecords{};
    }

    void decode_streams(std::uint64_t table, std::uint64_t streams) {
        std::string_view rest = file_.substr(table + streams * 16);
        for (std::uint64_t i = 0; i < streams; ++i) {
            const char* const entry = file_.data() + table + i * 16;
            const std::uint64_t packed = load_u64(entry), plain = load_u64(entry + 8);
            if (plain != header_.attribute_bytes()[i] * header_.count || packed > rest.size()) {
                fail_file(where_, "stream " + std::to_string(i) +
                                      " of its table of contents claims " + std::to_string(packed) +
                                      " bytes that hold " + std::to_string(plain) +
                                      ", which fits neither its header nor its size.");
            }
            const std::unique_ptr<ByteStream> stream = zstd_stream(where_, rest.substr(0, packed));
            decode_attribute(static_cast<int>(i), *stream);
            char more = 0;
            if (stream->read_some(&more, 1) != 0) {
                fail_file(where_, "its compressed data holds more bytes than its header promises.");
            }
            rest.remove_prefix(packed);
        }
        if (!rest.empty()) {
            fail_file(where_,
                      std::to_string(rest.size()) + " bytes follow behind its last stream.");
        }
    }

    void check_claims(std::uint64_t ratio) {
        if (header_.body_bytes() / ratio > file_.size()) {
            fail_file(where_, "its header claims " + std::to_string(header_.count) +
                                  " Gaussians, more than a file of " +
                                  std::to_string(file_.size()) +
                                  " bytes can hold; the file is truncated or damaged.");
        }
        require_sane_growth(where_, "its data", file_.size(), header_.body_bytes());
        content_.cloud.sh_degree = std::min(header_.sh_degree, 3);
        // Common files shrink to a fourth at most. Beyond, the arrays grow with the data.
        expected_ = std::min<std::uint64_t>(
            header_.count, 16 * file_.size() / (header_.body_bytes() / header_.count));
    }

    void decode_attribute(int attribute, ByteStream& stream) {
        const Decode decode = decoder_of(attribute);
        const std::size_t each = header_.attribute_bytes()[attribute];
        if (each == 0) {
            return;
        }
        const std::size_t strip = kStripBytes / each;
        std::vector<char> bytes(strip * each);
        for (std::size_t first = 0; first < header_.count; first += strip) {
            const std::size_t count = std::min<std::size_t>(strip, header_.count - first);
            stream.read_exactly(bytes.data(), count * each);
            decode(reinterpret_cast<Bytes>(bytes.data()), first, count);
        }
    }

    Decode decoder_of(int attribute) {
        switch (attribute) {
        case 0:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_means(b, i, n); };
        case 1:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_opacities(b, i, n); };
        case 2:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_colours(b, i, n); };
        case 3:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_scales(b, i, n); };
        case 4:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_rotations(b, i, n); };
        default:
            return [this](Bytes b, std::size_t i, std::size_t n) { decode_sh(b, i, n); };
        }
    }

    /// Makes room for `values`, each of `each` per Gaussian.
    template <class Array>
    void grow(Array& array, std::size_t values, std::size_t each = 1) const {
        if (array.empty()) {
            array.reserve(expected_ * each);
        }
        array.resize(values * each);
    }

    void decode_means(Bytes b, std::size_t first, std::size_t count) {
        std::vector<glm::dvec3>& means = content_.cloud.means;
        grow(means, first + count);
        if (header_.version == 1) {
            for (std::size_t i = first; i < first + count; ++i, b += 6) {
                means[i] = {half_at(b), half_at(b + 2), half_at(b + 4)};
            }
            return;
        }
        const double step = std::ldexp(1.0, -header_.fractional_bits);
        for (std::size_t i = first; i < first + count; ++i, b += 9) {
            means[i] = {fixed_point(b, step), fixed_point(b + 3, step), fixed_point(b + 6, step)};
        }
    }

    void decode_opacities(Bytes b, std::size_t first, std::size_t count) {
        std::vector<float>& opacities = content_.cloud.opacities;
        grow(opacities, first + count);
        for (std::size_t i = 0; i < count; ++i) {
            opacities[first + i] = tables().opacity[b[i]];
        }
    }

    void decode_colours(Bytes b, std::size_t first, std::size_t count) {
        const std::size_t pitch = content_.cloud.sh_coefficients() * 3;
        grow(content_.cloud.sh, first + count, pitch);
        float* to = content_.cloud.sh.data() + first * pitch;
        for (std::size_t i = 0; i < count; ++i, b += 3, to += pitch) {
            for (int channel = 0; channel < 3; ++channel) {
                to[channel] = tables().colour[b[channel]];
            }
        }
    }

    void decode_scales(Bytes b, std::size_t first, std::size_t count) {
        std::vector<glm::vec3>& scales = content_.cloud.scales;
        grow(scales, first + count);
        const std::array<float, 256>& scale = tables().scale;
        for (std::size_t i = first; i < first + count; ++i, b += 3) {
            scales[i] = {scale[b[0]], scale[b[1]], scale[b[2]]};
        }
    }

    void decode_rotations(Bytes b, std::size_t first, std::size_t count) {
        std::vector<glm::vec4>& rotations = content_.cloud.rotations;
        grow(rotations, first + count);
        const bool smallest = header_.version >= 3;
        for (std::size_t i = first; i < first + count; ++i, b += smallest ? 4 : 3) {
            rotations[i] = smallest ? smallest_three(b) : first_three(b);
        }
    }

    void decode_sh(Bytes b, std::size_t first, std::size_t count) {
        const std::size_t in_file = 3 * header_.sh_rest();
        const std::size_t pitch = content_.cloud.sh_coefficients() * 3;
        float* to = content_.cloud.sh.data() + first * pitch;
        for (std::size_t i = 0; i < count; ++i, b += in_file, to += pitch) {
            for (std::size_t k = 0; k < pitch - 3; ++k) {
                to[3 + k] = tables().sh[b[k]];
            }
        }
    }

    void note_flags_and_degree() {
        if (header_.sh_degree > 3) {
            content_.notes.emplace_back("The spherical harmonics of degree 4 were dropped, because "
                                        "images are drawn with degree 3 at most.");
        }
        if ((header_.flags & ~(kSpzAntialiased | kSpzHasRecords)) != 0) {
            content_.notes.push_back("The header has flags that are unknown here (the flags are " +
                                     std::to_string(header_.flags) +
                                     ", and known are 1 and 2); they were passed over.");
        }
    }

    std::string where_;
    std::string_view file_;
    SpzHeader header_;
    SceneContent content_;
    std::size_t expected_ = 0; ///< Gaussians for which room is made in advance
};

} // namespace

SceneContent decode_spz(const std::string& where, std::string_view bytes) {
    return SpzDecoder(where, bytes).decode();
}

SceneContent read_spz(const std::string& path) {
    constexpr std::size_t kSignatureBytes = 4;
    constexpr std::string_view kGzip = "\x1f\x8b";
    InputFile file(path);
    std::string bytes(std::min<std::uint64_t>(file.size(), kSignatureBytes), '\0');
    file.read_exactly(bytes.data(), bytes.size());
    const bool plain = bytes.size() == kSignatureBytes && load_u32(bytes.data()) == kSpzMagic;
    if (!plain && bytes.substr(0, kGzip.size()) != kGzip) { // before all of it is read
        fail_file(path, "its first bytes are " + in_quotes(bytes) +
                            ", but an SPZ scene begins with those of gzip or with 'NGSP'.");
    }
    const std::size_t first = bytes.size();
    bytes.resize(file.size());
    file.read_exactly(bytes.data() + first, bytes.size() - first);
    return decode_spz(path, bytes);
}

} // namespace degs
