// SPDX-License-Identifier: Apache-2.0
// Compressed data as a stream, so that nothing is held in memory that is decoded at once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace degs {

/// Bytes one after the other. Every failure is an InputError that names `where`.
class ByteStream {
public:
    explicit ByteStream(std::string where) : where_(std::move(where)) {}
    ByteStream(const ByteStream&) = delete;
    ByteStream& operator=(const ByteStream&) = delete;
    virtual ~ByteStream() = default;

    /// Up to `bytes`; fewer at the end of the stream only. InputError if the stream is damaged.
    virtual std::size_t read_some(char* to, std::size_t bytes) = 0;
    /// Exactly `bytes`; InputError if the stream ends before.
    void read_exactly(char* to, std::size_t bytes);
    /// Moves on by `bytes`; InputError if the stream ends before.
    void skip(std::uint64_t bytes);

protected:
    const std::string& where() const { return where_; }

private:
    std::string where_;
};

/// The content of one gzip member that fills `bytes`; zeros may follow (padding of a container).
std::unique_ptr<ByteStream> gzip_stream(const std::string& where, std::string_view bytes);
/// The content of the ZSTD frames that fill `bytes`; frames that need a window of more than 8 MiB
/// are refused.
std::unique_ptr<ByteStream> zstd_stream(const std::string& where, std::string_view bytes);

} // namespace degs
