// SPDX-License-Identifier: Apache-2.0
// degs config --pes and --diff: designs of any size by the rules of docs/families.md.
#include <algorithm>
#include <cstdlib>
#include <map>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "degs/error.hpp"
#include "sim/config/config_difference.hpp"
#include "sim/design/run_config.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::KeyDifference;
using sim::RunConfig;

RunConfig sized(const std::string& kind, int pes) {
    return sim::sized_run_config(kind, pes, {});
}

std::string refusal(const std::string& kind, int pes) {
    try {
        sized(kind, pes);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// The numbers of a design by key.
std::map<std::string, double> numbers_of(const RunConfig& config) {
    std::map<std::string, double> numbers;
    for (const KeyDoc& key : document(config)) {
        if (key.type == "integer" || key.type == "real") {
            numbers[key.path] = std::strtod(key.default_value.c_str(), nullptr);
        }
    }
    return numbers;
}

class Families : public testing::TestWithParam<const char*> {};

TEST_P(Families, AreTheShippedFilesAtTheirSizes) {
    for (const int pes : {16, 64, 256, 1024}) {
        const std::string name = GetParam() + ("-" + std::to_string(pes));
        const RunConfig file = sim::load_run_config(config(name), {});
        for (const KeyDifference& key :
             sim::difference(document(file), document(sized(GetParam(), pes)))) {
            ADD_FAILURE() << name << " " << key.path << ": " << key.first << ", by the rule "
                          << key.second;
        }
    }
}

// Every size from 1 to beyond the largest is a design that its own file reproduces without a
// warning, or one sentence that names sizes which are.
TEST_P(Families, MakeADesignOrNameTheNearest) {
    int designs = 0;
    for (int pes = 0; pes <= 4100; pes += pes < 70 ? 1 : 13) {
        SCOPED_TRACE(pes);
        const std::string sentence = refusal(GetParam(), pes);
        if (sentence.empty()) {
            const RunConfig design = sized(GetParam(), pes);
            EXPECT_EQ(design.accelerator().pes(), pes);
            const auto file = ConfigSource::from_text("file.yaml", resolved_yaml(design));
            EXPECT_EQ(sim::load_run_config(file).warnings, std::vector<std::string>{});
            ++designs;
            continue;
        }
        const std::size_t at = sentence.find("the nearest that will do is ");
        ASSERT_NE(at, std::string::npos) << sentence;
        const int nearest =
            std::atoi(sentence.c_str() + at + std::string("the nearest that will do is ").size());
        EXPECT_EQ(refusal(GetParam(), nearest), "") << sentence;
    }
    EXPECT_GE(designs, 2);
}

INSTANTIATE_TEST_SUITE_P(All, Families, testing::Values("degs", "gscore", "gbu", "gcc"));

TEST(FamilySizes, LieBetweenTheirNeighbours) {
    for (const char* kind : {"degs", "gbu"}) {
        for (const int pes : {32, 128, 512}) {
            const auto low = numbers_of(sized(kind, pes / 2));
            const auto high = numbers_of(sized(kind, pes * 2));
            for (const auto& [key, value] : numbers_of(sized(kind, pes))) {
                SCOPED_TRACE(kind + std::to_string(pes) + " " + key);
                EXPECT_GE(value, std::min(low.at(key), high.at(key)));
                EXPECT_LE(value, std::max(low.at(key), high.at(key)));
            }
        }
    }
}

TEST(FamilySizes, TakeCyclesBetweenThoseOfTheirNeighbours) {
    const Folder folder;
    double before = 1e12;
    for (const int pes : {16, 32, 64, 128, 256, 512, 1024}) {
        const std::string file = folder / (std::to_string(pes) + ".yaml");
        std::ofstream(file) << resolved_yaml(sized("degs", pes));
        const Outcome run = degs({"run", file, "--scene", "synthetic:object,gaussians=4000",
                                  "--width", "640", "--no-reference", "--out", folder / "out"});
        EXPECT_EQ(run.code, 0) << run.err;
        EXPECT_EQ(run.err.find("warning"), std::string::npos) << run.err;
        const double cycles =
            nlohmann::json::parse(read_file(folder / "out/report.json"))["timing"]["cycles"];
        EXPECT_LT(cycles, before) << pes;
        before = cycles;
    }
}

TEST(FamilyCommand, WritesAFile) {
    const Outcome written =
        degs({"config", "degs", "--pes", "128", "--set", "packing.latency_cycles=3"});
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_EQ(written.out.find("# degs-128, written by 'degs config degs --pes 128'."), 0U);
    const auto source = ConfigSource::from_text("file.yaml", written.out);
    EXPECT_EQ(sim::load_run_config(source).accelerator().pes(), 128);
    EXPECT_NE(written.out.find("latency_cycles: 3"), std::string::npos);
}

TEST(FamilyCommand, RefusesFilesAndUnknownSizes) {
    const Outcome file = degs({"config", config("degs-64"), "--pes", "128"});
    EXPECT_EQ(file.code, 2);
    EXPECT_NE(file.err.find("takes the name of an accelerator (degs, gscore, gbu, gcc, orange)"),
              std::string::npos)
        << file.err;
    EXPECT_EQ(refusal("gscore", 128),
              "--pes 128: the number of PEs of gscore must be a square of 4, 8, 16 or 32 px; the "
              "nearest that will do is 64 or 256.");
}

TEST(ConfigDifference, ListsTheKeysThatDiffer) {
    const Outcome found = degs({"config", "--diff", config("degs-64"), config("degs-64-tuned")});
    EXPECT_EQ(found.code, 0) << found.err;
    EXPECT_NE(found.out.find("scheduler.scan"), std::string::npos);
    EXPECT_EQ(found.out.find("span.count"), std::string::npos);
    const Outcome same = degs({"config", "--diff", config("degs-64"), config("degs-64")});
    EXPECT_EQ(same.out, "All keys have the same values.\n");
    const Outcome kinds = degs({"config", "--diff", "degs", "gcc", "--format", "markdown"});
    EXPECT_NE(kinds.out.find("| `view_size` | - | 128 |"), std::string::npos) << kinds.out;
    EXPECT_NE(kinds.out.find("| `span.count` | 8 | - |"), std::string::npos) << kinds.out;
    EXPECT_EQ(degs({"config", "--diff", "degs", "gcc", "--format", "yaml"}).code, 2);
}

} // namespace
} // namespace degs::sim_test
