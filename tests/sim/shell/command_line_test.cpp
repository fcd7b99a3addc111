// SPDX-License-Identifier: Apache-2.0
// Help, suggestions, manual page and completion, as a stranger meets them.
#include <algorithm>
#include <cstring>
#include <set>
#include <sstream>

#include "sim/shell/scene_list.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

TEST(HelpCommand, SaysWhatTheOptionSays) {
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{}, {"run"}, {"scene"}, {"scene", "info"}}) {
        std::vector<std::string> option = command;
        option.emplace_back("--help");
        std::vector<std::string> words{"help"};
        words.insert(words.end(), command.begin(), command.end());
        const Outcome outcome = degs(words);
        expect_success(outcome);
        EXPECT_EQ(outcome.out, degs(option).out);
    }
    EXPECT_NE(degs({"help"}).out.find("compare"), std::string::npos);
    EXPECT_NE(degs({"help", "run"}).out.find("--camera-file"), std::string::npos);
    expect_mistake(degs({"help", "rnu"}), "did you mean 'run'?");
    expect_mistake(degs({"help", "run", "x"}), "no command 'x' of 'run'");
}

TEST(HelpCommand, FitsATerminalOf80Columns) {
    for (const char* command :
         {"run", "compare", "render", "scene", "memory", "soc", "config", "accuracy", "help"}) {
        std::istringstream lines(degs({"help", command}).out);
        for (std::string line; std::getline(lines, line);) {
            const auto characters = std::count_if(line.begin(), line.end(), [](char c) {
                return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U;
            });
            // A word that is longer than its column cannot be broken.
            if (characters > 80) {
                EXPECT_EQ(line.find(' ', line.find_first_not_of(' ')), std::string::npos) << line;
            }
        }
    }
}

TEST(HostileCommandLine, MisspeltWordsGetASuggestion) {
    const std::string design = config("degs-64");
    expect_mistake(degs({"rum", design}), "'rum' is not expected here, did you mean 'run'?");
    expect_mistake(degs({"cmopare", design}), "did you mean 'compare'?");
    expect_mistake(degs({"scene", "ifno"}), "did you mean 'info'?");
    expect_mistake(degs({"run", design, "--scen", "x"}), "did you mean '--scene'?");
    expect_mistake(degs({"run", design, "--scene", "x", "--camra=3"}), "did you mean '--camera'?");
    expect_mistake(degs({"compare", design, "--scene", "x", "--job", "3"}),
                   "did you mean '--jobs'?");
    expect_mistake(degs({"scene", "info", "x", "-camera", "3"}), "did you mean '--camera'?");
    for (const Outcome& outcome : {degs({"zebra"}), degs({"run", "--zebra"})}) {
        expect_mistake(outcome, "zebra");
        EXPECT_EQ(outcome.err.find("did you mean"), std::string::npos) << outcome.err;
    }
}

TEST(HostileCommandLine, MisspeltFilesGetASuggestion) {
    const Folder folder;
    write_ply(folder / "garden.ply", {Splat{}});
    write_camera(folder / "views.json", {0, 0, -5});
    std::ofstream(folder / "mine.yaml") << "include: " << config("degs-64") << "\n";
    const std::string scene = folder / "garden.ply";
    expect_mistake(degs({"scene", "info", folder / "gardn.ply"}), "did you mean '" + scene + "'?");
    expect_mistake(degs({"scene", "info", folder / "garden"}), "did you mean '" + scene + "'?");
    expect_mistake(degs({"scene", "info", scene, "--camera-file", folder / "view.json"}),
                   "did you mean '" + (folder / "views.json") + "'?");
    expect_mistake(degs({"config", folder / "mien.yaml"}),
                   "did you mean '" + (folder / "mine.yaml") + "'?");
    expect_mistake(degs({"scene", "info", folder / "absent/garden.ply"}), "garden.ply");
    EXPECT_EQ(degs({"scene", "info", folder / "forest.ply"}).err.find("did you mean"),
              std::string::npos);
}

