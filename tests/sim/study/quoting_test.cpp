// SPDX-License-Identifier: Apache-2.0
// Names of studies, designs, scenes and folders in every layer that they pass.
#include <algorithm>
#include <cstdlib>

#include <gmock/gmock.h>

#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "sim/plot/svg.hpp"
#include "sim/results/result_words.hpp"
#include "sim/results/run_summary.hpp"
#include "sim/sweep/slurm.hpp"
#include "sim/text/shell_word.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using testing::HasSubstr;

const char* const kWild = "a%j,\"b\" <c>&d'e $f\x1b[31m";
/// In tables, which terminals show.
const char* const kVisible = "a%j,\"b\" <c>&d'e $f\\x1b[31m";

/// A study with such names in a folder with such a name.
std::string wild_study(const Folder& folder) {
    const fs::path home = fs::path(folder / "in") / kWild;
    fs::create_directories(home);
    write_ply((home / "s<&>,'%.ply").string(), {Splat()});
    write_camera((home / "cameras.json").string(), {0, 0, -3});
    const std::string name = nlohmann::json(kWild).dump(); // a YAML scalar, too
    std::ofstream(home / "w%.yaml")
        << "study: " << name << "\ndesigns:\n  - include: " << config("degs-16")
        << "\n    name: " << name << "\naxes:\n  clock_ghz: [0.5, 1]\n"
        << "scenes: \"s<&>,'%.ply\"\nwidth: 48\n";
    return (home / "w%.yaml").string();
}

/// Fields of one record of RFC 4180; `at` moves behind it.
std::vector<std::string> record(const std::string& csv, std::size_t& at) {
    std::vector<std::string> cells(1);
    for (bool quoted = false; at < csv.size(); ++at) {
        const char c = csv[at];
        if (c == '"' && quoted && at + 1 < csv.size() && csv[at + 1] == '"') {
            cells.back() += csv[++at];
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            cells.emplace_back();
        } else if (c == '\n' && !quoted) {
            ++at;
            break;
        } else {
            cells.back() += c;
        }
    }
    return cells;
}

TEST(HostileQuoting, InTheFilesOfASweep) {
    const Folder folder;
    const std::string file = wild_study(folder);
    const std::string out = folder / ("out" + std::string(kWild));
    const Outcome outcome = degs({"sweep", file, "--out", out});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ((outcome.out + outcome.err).find('\x1b'), std::string::npos);
    const std::string csv = read_file(out + "/results.csv");
    std::size_t at = 0;
    const std::size_t columns = record(csv, at).size();
    for (int row = 0; row < 2; ++row) {
        const std::vector<std::string> cells = record(csv, at);
        EXPECT_EQ(cells.size(), columns);
        EXPECT_EQ(cells[1], kVisible);
    }
    EXPECT_EQ(at, csv.size());
    const auto written = nlohmann::json::parse(read_file(out + "/results.json"));
    EXPECT_EQ(written["study"], kWild);
    EXPECT_EQ(written["variants"][0]["design"], kWild);
    const std::string page = read_file(out + "/index.html");
    EXPECT_THAT(page, HasSubstr("&lt;c&gt;&amp;d"));
    EXPECT_EQ(page.find("<c>"), std::string::npos);
}

TEST(HostileQuoting, InTheFilesOfASearchAndAComparison) {
    const Folder folder;
    const std::string file = wild_study(folder);
    const std::string out = folder / "o";
    const Outcome searched = degs({"explore", file, "--out", out});
    EXPECT_EQ(searched.code, 0) << searched.err;
    EXPECT_EQ((searched.out + searched.err).find('\x1b'), std::string::npos);
    const std::string csv = read_file(out + "/front.csv");
    std::size_t at = 0;
    const std::size_t columns = record(csv, at).size();
    const std::vector<std::string> cells = record(csv, at);
    EXPECT_EQ(cells.size(), columns);
    EXPECT_EQ(cells[0], kVisible);
    const fs::path scene = fs::path(file).parent_path() / "s<&>,'%.ply";
    const Outcome compared =
        degs({"compare", std::string(kWild) + "=" + config("degs-16"), config("degs-64"), "--scene",
              scene.string(), "--width", "48", "--out", folder / "c"});
    EXPECT_EQ(compared.code, 0) << compared.err;
    EXPECT_EQ((compared.out + compared.err).find('\x1b'), std::string::npos);
    for (const std::string& svg : {out + "/front.svg", folder / "c/slots.svg"}) {
        const std::string text = read_file(svg);
        EXPECT_EQ(text.find("<c>"), std::string::npos) << svg;
        EXPECT_EQ(text.find('\x1b'), std::string::npos) << svg;
        EXPECT_THAT(text, HasSubstr("&lt;c&gt;&amp;d")) << svg;
    }
    at = 0;
    const std::string rows = read_file(folder / "c/compare.csv");
    const std::size_t width = record(rows, at).size();
    EXPECT_EQ(record(rows, at).size(), width);
}

