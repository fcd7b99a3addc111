// SPDX-License-Identifier: Apache-2.0
// A functional model on a thread of its own, and traces that other simulations have kept, give what
// rasterising on demand gives, whatever the simulation takes and when.
#include "modules/degs/functional/functional_thread.hpp"

#include <random>
#include <thread>

#include "base/parallel.hpp"
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {

static bool operator==(const RowOutcome& a, const RowOutcome& b) {
    return a.inside == b.inside && a.useful == b.useful && a.ended == b.ended && a.x0 == b.x0 &&
           a.length == b.length;
}
static bool operator==(const PixelValue& a, const PixelValue& b) {
    return std::equal(a.rgb, a.rgb + 3, b.rgb) && a.transmittance == b.transmittance &&
           a.updates == b.updates && a.ended == b.ended;
}

namespace {

using test::random_frame;

/// Sets whether the model has a thread of its own; restores the number of threads.
struct HostThreads {
    explicit HostThreads(bool ahead) { limit_host_threads(ahead ? 2 : 1); }
    ~HostThreads() { limit_host_threads(static_cast<int>(std::thread::hardware_concurrency())); }
    HostThreads(const HostThreads&) = delete;
    HostThreads& operator=(const HostThreads&) = delete;
};

struct Taken {
    std::vector<RowOutcome> rows;
    std::vector<PixelValue> pixels;
    std::uint64_t fragments = 0;
};

/// One module's place in a tile.
struct Reader {
    TileNumber tile = 0;
    int module = 0;
    std::uint32_t place = 0, end = 0; // `end`: where it is told that the tile has ended
};

/// Takes tiles as modules do that share them, several tiles at a time, in an order that `seed`
/// decides. Each module stops some splats behind the one that ended its tile; `joining` tiles are
/// in the job at first.
class Simulation {
public:
    Simulation(RenderJob& job, const FunctionalOptions& options, std::uint32_t seed)
        : job_(job), options_(options), random_(seed) {}

    Taken run(std::size_t joining = 0, const KeptTiles& kept = {}) {
        TileList all = std::move(job_.tiles);
        job_.tiles = TileList();
        const auto join = [&](std::size_t count) {
            while (job_.tiles.size() < std::min(count, all.size())) {
                job_.tiles.push_back(all[job_.tiles.size()]);
            }
        };
        join(joining == 0 ? all.size() : joining);
        const std::unique_ptr<FunctionalModel> model = make_functional_model(job_, options_, kept);
        Taken taken;
        taken.pixels.reserve(100000);
        for (TileNumber first = 0; first < all.size(); first += kAtOnce) {
            join(first + kAtOnce);
            run_tiles(*model, first,
                      std::min<std::size_t>(all.size(), std::size_t{first} + kAtOnce), taken);
        }
        taken.fragments = model->fragments();
        return taken;
    }

private:
    static constexpr TileNumber kAtOnce = 3;

    void run_tiles(FunctionalModel& model, TileNumber first, std::size_t end, Taken& taken) {
        std::vector<Reader> readers;
        std::vector<std::vector<RowOutcome>> rows((end - first) * options_.modules);
        for (TileNumber tile = first; tile < end; ++tile) {
            for (int module = 0; module < options_.modules; ++module) {
                const auto count = static_cast<std::uint32_t>(job_.tiles[tile].count);
                readers.push_back({tile, module, 0, count});
            }
        }
        std::vector<std::int64_t> live;
        for (TileNumber tile = first; tile < end; ++tile) {
            live.push_back(std::int64_t{1} * job_.tiles[tile].width * job_.tiles[tile].height);
        }
        while (!readers.empty()) {
            const std::size_t next = random_() % readers.size();
            Reader& reader = readers[next];
            const std::size_t number = reader.tile - first;
            if (live[number] == 0) { // the tile has ended, which the module hears later
                reader.end = std::min<std::uint32_t>(
                    reader.end, reader.place + 1 + static_cast<std::uint32_t>(random_() % 90));
                live[number] = -1;
            }
            step(model, reader, rows[number * options_.modules + reader.module], live[number]);
            if (reader.place >= reader.end) {
                readers.erase(readers.begin() + static_cast<std::ptrdiff_t>(next));
            }
        }
        for (const std::vector<RowOutcome>& of_module : rows) {
            taken.rows.insert(taken.rows.end(), of_module.begin(), of_module.end());
        }
        for (TileNumber tile = first; tile < end; ++tile) {
            read_out(model, tile, taken);
        }
    }

    void step(FunctionalModel& model, Reader& reader, std::vector<RowOutcome>& rows,
              std::int64_t& live) {
        const PixelRange all = model.rows(reader.tile, reader.place);
        const int step = options_.modules;
        PixelRange own = all;
        own.first += (reader.module - all.first % step + step) % step;
        const std::size_t before = rows.size();
        rows.resize(before + (own.empty() ? 0 : (own.last - own.first) / step + 1));
        model.take(reader.tile, reader.place, own, step, rows.data() + before);
        for (std::size_t i = before; i < rows.size(); ++i) {
            live -= rows[i].ended.count();
        }
        ++reader.place;
    }

    void read_out(FunctionalModel& model, TileNumber number, Taken& taken) {
        const JobTile tile = job_.tiles[number];
        for (int row = 0; row < job_.tile_size; ++row) {
            if (row < tile.height) {
                taken.pixels.resize(taken.pixels.size() + tile.width);
                model.read_row(number, row, tile.width,
                               taken.pixels.data() + taken.pixels.size() - tile.width);
            }
            model.clear_row(number, row);
        }
    }

    RenderJob& job_;
    FunctionalOptions options_;
    std::mt19937 random_;
};

struct Case {
    const char* numbers;
    FunctionalOptions options;
    int splats;
    std::size_t joining;
};
std::ostream& operator<<(std::ostream& out, const Case& c) {
    return out << c.numbers << "_modules" << c.options.modules << "_splats" << c.splats
               << (c.options.tests ? "_tested" : "") << (c.joining != 0 ? "_joining" : "");
}

class FunctionalOnThread : public ::testing::TestWithParam<Case> {};

TEST_P(FunctionalOnThread, GivesWhatTheModelOnDemandGives) {
    const Case& given = GetParam();
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
        const FrameWorkload frame = random_frame(seed, 150, 83, 32, given.splats);
        const auto taken = [&](bool ahead) {
            const HostThreads threads(ahead);
            RenderJob job = make_render_job({&frame}, named_numbers(given.numbers), 2);
            return Simulation(job, given.options, seed).run(given.joining);
        };
        const Taken demanded = taken(false);
        const Taken ahead = taken(true);
        EXPECT_GT(demanded.fragments, 1000U);
        EXPECT_EQ(ahead.fragments, demanded.fragments);
        EXPECT_TRUE(ahead.rows == demanded.rows);
        EXPECT_TRUE(ahead.pixels == demanded.pixels);
    }
}

TEST_P(FunctionalOnThread, GivesWhatAnotherSimulationHasKept) {
    const Case& given = GetParam();
    SharedBytes bytes(std::size_t{1} << 26U);
    const KeptTiles kept{&bytes, given.numbers};
    const FrameWorkload frame = random_frame(7, 150, 83, 32, given.splats);
    const auto taken = [&](std::uint32_t seed, const KeptTiles& others) {
        RenderJob job = make_render_job({&frame}, named_numbers(given.numbers), 2);
        const HostThreads threads(false);
        return Simulation(job, given.options, seed).run(given.joining, others);
    };
    std::size_t used = 0;
    for (std::uint32_t seed = 1; seed <= 4; ++seed) { // the first one keeps, the others take
        const Taken demanded = taken(seed, {});
        const Taken shared = taken(seed, kept);
        EXPECT_EQ(shared.fragments, demanded.fragments);
        EXPECT_TRUE(shared.rows == demanded.rows);
        EXPECT_TRUE(shared.pixels == demanded.pixels);
        EXPECT_GT(bytes.used(), 1000U);
        EXPECT_TRUE(seed == 1 || bytes.used() == used) << "a tile was rasterised anew";
        used = bytes.used();
    }
}

INSTANTIATE_TEST_SUITE_P(Designs, FunctionalOnThread,
                         ::testing::Values(Case{"fp32", {false, SlicedRows::Splat, 1}, 4000, 0},
                                           Case{"fp64", {false, SlicedRows::Tile, 2}, 900, 0},
                                           Case{"paper", {false, SlicedRows::Tile, 4}, 3000, 0},
                                           Case{"fp32", {true, SlicedRows::Splat, 1}, 3000, 0},
                                           Case{"fp32", {false, SlicedRows::Tile, 2}, 3000, 2},
                                           Case{"tuned", {false, SlicedRows::Splat, 1}, 40, 0}),
                         ::testing::PrintToStringParamName());

TEST(FunctionalCache, KeepsPixelsOfOtherNumbersApart) {
    SharedBytes bytes(std::size_t{1} << 26U);
    const FrameWorkload frame = random_frame(7, 150, 83, 32, 300);
    const auto taken = [&](const char* numbers, const KeptTiles& kept) {
        RenderJob job = make_render_job({&frame}, named_numbers(numbers), 2);
        return Simulation(job, {}, 1).run(0, kept);
    };
    for (const char* numbers : {"fp32", "paper", "fp64"}) {
        EXPECT_TRUE(taken(numbers, {&bytes, numbers}).pixels == taken(numbers, {}).pixels)
            << numbers;
    }
}

TEST(FunctionalCache, RasterisesWhatFindsNoRoom) {
    const FrameWorkload frame = random_frame(7, 150, 83, 32, 300);
    const auto taken = [&](const KeptTiles& kept) {
        RenderJob job = make_render_job({&frame}, named_numbers("fp32"), 2);
        return Simulation(job, {}, 1).run(0, kept);
    };
    const Taken alone = taken({});
    for (const std::size_t room : {0, 100, 20000}) {
        SharedBytes bytes(room);
        for (int run = 0; run < 2; ++run) {
            EXPECT_TRUE(taken({&bytes, "fp32"}).pixels == alone.pixels) << room << " bytes";
        }
    }
}

TEST(FunctionalOnThreadAlone, EndsWithWorkLeft) {
    const FrameWorkload frame = random_frame(5, 150, 83, 32, 4000);
    const HostThreads threads(true);
    for (int taken = 0; taken < 3; ++taken) {
        RenderJob job = make_render_job({&frame}, named_numbers("fp32"), 2);
        FunctionalThread model(job, {});
        for (std::uint32_t place = 0; place < static_cast<std::uint32_t>(taken); ++place) {
            EXPECT_FALSE(model.rows(1, 40 * place).empty());
        }
    }
}

} // namespace
} // namespace degs
