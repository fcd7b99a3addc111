// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/ply/ply_header.hpp"

namespace degs {

/// Where a scalar property stands inside the rows that `PlyRows` delivers.
struct PlyColumn {
    PlyType type = PlyType::Float32;
    std::size_t offset = 0; ///< bytes from the start of the row
};

/// White-space separated words of an ASCII body.
class PlyWords {
public:
    explicit PlyWords(InputFile& file) : file_(&file), buffer_(kBufferBytes) {}
    /// Valid until the next call; empty at the end of the file.
    std::string_view next();
    /// Whether nothing but blanks is left, which are then passed over.
    bool at_end();
    /// Line ends in front of the last word that was delivered.
    std::uint64_t line() const { return line_; }
    /// Bytes not delivered yet; the file itself is read ahead.
    std::uint64_t remaining() const { return file_->remaining() + (end_ - begin_); }

private:
    static constexpr std::size_t kBufferBytes = 1 << 18;
    static constexpr std::size_t kMaxWord = 512; ///< longer "numbers" are refused

    bool peek(char& c);

    InputFile* file_;
    std::vector<char> buffer_;
    std::size_t begin_ = 0;
    std::size_t end_ = 0;
    std::uint64_t line_ = 0;
    std::array<char, kMaxWord> word_{};
};

/// The body of a PLY file, of which one element is read, or several in their order. Delivers the
/// scalars of its rows at a fixed pitch, whatever the file does: binary rows as they are, rows with
/// lists packed without the lists, ASCII rows as native doubles.
class PlyRows {
public:
    /// `file` stands at the first byte of data. Skips every element before `element`, then checks
    /// that the file is long enough for it. `element` is one of the header, and all references must
    /// outlive this object.
    PlyRows(InputFile& file, const PlyHeader& header, const PlyElement& element);

    std::size_t row_bytes() const { return row_bytes_; }
    bool swap_bytes() const { return swap_; } ///< values are of the other endianness
    /// The place of a scalar property, which must exist.
    PlyColumn column(const std::string& property) const;
    /// Reads the next `count` rows to `destination` (count * row_bytes() bytes).
    void read(char* destination, std::size_t count);
    /// Goes on to an element that stands behind this one, all rows of which have been read. Its
    /// size is checked as that of the first.
    void move_to(const PlyElement& later);
    /// To be called when all rows have been read: skips the elements behind them, unless the file
    /// ends here. InputError if they are cut off, or if data is left over behind the last one,
    /// since the header and the data then do not agree.
    void finish();

private:
    void skip_to(const PlyElement* end);
    void lay_out();
    void check_size(const PlyElement& element) const;
    void skip_element(const PlyElement& element);
    void skip_binary_list(const PlyProperty& list);
    void skip_row();
    void read_listed_row(char* destination);
    void read_ascii_row(char* destination);
    void end_row();
    std::uint64_t list_length(const PlyProperty& list);
    double next_number(const PlyProperty& property);
    [[noreturn]] void fail_at(const PlyProperty& property, const std::string& sentence) const;

    InputFile* file_;
    const PlyHeader* header_;
    const PlyElement* next_; ///< the first one whose rows have neither been skipped nor read
    const PlyElement* element_ = nullptr;
    PlyFormat format_;
    bool swap_ = false;
    PlyWords words_;
    const PlyElement* current_ = nullptr;        ///< being skipped or read
    bool row_begun_ = false;                     ///< a word of an ASCII row has been read
    std::uint64_t row_line_ = 0, last_line_ = 0; ///< where it began, where the row before ended
    std::uint64_t row_ = 0;                      ///< of `current_`
    std::size_t row_bytes_ = 0;
    std::vector<PlyColumn> columns_; ///< per property; unused for lists
};

} // namespace degs
