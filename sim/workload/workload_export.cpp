// SPDX-License-Identifier: Apache-2.0
#include "sim/workload/workload_export.hpp"

#include <charconv>
#include <functional>
#include <ostream>

#include "scene/files/input_file.hpp"
#include "scene/files/output_file.hpp"
#include "sim/cache/digest.hpp"

namespace degs::sim {
namespace {

/// Collects lines of numbers and writes them in blocks.
class NumberTable {
public:
    NumberTable(std::ostream& out, const std::string& header) : out_(out), text_(header + "\n") {}

    template <class First, class... Rest>
    void add(First first, Rest... rest) {
        add_number(first);
        ((text_ += ',', add_number(rest)), ...);
        text_ += '\n';
        ++records_;
        if (text_.size() > kBlock) {
            flush();
        }
    }
    void flush() {
        digest_.add_bytes(text_);
        out_ << text_;
        text_.clear();
    }
    std::uint64_t records() const { return records_; }
    std::string digest() const { return digest_.text(); }

private:
    static constexpr std::size_t kBlock = 1U << 16U;

    template <class Number>
    void add_number(Number number) {
        char digits[32];
        text_.append(digits, std::to_chars(digits, digits + sizeof digits, number).ptr);
    }

    std::ostream& out_;
    std::string text_;
    Digest digest_;
    std::uint64_t records_ = 0;
};

ExportedFile write_table(const OutputFolder& out, const std::string& name,
                         const std::string& header,
                         const std::function<void(NumberTable& table)>& fill) {
    ExportedFile file{name, 0, {}};
    write_whole(out.path(name), [&](std::ostream& stream) {
        NumberTable table(stream, header);
        fill(table);
        table.flush();
        file.records = table.records();
        file.xxh128 = table.digest();
    });
    return file;
}

int number_of(const JobTile& tile, const FrameWorkload& frame) {
    return frame.grid().tile_of_pixel(tile.x, tile.y);
}

void fill_lists(const RenderJob& job, const FrameWorkload& frame, NumberTable& table) {
    for (const JobTile& tile : job.tiles) {
        for (std::uint64_t place = 0; place < tile.count; ++place) {
            const std::uint32_t splat = frame.tile_splats[tile.first + place];
            table.add(number_of(tile, frame), place, splat, frame.splats[splat].depth,
                      frame.splats[splat].id);
        }
    }
}

/// Returns the pixels of all rows.
std::uint64_t fill_rows(const RenderJob& job, const FrameWorkload& frame, NumberTable& table) {
    std::uint64_t pixels = 0;
    for (const JobTile& tile : job.tiles) {
        const int end = tile.x + tile.width;
        for (std::uint64_t place = 0; place < tile.count; ++place) {
            const std::uint32_t splat = frame.tile_splats[tile.first + place];
            const std::uint32_t record = job.first_splat.front() + splat;
            const PixelRange rows =
                job.path->rows_in_columns(record, tile.x, end).within(tile.rows());
            for (int y = rows.first; y <= rows.last; ++y) {
                auto row = job.path->solve_row(record, y, tile.x, end, tile.y);
                if (row && cut(*row, tile.image_columns())) {
                    table.add(number_of(tile, frame), splat, row->y, row->x0, row->length);
                    pixels += row->length;
                }
            }
        }
    }
    return pixels;
}

} // namespace

std::vector<std::string> workload_files() {
    return {"workload.json", "lists.csv", "rows.csv"};
}

ExportedWorkload export_workload(const FrameWorkload& frame, const AcceleratorConfig& design,
                                 const OutputFolder& out) {
    const RenderJob job = make_render_job({&frame}, design);
    ExportedWorkload result;
    result.tile_size = frame.tile_size;
    result.tiles_x = frame.tiles_x;
    result.tiles_y = frame.tiles_y;
    result.tiles = job.tiles.size();
    result.splats = frame.splats.size();
    result.lists = write_table(out, "lists.csv", "tile,place,splat,depth,gaussian",
                               [&](NumberTable& table) { fill_lists(job, frame, table); });
    result.rows = write_table(out, "rows.csv", "tile,splat,row,x0,length", [&](NumberTable& table) {
        result.pixels = fill_rows(job, frame, table);
    });
    return result;
}

} // namespace degs::sim