/// What a shell prints that has read the completion and asks for the last of `words`.
std::vector<std::string> completions(const std::vector<std::string>& words,
                                     const std::string& folder = ".") {
    const Folder work;
    std::ofstream(work / "degs") << degs({"help", "--bash-completion"}).out;
    std::string list;
    for (const std::string& word : words) {
        list += " '" + word + "'";
    }
    std::ofstream(work / "ask.sh")
        << "cd '" << folder << "'; . '" << (work / "degs") << "'; COMP_WORDS=(" << list
        << "); COMP_CWORD=" << words.size() - 1
        << R"(; _degs; printf '%s\n' "${COMPREPLY[@]}" | sort)"
        << "\n";
    EXPECT_EQ(std::system(("bash -n '" + (work / "degs") + "'").c_str()), 0);
    EXPECT_EQ(std::system(("bash '" + (work / "ask.sh") + "' >'" + (work / "out") + "'").c_str()),
              0);
    std::vector<std::string> found;
    std::istringstream lines(read_file(work / "out"));
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty()) {
            found.push_back(line);
        }
    }
    return found;
}

TEST(BashCompletion, KnowsCommandsOptionsAndValues) {
    EXPECT_EQ(completions({"degs", "re"}), (Words{"registers", "render"}));
    EXPECT_EQ(completions({"degs", "co"}), (Words{"compare", "config"}));
    EXPECT_EQ(completions({"degs", "scene", ""}),
              (Words{"cameras", "convert", "generate", "info", "tile"}));
    EXPECT_EQ(completions({"degs", "run", "--came"}),
              (Words{"--camera", "--camera-file", "--cameras"}));
    EXPECT_EQ(completions({"degs", "run", "--fidelity", ""}),
              (Words{"analytic", "exact", "strict"}));
    EXPECT_EQ(completions({"degs", "scene", "info", "x.ply", "--wi"}), Words{"--width"});
    EXPECT_EQ(completions({"degs", "help", "me"}), Words{"memory"});
    EXPECT_EQ(completions({"degs", "run", "--views", "0,1", "--came"}), Words{"--camera-file"});
    EXPECT_EQ(completions({"degs", "run", "--workload", "=", "f", "--came"}), Words{});
    EXPECT_EQ(completions({"degs", "run", "--cameras", "1", "--v"}), Words{});
    EXPECT_EQ(completions({"degs", "run", "--trace", "t", "--fidelity", ""}),
              (Words{"exact", "strict"}));
    EXPECT_EQ(completions({"degs", "run", "--fidelity", "sampled:1%", "--m"}), Words{"--memory"});
    EXPECT_EQ(completions({"degs", "run", "--fidelity", "strict", "--ma"}), Words{"--maps"});
    EXPECT_EQ(completions({"degs", "run", "--frames", "2", "--wit"}), Words{});
    EXPECT_EQ(completions({"degs", "run", "--frames", "1", "--wit"}), Words{"--within"});
    EXPECT_EQ(completions({"degs", "run", "--width", ""}), Words{});
    EXPECT_EQ(completions({"degs", "scene", "convert", "synthetic:ob"}), Words{"synthetic:object"});
    EXPECT_EQ(completions({"degs", "run", "--scene", "synthetic:ob"}), Words{"synthetic:object"});
    EXPECT_EQ(completions({"degs", "run", "--scene", "synthetic", ":", "ob"}), Words{"object"});
}

TEST(BashCompletion, FindsFilesAndFolders) {
    const Folder folder;
    fs::create_directories(folder / "my folder");
    std::ofstream(folder / "my file.yaml") << "";
    EXPECT_EQ(completions({"degs", "run", "my f"}, folder / "."),
              (std::vector<std::string>{"my file.yaml", "my folder"}));
    EXPECT_EQ(completions({"degs", "run", "--out", "my"}, folder / "."),
              std::vector<std::string>{"my folder"});
}

/// The words of `text` that begin with "--", as a help text or a completion names options.
std::set<std::string> options_in(const std::string& text) {
    std::set<std::string> options;
    for (std::size_t at = text.find("--"); at != std::string::npos; at = text.find("--", at + 2)) {
        const std::size_t end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", at);
        const std::string word = text.substr(at, end - at);
        if (word.size() > 2 && (at == 0 || std::strchr(" ({,\n'", text[at - 1]) != nullptr)) {
            options.insert(word);
        }
    }
    return options;
}

/// The function of a command in the completion of zsh.
std::string zsh_function(const std::string& script, const std::string& name) {
    const std::size_t begin = script.find("\n_" + name + "() {\n");
    EXPECT_NE(begin, std::string::npos) << name;
    return script.substr(begin, script.find("\n}\n", begin) - begin);
}

