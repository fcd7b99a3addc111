// SPDX-License-Identifier: Apache-2.0
// degs explore: its parts by hand, and searches against all points of a space.
#include <chrono>
#include <cmath>
#include <csignal>
#include <map>
#include <set>
#include <thread>

#include "sim/search/breeding.hpp"
#include "sim/search/forecast.hpp"
#include "sim/search/hypervolume.hpp"
#include "tests/sim/process/csv_rows.hpp"
#include "tests/sim/sweep/search_spaces.hpp"

namespace degs::sim_test {
namespace {

using namespace degs::sim;

/// A space of 8^10 places, whose front has the product 1 of two costs; a limit cuts it.
Individual individual(const Genes& place) {
    double spoilt = 0;
    for (std::size_t g = 1; g < place.size(); ++g) {
        spoilt += std::abs(static_cast<double>(place[g]) - 3);
    }
    const double first = std::exp2(static_cast<double>(place[0])) * (1 + spoilt);
    return {place, {first, (1 + spoilt) * (1 + spoilt) / first}, std::max(0.0, first / 32 - 1)};
}

std::vector<Goals> bred_front(std::uint64_t seed, std::size_t& designs) {
    Breeding breeding(std::vector<Gene>(10, Gene{8, true}), 40, seed);
    std::vector<Goals> within;
    std::set<Genes> seen;
    for (int generation = 0; generation < 60; ++generation) {
        std::vector<Individual> children;
        for (int child = 0; child < 40; ++child) {
            const Genes place = breeding.propose();
            if (seen.insert(place).second) {
                children.push_back(individual(place));
                if (children.back().excess == 0) {
                    within.push_back(children.back().costs);
                }
            }
        }
        breeding.take(std::move(children));
    }
    designs = seen.size();
    std::vector<Goals> front;
    for (const std::size_t position : pareto_front(within)) {
        front.push_back(within[position]);
    }
    return front;
}

TEST(Breeding, FindsAFrontInABillionPlaces) {
    const std::vector<Goals> best{{1, 1},     {2, 0.5},     {4, 0.25},
                                  {8, 0.125}, {16, 0.0625}, {32, 0.03125}};
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        std::size_t designs = 0;
        const std::vector<Goals> found = bred_front(seed, designs);
        EXPECT_LE(designs, 2400U);
        EXPECT_GE(hypervolume(found, {33, 2}), 0.99 * hypervolume(best, {33, 2})) << seed;
        EXPECT_EQ(found, bred_front(seed, designs)) << "the seed decides everything";
    }
}

TEST(Forecast, CorrectsByTheRatiosOfSimilarDesigns) {
    Forecast forecast({{2, false}, {5, true}}, 2);
    const Columns estimated{std::log(10.0), std::nullopt};
    forecast.conclude();
    EXPECT_EQ(forecast.at({0, 0}, estimated).columns, estimated);
    forecast.learn({0, 0}, {std::log(10.0), std::nullopt}, {std::log(11.0), std::log(3.0)});
    forecast.learn({0, 4}, {std::log(20.0), std::nullopt}, {std::log(30.0), std::log(4.0)});
    forecast.conclude();
    const Expectation known = forecast.at({0, 0}, estimated);
    EXPECT_NEAR(std::exp(*known.columns[0]), 11, 0.02); // what was simulated is known
    EXPECT_NEAR(std::exp(*known.columns[1]), 3, 0.02);
    const Expectation near = forecast.at({0, 1}, {std::log(100.0), std::nullopt});
    EXPECT_GT(std::exp(*near.columns[0]), 110); // 1.1 is nearer than 1.5
    EXPECT_LT(std::exp(*near.columns[0]), 125);
    EXPECT_GT(near.deviations[0], 2 * known.deviations[0]);
    const Expectation far = forecast.at({1, 1}, {std::log(100.0), std::nullopt});
    EXPECT_GT(far.deviations[0], near.deviations[0]);
}

TEST(Forecast, IsSureOfWhatEstimatesAlwaysHit) {
    Forecast forecast({{4, true}}, 1);
    for (std::size_t position = 0; position < 3; ++position) {
        const Columns area{std::log(2.0 + static_cast<double>(position))};
        forecast.learn({position}, area, area);
    }
    forecast.conclude();
    const Expectation expected = forecast.at({3}, {std::log(7.0)});
    EXPECT_DOUBLE_EQ(*expected.columns[0], std::log(7.0));
    EXPECT_EQ(expected.deviations[0], 0);
}

/// 1.3 million designs on one view.
std::string million_space(const Folder& folder) {
    const std::string file = folder / "large.yaml";
    std::ofstream(file) << "study: large\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\naxes:\n  span.count: 1..16 +1\n"
                           "  array.pes_per_bank: [4, 8, 16]\n  slicing.count: [1, 2, 4]\n"
                           "  packing.bytes: [4KB, 8KB, 16KB, 32KB]\n"
                           "  scheduler.queue_segments_per_pe: 1..8 +1\n"
                           "  scheduler.scan: [oldest, round_robin]\n"
                           "  feature_buffer.bytes: [2KB, 4KB, 8KB, 16KB, 32KB]\n"
                           "  gaussian_buffer.bytes: [8KB, 16KB, 32KB, 64KB]\n"
                           "  sorting.count: [1, 2, 4]\n  projection.count: [1, 2, 4, 8]\n"
                           "scenes: synthetic:object,gaussians=300\nwidth: 96\n"
                           "reference: false\n";
    return file;
}

std::vector<std::string> explore_words(const std::string& file, const std::string& out,
                                       const std::vector<std::string>& more) {
    std::vector<std::string> words{"explore", file, "--out", out, "--jobs", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

nlohmann::json explored(const std::string& file, const std::string& out,
                        const std::vector<std::string>& more) {
    const Outcome outcome = degs(explore_words(file, out, more));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(read_file(out + "/explore.json"));
}

std::vector<Goals> costs_in(const nlohmann::json& found) {
    std::vector<Goals> costs;
    for (const auto& design : found["results"]["designs"]) {
        if (!design.contains("within") || design["within"] == "yes") {
            costs.push_back({});
            for (const auto& goal : found["goals"]) {
                costs.back().push_back(std::log(design[goal.get<std::string>()].get<double>()));
            }
        }
    }
    return costs;
}

TEST(Evolution, FindsTheFrontOfAllDesigns) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    const std::vector<std::string> aims{"--goals", "area_mm2,latency_ms,energy.nj_per_frame",
                                        "--limits", "area_mm2<=3.7,worst(latency_ms)<=2*baseline"};
    std::vector<std::string> few = aims;
    few.insert(few.end(), kHalf.begin(), kHalf.end());
    std::vector<std::string> all = aims;
    all.insert(all.end(), {"--budget", "24"}); // as many as there are
    const nlohmann::json everything = explored(file, folder / "all", all);
    const nlohmann::json found = explored(file, folder / "few", few);
    const Goals worst{std::log(4.0), std::log(0.02), std::log(1e5)};
    EXPECT_GE(hypervolume(costs_in(found), worst), 0.99 * hypervolume(costs_in(everything), worst));
    EXPECT_EQ(everything["search"]["simulated"], 24);
    EXPECT_EQ(everything["search"]["estimated"], 0);
    EXPECT_EQ(everything["search"]["end"], "the budget has room for all designs");
    EXPECT_EQ(found["search"]["estimated"], 24);
    EXPECT_LE(found["search"]["simulated"], 12);
    EXPECT_LE(found["search"]["simulated_cycles"].get<double>(),
              0.6 * everything["search"]["simulated_cycles"].get<double>());
    EXPECT_EQ(found["beliefs"].size(), found["search"]["simulated"]);
    EXPECT_EQ(found["beliefs"][0]["name"], "degs-64");
    // A goal with an estimate is believed from the first round on.
    EXPECT_TRUE(found["beliefs"][0]["believed"]["energy.nj_per_frame"].is_number());
    EXPECT_TRUE(fs::exists(folder / "few/beliefs.csv"));
    EXPECT_NE(read_file(folder / "few/index.html").find("24 designs estimated, "),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "all/beliefs.csv"));
}

/// The keys of two_view_space() of the designs in front.csv, and whether they are on the front.
std::map<std::vector<double>, bool> front_designs(const std::string& folder) {
    std::map<std::vector<double>, bool> designs;
    for (const CsvRow& row : rows_by_heading(read_file(folder + "/front.csv"))) {
        std::vector<double> keys;
        for (const char* key : {"span.count", "array.pes_per_bank", "packing.bytes"}) {
            keys.push_back(std::stod(row.at(key)));
        }
        designs[keys] = row.at("on_front") == "1";
    }
    return designs;
}

// Whoever changes one key of a design on the front by one step finds nothing better.
TEST(Evolution, EndsWhereNoNeighbourBeatsTheFront) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    const auto found = explored(file, folder / "out", {"--budget", "22"});
    EXPECT_EQ(found["search"]["end"], "no neighbour of the front beats it, and no other estimated "
                                      "design is likely to");
    explored(file, folder / "all", {"--budget", "24"});
    const auto simulated = front_designs(folder / "out"), all = front_designs(folder / "all");
    EXPECT_LT(simulated.size(), all.size());
    int front = 0;
    for (const auto& [keys, on_front] : simulated) {
        for (const auto& [other, any] : all) {
            int steps = 0; // values of each key differ by factors of 2
            for (std::size_t k = 0; k < keys.size(); ++k) {
                steps += static_cast<int>(std::abs(std::log2(keys[k] / other[k])));
            }
            EXPECT_TRUE(!on_front || steps != 1 || simulated.count(other) != 0)
                << other[0] << " " << other[1] << " " << other[2];
        }
        front += on_front ? 1 : 0;
    }
    EXPECT_GE(front, 3);
    const auto few = explored(file, folder / "few", {"--budget", "6"});
    EXPECT_NE(few["search"]["end"].get<std::string>().find("of the front were not simulated"),
              std::string::npos)
        << few["search"]["end"];
}

