// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/functional/tile_trace.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "base/byte_order.hpp"

namespace degs {
namespace {

// The head of a trace has three numbers: how many batches and how many pixels follow, and whether
// pixels are in single precision. The ends of the batches, the pixels and the rows come behind it.
using Head = std::array<std::uint32_t, 3>;

// Says which masks of a row are stored, because they do not follow from the span.
enum : unsigned char { kInsideDiffers = 1, kUsefulDiffers = 2, kEnds = 4 };

template <class Real>
struct StoredPixel {
    Real rgb[3], transmittance;
    std::uint32_t updates, ended;
};

int bytes_of(int bits) {
    return (bits + 7) / 8;
}

// Appends the bits of a mask from column x0 on, byte by byte.
void put_mask(std::string& to, const RowMask& mask, int x0, int length) {
    for (int byte = 0; byte < bytes_of(length); ++byte) {
        to.push_back(static_cast<char>(mask.from(x0 + 8 * byte) & 0xFFU));
    }
}

RowMask mask_of(std::uint64_t low, std::uint64_t high, int x0) {
    RowMask mask;
    mask.put(low, x0);
    if (high != 0) {
        mask.put(high, x0 + RowMask::kHalf);
    }
    return mask;
}

std::uint64_t ones(int bits) {
    return bits >= 64 ? ~std::uint64_t{0} : bits <= 0 ? 0 : (std::uint64_t{1} << bits) - 1;
}

// Reads a mask as one or two whole words, because that is faster than byte by byte, and cuts off
// the bits beyond it.
RowMask take_mask(const char*& from, int x0, int length) {
    std::uint64_t words[2] = {0, 0};
    std::memcpy(words, from, length <= RowMask::kHalf ? sizeof words[0] : sizeof words);
    from += bytes_of(length);
    if (host_is_big_endian()) { // bytes are written from the lowest one on
        words[0] = __builtin_bswap64(words[0]);
        words[1] = __builtin_bswap64(words[1]);
    }
    return mask_of(words[0] & ones(length), words[1] & ones(length - RowMask::kHalf), x0);
}

// The mask of all pixels of a span.
RowMask span_mask(int x0, int length) {
    return mask_of(ones(length), ones(length - RowMask::kHalf), x0);
}

void put_row(std::string& to, const RowOutcome& row) {
    to.push_back(static_cast<char>(row.x0));
    to.push_back(static_cast<char>(row.length));
    if (row.length == 0) {
        return;
    }
    const bool whole = row.inside == span_mask(row.x0, row.length);
    const bool all = row.useful == row.inside;
    const bool ends = row.ended.count() != 0;
    to.push_back(static_cast<char>((whole ? 0 : kInsideDiffers) | (all ? 0 : kUsefulDiffers) |
                                   (ends ? kEnds : 0)));
    if (!whole) {
        put_mask(to, row.inside, row.x0, row.length);
    }
    if (!all) {
        put_mask(to, row.useful, row.x0, row.length);
    }
    if (ends) {
        put_mask(to, row.ended, row.x0, row.length);
    }
}

void take_row(const char*& from, RowOutcome& row) {
    row = RowOutcome();
    row.x0 = static_cast<unsigned char>(*from++);
    row.length = static_cast<unsigned char>(*from++);
    if (row.length == 0) {
        return;
    }
    const auto parts = static_cast<unsigned char>(*from++);
    row.inside = (parts & kInsideDiffers) != 0 ? take_mask(from, row.x0, row.length)
                                               : span_mask(row.x0, row.length);
    row.useful = (parts & kUsefulDiffers) != 0 ? take_mask(from, row.x0, row.length) : row.inside;
    if ((parts & kEnds) != 0) {
        row.ended = take_mask(from, row.x0, row.length);
    }
}

template <class T>
void put(std::string& to, const T& value) {
    to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <class Real>
void put_pixels(std::string& to, const std::vector<PixelValue>& pixels) {
    for (const PixelValue& pixel : pixels) {
        StoredPixel<Real> stored{};
        std::copy_n(pixel.rgb, 3, stored.rgb);
        stored.transmittance = static_cast<Real>(pixel.transmittance);
        stored.updates = pixel.updates;
        stored.ended = pixel.ended ? 1 : 0;
        put(to, stored);
    }
}

template <class Real>
void take_pixels(const char* from, std::size_t first, std::size_t count, PixelValue* pixels) {
    from += first * sizeof(StoredPixel<Real>);
    for (; count > 0; --count, from += sizeof(StoredPixel<Real>), ++pixels) {
        StoredPixel<Real> stored;
        std::memcpy(&stored, from, sizeof stored);
        std::copy_n(stored.rgb, 3, pixels->rgb);
        pixels->transmittance = stored.transmittance;
        pixels->updates = stored.updates;
        pixels->ended = stored.ended != 0;
    }
}

bool is_float(double value) {
    return static_cast<double>(static_cast<float>(value)) == value;
}

// True for all values of number formats of up to 32 bits, which then take half of the bytes.
bool are_floats(const std::vector<PixelValue>& pixels) {
    return std::all_of(pixels.begin(), pixels.end(), [](const PixelValue& pixel) {
        return is_float(pixel.transmittance) && std::all_of(pixel.rgb, pixel.rgb + 3, is_float);
    });
}

} // namespace

void TileTraceWriter::add(const RowBatch& batch, std::uint32_t splats) {
    const RowOutcome* row = batch.outcomes.data();
    for (std::uint32_t i = 0; i < splats; ++i) {
        const PixelRange& rows = batch.splats[i].rows;
        const auto count = static_cast<unsigned char>(rows.empty() ? 0 : rows.size());
        rows_.push_back(static_cast<char>(count));
        if (count != 0) {
            rows_.push_back(static_cast<char>(rows.first));
        }
        for (int k = 0; k < count; ++k) {
            put_row(rows_, *row++);
        }
    }
    ends_.push_back(static_cast<std::uint32_t>(rows_.size()));
}

std::string TileTraceWriter::bytes(const std::vector<PixelValue>& pixels) const {
    const bool single = are_floats(pixels);
    std::string to;
    put(to, Head{static_cast<std::uint32_t>(ends_.size()),
                 static_cast<std::uint32_t>(pixels.size()), single ? 1U : 0U});
    for (const std::uint32_t end : ends_) {
        put(to, end);
    }
    single ? put_pixels<float>(to, pixels) : put_pixels<double>(to, pixels);
    return (to += rows_).append(sizeof(RowMask), '\0'); // for take_mask()
}

TileTraceReader::TileTraceReader(std::string_view bytes) {
    if (bytes.data() == nullptr) {
        return;
    }
    Head head;
    std::memcpy(&head, bytes.data(), sizeof head);
    batches_ = head[0];
    single_ = head[2] != 0;
    ends_ = bytes.data() + sizeof head;
    pixels_ = ends_ + batches_ * sizeof(std::uint32_t);
    rows_ =
        pixels_ + head[1] * (single_ ? sizeof(StoredPixel<float>) : sizeof(StoredPixel<double>));
}

void TileTraceReader::read(std::uint32_t index, std::uint32_t splats, RowBatch& batch) const {
    std::uint32_t begin = 0;
    if (index != 0) {
        std::memcpy(&begin, ends_ + (index - 1) * sizeof begin, sizeof begin);
    }
    const char* from = rows_ + begin;
    for (std::uint32_t i = 0; i < splats; ++i) {
        const int count = static_cast<unsigned char>(*from++);
        const std::size_t before = batch.outcomes.size();
        batch.splats[i] = {PixelRange{}, before};
        if (count != 0) {
            const int first = static_cast<unsigned char>(*from++);
            batch.splats[i].rows = {first, first + count - 1};
            batch.outcomes.resize(before + count);
            for (int k = 0; k < count; ++k) {
                take_row(from, batch.outcomes[before + k]);
            }
        }
    }
}

void TileTraceReader::read_pixels(std::size_t first, std::size_t count, PixelValue* pixels) const {
    single_ ? take_pixels<float>(pixels_, first, count, pixels)
            : take_pixels<double>(pixels_, first, count, pixels);
}

} // namespace degs