// tests/packaging/zsh_completion.zsh asks a real zsh.
TEST(ZshCompletion, HasTheOptionsAndCommandsOfTheHelp) {
    const Outcome outcome = degs({"help", "--zsh-completion"});
    expect_success(outcome);
    EXPECT_EQ(outcome.out.rfind("#compdef degs\n", 0), 0U);
    for (const Words& command : std::vector<Words>{{"run"},
                                                   {"compare"},
                                                   {"render"},
                                                   {"memory"},
                                                   {"soc"},
                                                   {"accuracy"},
                                                   {"config"},
                                                   {"help"},
                                                   {"scene", "info"},
                                                   {"scene", "generate"},
                                                   {"scene", "convert"},
                                                   {"scene", "tile"}}) {
        Words words{"help"};
        std::string name = "degs";
        for (const std::string& word : command) {
            words.push_back(word);
            name += "_" + word;
        }
        const std::string function = zsh_function(outcome.out, name);
        const std::string help = degs(words).out;
        EXPECT_EQ(options_in(function), options_in(help)) << name;
        EXPECT_GT(options_in(function).size(), 1U) << name;
    }
    const std::string program = zsh_function(outcome.out, "degs");
    for (const char* command :
         {"'run:", "'scene:", "scene) _degs_scene ;;", "help) _degs_help ;;"}) {
        EXPECT_NE(program.find(command), std::string::npos) << command;
    }
}

TEST(ZshCompletion, KnowsValuesFilesAndWhatMayBeRepeated) {
    const std::string script = degs({"help", "--zsh-completion"}).out;
    const std::string run = zsh_function(script, "degs_run");
    EXPECT_NE(run.find("choices_fidelity=(exact strict analytic)\n"), std::string::npos) << run;
    EXPECT_NE(run.find("]:TEXT:($choices_fidelity)'"), std::string::npos) << run;
    EXPECT_NE(run.find("'(--scene)'--scene'["), std::string::npos) << run;
    EXPECT_NE(run.find("]:SCENE:__degs_scenes'"), std::string::npos) << run;
    EXPECT_NE(run.find("'*'--set'["), std::string::npos) << run;
    EXPECT_NE(run.find("'(--out)'--out'["), std::string::npos) << run;
    EXPECT_NE(run.find(":FOLDER:_files -/'"), std::string::npos) << run;
    EXPECT_NE(run.find("':CONFIG:_files'"), std::string::npos) << run;
    EXPECT_NE(zsh_function(script, "degs_compare").find("'*:CONFIG:_files'"), std::string::npos);
    EXPECT_NE(script.find(" synthetic:object "), std::string::npos);
    // Brackets end an explanation unless they are escaped.
    EXPECT_NE(run.find("\\[default exact\\]"), std::string::npos) << run;
}

// Settings belong to the scene in the same word.
TEST(SceneLists, AreCutInFrontOfNames) {
    using sim::split_scenes;
    EXPECT_EQ(split_scenes({"a.spz?axes=rdf,synthetic:object,seed=2,b.ply"}),
              (Words{"a.spz?axes=rdf", "synthetic:object,seed=2", "b.ply"}));
    EXPECT_EQ(split_scenes({"synthetic:object", "gaussians=5"}),
              (Words{"synthetic:object", "gaussians=5"}));
}

/// mandoc belongs to the packages of the tests (scripts/install.sh).
TEST(ManualPage, IsCleanAndComplete) {
    const Folder folder;
    const Outcome page = degs({"help", "--man"});
    expect_success(page);
    std::ofstream(folder / "degs.1") << page.out;
    const std::string lint =
        "mandoc -T lint -W warning '" + (folder / "degs.1") + "' >'" + (folder / "lint") + "' 2>&1";
    EXPECT_EQ(std::system(lint.c_str()), 0) << read_file(folder / "lint");
    const std::string draw = "mandoc -T utf8 '" + (folder / "degs.1") + "' | sed 's/.\x08//g' >'" +
                             (folder / "text") + "'";
    EXPECT_EQ(std::system(draw.c_str()), 0);
    const std::string text = read_file(folder / "text");
    for (const char* words : {"--camera, --cameras POSITION", "degs scene generate", "--refresh",
                              "exact|strict", "EXIT STATUS", "1 to 256"}) {
        EXPECT_NE(text.find(words), std::string::npos) << words << text;
    }
}

} // namespace
} // namespace degs::sim_test