TEST(Evolution, TriesADesignThatFailsOnce) {
    const Folder folder;
    const Outcome outcome =
        degs(explore_words(failing_space(folder), folder / "out", {"--budget", "5"}));
    EXPECT_NE(outcome.code, 0);
    int tries = 0;
    for (std::size_t at = 0; (at = outcome.err.find(" failed ·", at)) != std::string::npos; ++at) {
        ++tries;
    }
    EXPECT_EQ(tries, 3) << outcome.err;
    const auto found = nlohmann::json::parse(read_file(folder / "out/explore.json"));
    EXPECT_EQ(found["results"]["failed"].size(), 3U);
    // One of the others is larger and no faster by its estimate, so that it may be left out.
    EXPECT_GE(found["results"]["designs"].size(), 2U);
    EXPECT_EQ(found["results"]["designs"].back()["name"], "degs-64 span.count=4");
}

/// Kills the program, without children that would go on, when it has made so many points.
void kill_after(std::size_t points, const std::string& out, const std::vector<std::string>& words) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::setpgid(0, 0);
        std::vector<char*> argv{const_cast<char*>(DEGS_PROGRAM)};
        for (const std::string& word : words) {
            argv.push_back(const_cast<char*>(word.c_str()));
        }
        argv.push_back(nullptr);
        ::dup2(::open("/dev/null", O_WRONLY), STDERR_FILENO);
        ::execv(DEGS_PROGRAM, argv.data());
        ::_exit(127);
    }
    const auto made = [&out] {
        std::error_code none;
        std::size_t count = 0;
        for (const fs::directory_entry& file : fs::directory_iterator(out + "/points", none)) {
            count += file.path().extension() == ".point" ? 1 : 0;
        }
        return count;
    };
    int status = 0;
    while (made() < points && ::waitpid(child, &status, WNOHANG) == 0) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    ::kill(-child, SIGKILL);
    ::waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it was over before";
}

