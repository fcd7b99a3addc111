// SPDX-License-Identifier: Apache-2.0
// degs workload export: the files hold what the array of a run gets.
#include <cmath>
#include <set>
#include <sstream>

#include "sim/cache/digest.hpp"
#include "tests/sim/trace/block_log.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;
using Row = std::vector<double>;

const Words kExported{"--scene", "synthetic:object,gaussians=1000", "--width", "160"};

struct Exported {
    json about;
    std::vector<Row> lists, rows;
};

std::vector<Row> table(const std::string& text, const std::string& header) {
    std::istringstream lines(text);
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, header);
    std::vector<Row> rows;
    while (std::getline(lines, line)) {
        rows.emplace_back();
        std::istringstream cells(line);
        for (std::string cell; std::getline(cells, cell, ',');) {
            rows.back().push_back(std::stod(cell));
        }
    }
    return rows;
}

Exported exported(const std::string& design, const Words& more = {}) {
    const Folder folder;
    Words arguments{"workload", "export", config(design), "--no-cache", "--out", folder / "out"};
    arguments.insert(arguments.end(), kExported.begin(), kExported.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    Exported result;
    result.about = json::parse(read_file(folder / "out/workload.json"));
    const json& files = result.about["files"];
    for (const json& file : files) {
        sim::Digest digest;
        digest.add_bytes(read_file(folder / ("out/" + file["name"].get<std::string>())));
        EXPECT_EQ(file["xxh128"], digest.text());
    }
    result.lists = table(read_file(folder / "out/lists.csv"), "tile,place,splat,depth,gaussian");
    result.rows = table(read_file(folder / "out/rows.csv"), "tile,splat,row,x0,length");
    EXPECT_EQ(files[0]["records"], result.lists.size());
    EXPECT_EQ(files[1]["records"], result.rows.size());
    return result;
}

json report_of_run(const std::string& design) {
    const Folder folder;
    Words arguments{"run", config(design), "--no-reference", "--out", folder / "out"};
    arguments.insert(arguments.end(), kExported.begin(), kExported.end());
    expect_success(degs(arguments));
    return report_in(folder / "out");
}

// No tile of this view is finished before its list ends, so the run solves every row.
TEST(SmallRunWorkload, HasTheListsAndTheSpansOfARun) {
    const Exported work = exported("degs-64");
    const json report = report_of_run("degs-64");
    EXPECT_EQ(work.lists.size(), report["workload"]["tile_pairs"]);
    EXPECT_EQ(work.about["splats"], report["workload"]["visible"]);
    EXPECT_EQ(work.rows.size(), report["stages"]["span"]["spans"]);
    const std::set<Row> rows(work.rows.begin(), work.rows.end());
    EXPECT_EQ(rows.size(), work.rows.size()) << "a row of a splat is solved once";
    const BlockLog span = logged(kExported, "degs-64", "span:3");
    std::size_t found = 0;
    for (const auto& event : span.events) {
        if (event.kind() == "span" && event["end"] == 0) {
            Row row;
            for (const char* field : {"tile", "splat", "row", "x0", "length"}) {
                row.push_back(static_cast<double>(event[field]));
            }
            EXPECT_EQ(rows.count(row), 1U) << row[0] << " " << row[1] << " " << row[2];
            ++found;
        }
    }
    EXPECT_GT(found, 1000U);
}

TEST(SmallRunWorkload, ListsAreNearToFarAndRowsInsideTheirTile) {
    const Exported work = exported("degs-64");
    for (std::size_t i = 1; i < work.lists.size(); ++i) {
        const Row &before = work.lists[i - 1], &entry = work.lists[i];
        const bool same = before[0] == entry[0];
        EXPECT_EQ(entry[1], same ? before[1] + 1 : 0);
        EXPECT_TRUE(!same || before[3] <= entry[3]) << i;
    }
    double pixels = 0;
    for (const Row& row : work.rows) {
        EXPECT_GE(row[3], 0);
        EXPECT_GE(row[4], 1);
        EXPECT_LE(row[3] + row[4], 32);
        pixels += row[4];
    }
    EXPECT_EQ(work.about["pixels"], pixels);
}

// Columns 20 to 119 are drawn, of four columns of tiles.
TEST(Workload, RowsEndWhereACropDoes) {
    const Exported work = exported("degs-64", {"--crop", "20,8,100x60"});
    ASSERT_GT(work.rows.size(), 1000U);
    bool begins = false, ends = false;
    for (const Row& row : work.rows) {
        const double column = 32 * std::fmod(row[0], 4);
        EXPECT_GE(column + row[3], 20);
        EXPECT_LE(column + row[3] + row[4], 120);
        begins = begins || column + row[3] == 20;
        ends = ends || column + row[3] + row[4] == 120;
    }
    EXPECT_TRUE(begins && ends);
}

class SmallRunWorkloadOf : public testing::TestWithParam<std::string> {};

TEST_P(SmallRunWorkloadOf, HasTheListsOfTheRun) {
    const Exported work = exported(GetParam());
    const json report = report_of_run(GetParam());
    EXPECT_EQ(work.lists.size(), report["workload"]["tile_pairs"]);
    EXPECT_EQ(work.about["design"], GetParam());
    EXPECT_GT(work.rows.size(), work.lists.size());
}
INSTANTIATE_TEST_SUITE_P(All, SmallRunWorkloadOf,
                         testing::Values("gscore-64", "gbu-64", "gcc-64", "orange-o1",
                                         "degs-64-tuned"),
                         [](const auto& design) {
                             std::string name = design.param;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

// What was there before stays whole if the new files cannot be written.
TEST(HostileWorkload, IsRefusedInASentence) {
    const Folder folder;
    expect_mistake(degs({"workload"}), "subcommand");
    expect_mistake(degs({"workload", "export", config("degs-64"), "--scene", "none.ply", "--out",
                         folder / "out"}),
                   "none.ply");
    fs::create_directories(folder / "out/rows.csv");
    expect_mistake(degs({"workload", "export", config("degs-64"), "--scene", "synthetic:single",
                         "--out", folder / "out"}),
                   "'rows.csv' in it is not a file");
    EXPECT_FALSE(fs::exists(folder / "out/lists.csv"));
}

} // namespace
} // namespace degs::sim_test
