// SPDX-License-Identifier: Apache-2.0
// Number sets as a text or a file says them.
#include "modules/kit/config/number_choice.hpp"

#include <filesystem>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "modules/kit/config/pipeline_config.hpp"
#include "tests/config/config_fixture.hpp"

namespace degs {
namespace {

using config_test::ConfigFolder;
using config_test::sentence_of;
using Parts = std::vector<std::string>;

std::string read(const std::string& text) {
    return read_numbers(text, {"here", ""}).text();
}

std::string refusal(const std::string& text) {
    return sentence_of([&] { read(text); });
}

TEST(NumberChoices, AreNamesWithParts) {
    for (const char* name : arithmetic_names()) {
        EXPECT_EQ(read(name), name);
        EXPECT_TRUE(read_numbers(name, {"here", ""}).parts.empty());
    }
    // Parts come in the order of NumberSet::describe, each once, and in its words.
    EXPECT_EQ(read("tuned:exp.entries=32:alpha=e8m23:guard=0.50:alpha=ue8m23b127:q_mask=true"),
              "tuned:alpha=ue8m23:q_mask=true:guard=0.5:exp.entries=32");
    EXPECT_EQ(read("paper:exp.entries=16"), "paper:exp.entries=16"); // named, though the same
    EXPECT_EQ(read("fp16:records=tuned:sh_dc=bf16"),
              "fp16:gaussian_mean=e5m22:gaussian_scale=ue5m11b14:gaussian_rotation=q1.15:"
              "gaussian_opacity=uq0.16:sh_dc=bf16:sh_rest=e4m11b9");
    const NumberSet set = read_numbers("tuned:span_base=start:exp.entries=32", {"", ""}).set();
    EXPECT_EQ(set.base, Base::Start);
    EXPECT_EQ(set.exp.entries, 32);
    EXPECT_EQ(set.q, number_set("tuned").q);
}

TEST(NumberChoices, GiveTheSameAgain) {
    for (const char* text : {"fp64", "tuned:alpha=uq1.15", "paper:guard=1e-05:vertical=ratio",
                             "fp32:exp.interpolation=linear:exp.entries=4"}) {
        EXPECT_EQ(read(read(text)), read(text));
        EXPECT_EQ(resolved(read_numbers(read(text), {"", ""}).set()),
                  resolved(read_numbers(text, {"", ""}).set()));
    }
}

TEST(NumberChoices, MistakesAreNamed) {
    const std::string allowed = "fp32, fp64, ideal, fp16, paper, tuned, or a number file, whose "
                                "path has a dot or a slash";
    EXPECT_EQ(refusal("tuend"),
              "here is 'tuend', but must be " + allowed + " (did you mean 'tuned'?).");
    EXPECT_EQ(refusal(""), "here is '', but must be " + allowed + ".");
    EXPECT_EQ(refusal(":alpha=fp16"), "here is '', but must be " + allowed + ".");
    EXPECT_EQ(refusal("tuned:"), "here: '': this is not an override; path.to.key=value is "
                                 "expected.");
    EXPECT_EQ(refusal("tuned:alpha=q99")
                  .rfind("here: alpha=q99: key 'alpha' is 'q99', but must "
                         "be fp64, fp32, fp16, bf16, [u]eEmM[bB] ",
                         0),
              0U);
    EXPECT_EQ(refusal("tuned:exp.entries=5000"),
              "here: exp.entries=5000: key 'exp.entries' is '5000', but must be an integer in "
              "decimal digits, 0 to 4096.");
    EXPECT_EQ(refusal("tuned:aplha=fp16")
                  .rfind("here: aplha=fp16: key 'aplha' is unknown, did you "
                         "mean 'alpha'? (allowed at the top: projection, ",
                         0),
              0U);
    EXPECT_EQ(refusal("tuned:base=vertex"),
              "here: base=vertex: key 'base' is unknown; the pixel of n = 0 is span_base.");
    EXPECT_EQ(refusal("tuned:records=small"), "here: records=small: there are no records 'small'; "
                                              "there are fp32, fp16, tuned.");
    EXPECT_EQ(refusal("tuned:exponent=natural")
                  .rfind("here: exponent=natural: key 'q' is 'uq3.13' "
                         "by default, but must reach beyond 11.08",
                         0),
              0U);
}

class NumberFiles : public ConfigFolder {
protected:
    static PipelineConfig loaded(const ConfigSource& source) {
        PipelineConfig config;
        source.load(config);
        return config;
    }
    /// What a configuration beside the number files makes of a value.
    std::string of(const std::string& value, const Parts& overrides = {}) const {
        write("design.yaml", "numbers: \"" + value + "\"\n");
        return loaded(ConfigSource::from_file(at("design.yaml"), overrides)).numbers.text();
    }
    std::string refused(const std::string& value) const {
        return sentence_of([&] { of(value); });
    }
};
using HostileNumberFiles = NumberFiles;

TEST_F(NumberFiles, SayABaseAndWhatDiffers) {
    write("mine.yaml", "base: tuned\nalpha: uq1.15\nexp:\n  entries: 32\nsqrt:\n");
    EXPECT_EQ(of("mine.yaml"), "tuned:alpha=uq1.15:exp.entries=32");
    EXPECT_EQ(of("mine.yaml:alpha=uq0.12:guard=1"), "tuned:alpha=uq0.12:guard=1:exp.entries=32");
    EXPECT_EQ(of(at("mine.yaml")), "tuned:alpha=uq1.15:exp.entries=32"); // an absolute path
}

TEST_F(NumberFiles, LieBesideWhatNamesThem) {
    write("numbers/first.yaml", "base: paper:q_mask=true\nalpha: uq1.15\n");
    write("numbers/second.yaml", "base: first.yaml\nalpha: uq0.15\n");
    EXPECT_EQ(of("numbers/second.yaml"), "paper:alpha=uq0.15:q_mask=true");
    // An included file has a folder of its own, and a file in memory that of its name.
    write("designs/inner.yaml", "numbers: ../numbers/first.yaml\n");
    write("outer.yaml", "include: designs/inner.yaml\n");
    EXPECT_EQ(loaded(ConfigSource::from_file(at("outer.yaml"))).numbers.text(),
              "paper:alpha=uq1.15:q_mask=true");
    EXPECT_EQ(loaded(ConfigSource::from_text(at("x.yaml"), "numbers: numbers/first.yaml\n"))
                  .numbers.text(),
              "paper:alpha=uq1.15:q_mask=true");
    // An override lies where the program was started.
    EXPECT_NE(sentence_of([&] {
                  of("tuned", {"numbers=numbers/first.yaml"});
              }).find("key 'numbers': configuration file 'numbers/first.yaml' cannot be read"),
              std::string::npos);
    EXPECT_EQ(of("tuned", {"numbers=" + at("numbers/first.yaml")}),
              "paper:alpha=uq1.15:q_mask=true");
}

// What a run computes in is in its description, without the file.
TEST_F(NumberFiles, AreInTheConfigurationByTheirContent) {
    write("mine.yaml", "base: tuned\nalpha: uq1.15\n");
    write("design.yaml", "numbers: mine.yaml\n");
    const PipelineConfig config = loaded(ConfigSource::from_file(at("design.yaml")));
    std::filesystem::remove(at("mine.yaml"));
    EXPECT_EQ(resolved(config).at("numbers"), "tuned:alpha=uq1.15");
    EXPECT_EQ(config.data_path().set->alpha, parse_format("uq1.15"));
    EXPECT_EQ(resolved(loaded(ConfigSource::from_text("copy.yaml", resolved_yaml(config)))),
              resolved(config));
}

TEST_F(NumberFiles, MayIncludeOthers) {
    write("parts.yaml", "alpha: uq1.15\nexp:\n  entries: 8\n");
    write("mine.yaml", "include: parts.yaml\nbase: tuned\nexp:\n  entries: 32\n");
    EXPECT_EQ(of("mine.yaml"), "tuned:alpha=uq1.15:exp.entries=32");
}

TEST_F(HostileNumberFiles, AreRefusedWithTheirPlace) {
    const std::string place = at("design.yaml") + ":1: key 'numbers'";
    write("folder/x.yaml", "");
    EXPECT_EQ(refused("./folder").rfind(place + ": configuration file '", 0), 0U);
    EXPECT_NE(refused("./folder").find(" is a directory; a YAML file is expected."),
              std::string::npos);
    write("mine.yaml", "base: tuned\n");
    EXPECT_NE(refused("mine.yml").find("cannot be read: No such file or directory (did you mean '"),
              std::string::npos)
        << refused("mine.yml");
    const std::string file = at("mine.yaml");
    write("mine.yaml", "alpha: uq1.15\n");
    EXPECT_EQ(refused("mine.yaml"),
              file + ": key 'base' is missing; a number file names the set from which it differs: "
                     "fp32, fp64, ideal, fp16, paper, tuned, or a number file, whose path has a "
                     "dot or a slash.");
    write("mine.yaml", "base: tuend\n");
    EXPECT_EQ(refused("mine.yaml").rfind(file + ":1: key 'base' is 'tuend', but must be ", 0), 0U);
    write("mine.yaml", "base: [tuned]\n");
    EXPECT_EQ(refused("mine.yaml").rfind(file + ":1: key 'base' is a list, but must be ", 0), 0U);
    write("mine.yaml", "base: tuned\nalpha: q99\n");
    EXPECT_EQ(refused("mine.yaml").rfind(file + ":2: key 'alpha' is 'q99', but must be ", 0), 0U);
    write("mine.yaml", "base: tuned\naplha: fp16\n");
    EXPECT_EQ(
        refused("mine.yaml").rfind(file + ":2: key 'aplha' is unknown, did you mean 'alpha'?", 0),
        0U);
    write("mine.yaml", "base: tuned\nexp.entries: 32\n");
    EXPECT_NE(refused("mine.yaml").find("'entries' has to stand in the section 'exp'."),
              std::string::npos);
    write("mine.yaml", "base: tuned\nratio: uq0.18\n");
    EXPECT_EQ(refused("mine.yaml").rfind(file + ":2: key 'ratio' is 'uq0.18', but must reach ", 0),
              0U);
    write("mine.yaml", "- base\n");
    EXPECT_EQ(refused("mine.yaml"), file + ": the file is a list; a section of keys is expected.");
}

TEST_F(HostileNumberFiles, DoNotGoInACircle) {
    write("a.yaml", "base: b.yaml\n");
    write("b.yaml", "base: ./a.yaml:alpha=fp16\n");
    EXPECT_EQ(refused("a.yaml").rfind(at("b.yaml") + ":1: key 'base' goes in a circle at '", 0),
              0U);
    write("a.yaml", "base: a.yaml\n");
    EXPECT_EQ(refused("a.yaml").rfind(at("a.yaml") + ":1: key 'base' goes in a circle at '", 0),
              0U);
    constexpr int kMost = 100;
    for (int i = 0; i <= kMost; ++i) {
        write(std::to_string(i) + ".yaml", "base: " + std::to_string(i + 1) + ".yaml\n");
    }
    write(std::to_string(kMost) + ".yaml", "base: tuned\n");
    EXPECT_EQ(of("1.yaml"), "tuned");
    EXPECT_EQ(
        refused("0.yaml").rfind(at("99.yaml") + ":1: key 'base' is the base of more than ", 0), 0U);
}

TEST(NumberKeys, OfFormatsAreRefusedWithWhatIsSaidNow) {
    const auto sentence = [](const std::string& yaml, const Parts& overrides) {
        return sentence_of([&] {
            PipelineConfig config;
            ConfigSource::from_text("a.yaml", yaml, overrides).load(config);
        });
    };
    const std::string advice = " is unknown; parts of a number set stand behind its name, as in "
                               "pipeline.numbers: tuned:alpha=uq1.15, or in a number file that "
                               "pipeline.numbers names.";
    EXPECT_EQ(sentence("numbers: tuned\nformats:\n  alpha: uq1.15\n", {}),
              "a.yaml:2: key 'formats'" + advice);
    EXPECT_EQ(sentence("numbers: tuned\n", {"formats.exp.entries=32"}),
              "--set formats.exp.entries=32: key 'formats.exp.entries'" + advice);
}

} // namespace
} // namespace degs