TEST(Evolution, GoesOnAfterItWasKilled) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    explored(file, folder / "whole", kHalf);
    kill_after(10, folder / "killed", explore_words(file, folder / "killed", kHalf));
    std::map<std::string, fs::file_time_type> before;
    for (const auto& point : fs::directory_iterator(folder / "killed/points")) {
        if (point.path().extension() == ".point") {
            before[point.path().string()] = point.last_write_time();
        }
    }
    EXPECT_GE(before.size(), 10U);
    explored(file, folder / "killed", kHalf);
    for (const auto& [point, time] : before) {
        EXPECT_EQ(fs::last_write_time(point), time) << "was simulated again: " << point;
    }
    for (const char* name : {"explore.json", "beliefs.csv", "front.csv", "results.csv"}) {
        EXPECT_EQ(read_file(folder / "killed/" + name), read_file(folder / "whole/" + name))
            << name;
    }
}

// A folder shows nothing of runs that are not those of its results.
TEST(LongSearchFiles, GoWithTheResultsThatTheyTellOf) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    const std::string out = folder / "out";
    explored(file, out, kHalf);
    EXPECT_TRUE(fs::exists(out + "/beliefs.csv"));
    explored(file, out, {});
    EXPECT_FALSE(fs::exists(out + "/beliefs.csv"));
    EXPECT_TRUE(fs::exists(out + "/front.svg"));
    const std::string other = folder / "bandwidth.yaml";
    std::ofstream(other) << "study: bandwidth\ndesigns:\n  - include: " << config("degs-64")
                         << "\n    name: degs-64\naxes:\n"
                            "  memory.bandwidth_gb_per_s: 51.2GB/s..204.8GB/s x2\n"
                            "scenes: synthetic:object,gaussians=300\nwidth: 64\n";
    EXPECT_EQ(degs({"sweep", other, "--out", out}).code, 0);
    for (const char* gone : {"explore.json", "front.csv", "front.svg", "reports/000004.json"}) {
        EXPECT_FALSE(fs::exists(out + "/" + gone)) << gone;
    }
    EXPECT_TRUE(fs::exists(out + "/bandwidth.svg"));
    explored(file, out, {"--limits", "area_mm2<=2.7"});
    EXPECT_FALSE(fs::exists(out + "/bandwidth.svg"));
    EXPECT_FALSE(fs::exists(out + "/reports/000049.json")); // 24 designs on two views
}