TEST(HostileQuoting, InPatternsOfSlurm) {
    using sim::slurm_name;
    EXPECT_EQ(slurm_name("out/r20%Aug"), "out/r20%%Aug");
    EXPECT_EQ(slurm_name("%%j"), "%%%%j");
    for (const char* name : {"a\\b", "a\nb", "a\x1b", "a\x7f"}) {
        EXPECT_THROW(slurm_name(name), InputError) << name;
    }
    sim::SlurmArray array;
    array.name = "degs-x";
    array.command = "degs sweep 20%.yaml '--out=a b%j'";
    array.logs = "a b%j/slurm";
    array.tasks = {1};
    const std::string script = sim::slurm_script(array);
    EXPECT_THAT(script, HasSubstr("\n#SBATCH --output='a b%%j/slurm/%a.log'\n"));
    EXPECT_THAT(script, HasSubstr("exec degs sweep 20%.yaml '--out=a b%j' --shard"));
}

TEST(HostileQuoting, AJobArrayInAFolderWithPercent) {
    const Folder folder;
    fs::create_directory(folder / "bin");
    std::ofstream(folder / "bin/sbatch") << "#!/bin/sh\necho 1\n";
    fs::permissions(folder / "bin/sbatch", fs::perms::owner_all);
    const auto prepare = [&folder] {
        ::setenv("PATH", ((folder / "bin") + ":/usr/bin:/bin").c_str(), 1);
    };
    const std::string file = wild_study(folder);
    const std::string out = folder / "r20%Aug";
    const Outcome submitted =
        degs({"sweep", file, "--out", out, "--slurm", "--camera", "0", "--quick=false"}, prepare);
    EXPECT_EQ(submitted.code, 0) << submitted.err;
    const std::string script = read_file(out + "/slurm.sh");
    EXPECT_THAT(script, HasSubstr("/r20%%Aug/slurm/%a.log\n"));
    // What a shell makes of the script's last line are the words that were given.
    const std::string said = folder / "said";
    const std::string line = script.substr(script.rfind("exec ") + 5);
    const std::string words = line.substr(line.find(" sweep "));
    ASSERT_EQ(std::system(("bash -c " + sim::shell_word("printf '%s\\n' " + words) + " > " +
                           sim::shell_word(said))
                              .c_str()),
              0);
    EXPECT_THAT(read_file(said),
                HasSubstr("sweep\n" + file + "\n--camera\n0\n--out=" + out + "\n"));
    const Outcome collected = degs({"sweep", file, "--out", out, "--collect"});
    EXPECT_EQ(collected.code, 2);
    EXPECT_THAT(collected.err, HasSubstr("2 points are missing; no task of the job array has "
                                         "written a 'slurm/K.log'"));
    expect_mistake(degs({"sweep", file, "--out", folder / "a\\b", "--slurm"}, prepare),
                   "has a backslash or a control character");
    EXPECT_FALSE(fs::exists(folder / "a\\b"));
}

TEST(HostileQuoting, InMessagesBetweenProcesses) {
    sim::RunSummary summary;
    summary.view.scene = "a\nb 3\n";
    summary.warnings = {"line\nline", "", "12\n", "\n"};
    const sim::RunSummary back = sim::summary_from(sim::message_of(summary));
    EXPECT_EQ(back.view.scene, summary.view.scene);
    EXPECT_EQ(back.warnings, summary.warnings);
}

TEST(HostileQuoting, InCsvAndSvg) {
    std::size_t at = 0;
    const std::string text = "a,\"b\"\r\nc";
    EXPECT_EQ(record(sim::csv_cell(text) + ",x\n", at), (std::vector<std::string>{text, "x"}));
    for (const char* formula : {"=HYPERLINK(0)", "+1+1", "-a", "@SUM(1)"}) {
        EXPECT_EQ(sim::csv_cell(formula), std::string("'") + formula);
    }
    for (const char* plain : {"-1", "+2.5", "-1e9", "-inf", "a=b", ""}) {
        EXPECT_EQ(sim::csv_cell(plain), plain);
    }
    EXPECT_EQ(sim::csv_cell("\x1b[2J\rx"), "\\x1b[2J\\rx");
    sim::Svg svg;
    svg.text(0, 0, "<&>\"\x1b\xff\xef\xbf\xbf", {});
    const std::string document = svg.document(1, 1, "]]><b>");
    EXPECT_THAT(document, HasSubstr("&lt;&amp;&gt;&quot; \xef\xbf\xbd\xef\xbf\xbd</text>"));
    EXPECT_THAT(document, HasSubstr("]]&gt;&lt;b&gt;"));
}

} // namespace
} // namespace degs::sim_test
