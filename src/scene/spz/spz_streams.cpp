// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz_streams.hpp"

#include <algorithm>
#include <limits>

#include <zlib.h>
#include <zstd.h>

#include "scene/files/input_file.hpp"

namespace degs {
namespace {

class GzipStream : public ByteStream {
public:
    GzipStream(const std::string& where, std::string_view bytes) : ByteStream(where), rest_(bytes) {
        constexpr int kGzipOnly = 16;
        if (inflateInit2(&state_, kGzipOnly + MAX_WBITS) != Z_OK) {
            fail_file(where, "zlib could not be started.");
        }
    }
    GzipStream(const GzipStream&) = delete;
    GzipStream& operator=(const GzipStream&) = delete;
    ~GzipStream() override { inflateEnd(&state_); }

    std::size_t read_some(char* to, std::size_t bytes) override {
        std::size_t done = 0;
        while (done < bytes && !ended_) {
            const std::size_t step = chunk(bytes - done);
            state_.next_out = reinterpret_cast<Bytef*>(to + done);
            state_.avail_out = static_cast<uInt>(step);
            inflate_once();
            done += step - state_.avail_out;
        }
        return done;
    }

private:
    static std::size_t chunk(std::size_t bytes) {
        return std::min<std::size_t>(bytes, std::numeric_limits<uInt>::max());
    }

    void inflate_once() {
        const std::size_t input = chunk(rest_.size());
        // zlib reads only, but says so only where it is told to.
        state_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(rest_.data()));
        state_.avail_in = static_cast<uInt>(input);
        const int code = inflate(&state_, Z_NO_FLUSH);
        rest_.remove_prefix(input - state_.avail_in);
        if (code == Z_BUF_ERROR) {
            fail_file(where(), "its gzip data ends too early; the file is truncated.");
        }
        if (code != Z_OK && code != Z_STREAM_END) {
            fail_file(where(), std::string("its gzip data is damaged (") +
                                   (state_.msg == nullptr ? "zlib names no reason" : state_.msg) +
                                   ").");
        }
        if (code == Z_STREAM_END && rest_.substr(0, 2) == "\x1f\x8b") {
            inflateReset(&state_); // members one behind the other are one text, as for gzip(1)
            return;
        }
        ended_ = code == Z_STREAM_END;
        if (ended_ && rest_.find_first_not_of('\0') != std::string_view::npos) {
            fail_file(where(), std::to_string(rest_.size()) +
                                   " bytes follow behind its gzip data, where only zeros may.");
        }
    }

    std::string_view rest_;
    z_stream state_{};
    bool ended_ = false;
};

class ZstdStream : public ByteStream {
public:
    ZstdStream(const std::string& where, std::string_view bytes)
        : ByteStream(where), input_{bytes.data(), bytes.size(), 0}, state_(ZSTD_createDCtx()) {
        constexpr int kWindowBits = 23;
        if (!state_ || ZSTD_isError(ZSTD_DCtx_setParameter(state_.get(), ZSTD_d_windowLogMax,
                                                           kWindowBits)) != 0) {
            fail_file(where, "libzstd could not be started.");
        }
    }

    std::size_t read_some(char* to, std::size_t bytes) override {
        ZSTD_outBuffer output{to, bytes, 0};
        while (output.pos < output.size) {
            const std::size_t before = output.pos;
            const bool no_input = input_.pos == input_.size;
            if (no_input && frame_done_) {
                break;
            }
            const std::size_t hint = ZSTD_decompressStream(state_.get(), &output, &input_);
            if (ZSTD_isError(hint) != 0) {
                fail_file(where(), std::string("its ZSTD data is damaged (") +
                                       ZSTD_getErrorName(hint) + ").");
            }
            frame_done_ = hint == 0;
            if (no_input && output.pos == before && !frame_done_) {
                fail_file(where(), "its ZSTD data ends too early; the file is truncated.");
            }
        }
        return output.pos;
    }

private:
    struct Free {
        void operator()(ZSTD_DCtx* state) const { ZSTD_freeDCtx(state); }
    };
    ZSTD_inBuffer input_;
    std::unique_ptr<ZSTD_DCtx, Free> state_;
    bool frame_done_ = false;
};

} // namespace

void ByteStream::read_exactly(char* to, std::size_t bytes) {
    const std::size_t got = read_some(to, bytes);
    if (got != bytes) {
        fail_file(where_, "its compressed data holds fewer bytes than its header promises.");
    }
}

void ByteStream::skip(std::uint64_t bytes) {
    char scratch[4096];
    while (bytes > 0) {
        const std::size_t step = std::min<std::uint64_t>(bytes, sizeof scratch);
        read_exactly(scratch, step);
        bytes -= step;
    }
}

std::unique_ptr<ByteStream> gzip_stream(const std::string& where, std::string_view bytes) {
    return std::make_unique<GzipStream>(where, bytes);
}

std::unique_ptr<ByteStream> zstd_stream(const std::string& where, std::string_view bytes) {
    return std::make_unique<ZstdStream>(where, bytes);
}

} // namespace degs