TEST(LongEvolution, SearchesAMillionDesigns) {
    const Folder folder;
    const std::string file = million_space(folder);
    std::vector<std::string> options = kHalf;
    options.insert(options.end(), {"--population", "16", "--generations", "5"});
    const nlohmann::json found = explored(file, folder / "a", options);
    EXPECT_GT(found["search"]["space"], 1000000);
    EXPECT_LE(found["search"]["estimated"], 81); // with the baseline
    EXPECT_GT(found["search"]["estimated"], 60);
    EXPECT_LE(found["search"]["simulated"], 12);
    explored(file, folder / "b", options);
    EXPECT_EQ(read_file(folder / "a/explore.json"), read_file(folder / "b/explore.json"));
    options.insert(options.end(), {"--seed", "2"});
    EXPECT_NE(explored(file, folder / "c", options)["results"], found["results"]);
    const nlohmann::json estimated = explored(
        file, folder / "d", {"--fidelity", "analytic", "--population", "16", "--generations", "5"});
    EXPECT_EQ(estimated["fidelity"], "analytic");
    EXPECT_EQ(estimated["search"]["simulated"], 0);
    EXPECT_FALSE(estimated.contains("estimates"));
    EXPECT_EQ(estimated["results"]["designs"].size(), estimated["search"]["estimated"]);
    const nlohmann::json drawn =
        explored(file, folder / "e",
                 {"--array-only", "--budget", "8", "--population", "16", "--generations", "2"});
    EXPECT_EQ(drawn["search"]["estimated"], 0);
    EXPECT_EQ(drawn["results"]["designs"].size(), 8U);
}

/// A little worse than all designs.
Goals worst_of(const std::vector<Goals>& costs) {
    Goals worst = costs.front();
    for (const Goals& each : costs) {
        for (std::size_t g = 0; g < worst.size(); ++g) {
            worst[g] = std::max(worst[g], each[g] + 0.01);
        }
    }
    return worst;
}

