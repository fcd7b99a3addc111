// SPDX-License-Identifier: Apache-2.0
// Columns of numbers as planes of bytes; docs/workload.md has their form.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct ZSTD_DCtx_s;

namespace degs::sim {

/// No block becomes more than this number of times as long when it is unpacked.
constexpr std::size_t kMostInflation = 1024;

/// Makes a block out of columns of equally many values.
class PlaneWriter {
public:
    void put(const std::vector<std::uint32_t>& column);
    /// Takes 4 bytes a value if all values are exact in single precision, else 8.
    void put(const std::vector<double>& column);
    /// The block: compressed, but at least `plain_bytes` / kMostInflation long.
    std::string block(std::size_t plain_bytes) const;

private:
    template <class Bits>
    void put_planes(const std::vector<Bits>& column);

    std::string packed_, plain_; ///< the planes compressed where that is shorter, and as they are
};

/// Takes the columns of a block out again.
class PlaneReader {
public:
    /// What one thread needs for the blocks that it reads.
    class Workspace {
    public:
        Workspace();

    private:
        friend class PlaneReader;
        struct Free {
            void operator()(ZSTD_DCtx_s* context) const;
        };
        std::unique_ptr<ZSTD_DCtx_s, Free> context_;
        std::vector<std::unique_ptr<char[]>> planes_;
        std::size_t values_ = 0; ///< that a plane has room for
    };

    /// The planes of a column, in the block or in the workspace.
    struct Column {
        std::size_t bytes = 0; ///< of a value
        std::array<const unsigned char*, 8> planes{};
        /// Values begin .. begin + count - 1 of a column of 4 bytes a value.
        void get(std::size_t begin, std::size_t count, std::uint32_t* values) const;
        void get(std::size_t begin, std::size_t count, float* values) const;
        /// Values likewise of a column of 4 or 8 bytes a value.
        void get(std::size_t begin, std::size_t count, double* values) const;
    };

    /// Block and workspace outlive the reader.
    PlaneReader(std::string_view block, std::size_t values, Workspace& workspace);

    /// The next column, whose values have 4 bytes, or 8 where `wide` ones are allowed. False if the
    /// block is damaged.
    bool next(bool wide, Column& column);
    /// Nothing is left over.
    bool complete() const { return block_.empty(); }

private:
    bool take_plane(const unsigned char*& plane);
    char* room();

    std::string_view block_; ///< what has not been read
    std::size_t values_;
    Workspace& workspace_;
    std::size_t used_ = 0; ///< planes of the workspace
};

} // namespace degs::sim