// What has no estimate is searched by the places of the designs: a search of half of the space, and
// of all of it.
void expect_search_without_estimates(const std::vector<std::string>& aims, const std::string& why) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    std::vector<std::string> half = aims;
    half.insert(half.end(), kHalf.begin(), kHalf.end());
    const nlohmann::json everything = explored(file, folder / "all", aims);
    const nlohmann::json found = explored(file, folder / "few", half);
    EXPECT_EQ(found["search"]["estimated"], 0);
    EXPECT_LE(found["search"]["simulated"], 12);
    EXPECT_EQ(found["search"]["no_estimates"], why);
    EXPECT_FALSE(everything["search"].contains("no_estimates"));
    EXPECT_FALSE(fs::exists(folder / "few/estimates"));
    const std::string goal = found["goals"].back();
    EXPECT_TRUE(found["beliefs"][0]["believed"][goal].is_null());
    EXPECT_TRUE(found["beliefs"].back()["believed"][goal].is_number());
    const std::vector<Goals> all = costs_in(everything);
    EXPECT_EQ(all.size(), 24U);
    EXPECT_GE(hypervolume(costs_in(found), worst_of(all)), 0.9 * hypervolume(all, worst_of(all)));
}

TEST(Evolution, SearchesArraysAlone) {
    expect_search_without_estimates(
        {"--array-only"}, "the arrays run alone, and estimates are of whole accelerators");
}

TEST(Evolution, SearchesGoalsWithoutEstimates) {
    expect_search_without_estimates(
        {"--goals", "min:slots.starved*area_mm2,min:area_mm2/slots.useful"},
        "none of the goals has an estimate");
}

// The designs of a study that varies one key after the other, as a sweep has them.
TEST(Evolution, SearchesAStudyThatVariesOneAtATime) {
    const Folder folder;
    const std::string file = two_view_space(folder);
    std::ofstream(file, std::ios::app) << "combine: one_at_a_time\n";
    const auto names = [](const nlohmann::json& designs) {
        std::set<std::string> all;
        for (const auto& design : designs) {
            all.insert(design["name"].get<std::string>());
        }
        return all;
    };
    const nlohmann::json everything = explored(file, folder / "all", {});
    ASSERT_EQ(degs({"sweep", file, "--out", folder / "sweep"}).code, 0);
    const auto swept = nlohmann::json::parse(read_file(folder / "sweep/results.json"));
    EXPECT_EQ(names(everything["results"]["designs"]), names(swept["variants"]));
    EXPECT_EQ(everything["results"]["designs"].size(), 7U); // 3 + 2 + 1 beside the own values
    const nlohmann::json few = explored(file, folder / "few", {"--budget", "5"});
    EXPECT_EQ(names(few["estimates"]["designs"]), names(swept["variants"]));
    EXPECT_LE(few["results"]["designs"].size(), 5U);
}

// Far designs come first, and no place twice.
TEST(MostUnlike, TakesTheCornersFirst) {
    const std::vector<Gene> genes{{1, false}, {5, true}, {3, false}};
    const std::vector<Genes> places{{0, 0, 0}, {0, 1, 0}, {0, 4, 0}, {0, 4, 1}, {0, 2, 2}};
    using Positions = std::vector<std::size_t>;
    EXPECT_EQ(most_unlike(genes, {{0, 0, 1}}, places, 2), (Positions{2, 4}));
    EXPECT_EQ(most_unlike(genes, {}, places, 9).size(), 5U);
    EXPECT_DOUBLE_EQ(likeness(genes, {0, 2, 1}, {0, 2, 1}), 1);
    EXPECT_GT(likeness(genes, {0, 0, 0}, {0, 1, 0}), likeness(genes, {0, 0, 0}, {0, 4, 0}));
}

TEST(Evolution, RefusesWhatItCannotDo) {
    const Folder folder;
    const auto refuses = [&folder](const std::vector<std::string>& options,
                                   const std::string& sentence) {
        expect_mistake(degs(explore_words(two_view_space(folder), folder / "out", options)),
                       sentence);
        EXPECT_FALSE(fs::exists(folder / "out"));
    };
    refuses({"--budget", "1"}, "--budget");
    refuses({"--fidelity", "analytic", "--budget", "9"}, "--budget counts simulations");
    refuses({"--limits", "area_mm2<=baseline(degs-65)"}, "degs-65");
}

} // namespace
} // namespace degs::sim_test
