// SPDX-License-Identifier: Apache-2.0
// Files: missing, empty, broken, hostile, and files that include files.
#include "config/config_source.hpp"
#include "config_fixture.hpp"

namespace degs::config_test {
namespace {

class ConfigFile : public ConfigFolder {
protected:
    static std::string error_of_path(const std::string& path) {
        return sentence_of([&] {
            Keys keys;
            ConfigSource::from_file(path).load(keys);
        });
    }
    std::string error_of(const std::string& yaml) const {
        return error_of_path(write("a.yaml", yaml));
    }
    Keys loaded(const std::string& yaml) const {
        Keys keys;
        ConfigSource::from_file(write("a.yaml", yaml)).load(keys);
        return keys;
    }
    std::string here(int line) const { return at("a.yaml") + ":" + std::to_string(line) + ": "; }
};
using ConfigInclude = ConfigFile;
using HostileConfig = ConfigFile;

TEST_F(ConfigFile, MissingOrNoFileAtAll) {
    EXPECT_EQ(error_of_path(at("none.yaml")), "configuration file '" +
                                                  at("none.yaml").substr(0, 60) +
                                                  "' cannot be read: No such file or directory.");
    write("folder/x.yaml", "");
    EXPECT_EQ(error_of_path(at("folder")),
              "configuration file '" + at("folder") + "' is a directory; a YAML file is expected.");
}

TEST_F(ConfigFile, WithoutKeysIsAnError) {
    const std::string empty = at("a.yaml") + ": the file is empty; a section of keys is expected.";
    EXPECT_EQ(error_of(""), empty);
    EXPECT_EQ(error_of("# only a comment\n"), empty);
    EXPECT_EQ(error_of("---\n"), empty);
    EXPECT_EQ(error_of("- banks\n"),
              at("a.yaml") + ": the file is a list; a section of keys is expected.");
    EXPECT_EQ(error_of("banks"),
              at("a.yaml") + ": the file is a single value; a section of keys is expected.");
}

TEST_F(ConfigFile, InvalidYamlNamesTheLine) {
    EXPECT_EQ(error_of("banks: 4\nmemory: {refresh: true\n"),
              here(3) + "this is not valid YAML: end of map flow not found.");
    EXPECT_EQ(error_of("banks: 4\n\tseed: 3\n"),
              here(2) + "this is not valid YAML: illegal tab when looking for indentation.");
    EXPECT_EQ(error_of("banks: 4\n---\nbanks: 5\n"),
              at("a.yaml") + ": the file holds more than one YAML document; one is allowed.");
}

TEST_F(ConfigFile, DuplicateKeyNamesBothLines) {
    EXPECT_EQ(error_of("banks: 4\nseed: 2\nbanks: 4\n"),
              here(3) + "key 'banks': is given twice, first at " + at("a.yaml") + ":1.");
    EXPECT_EQ(error_of("memory:\n  refresh: true\n  \"refresh\": true\n"),
              here(3) + "key 'memory.refresh': is given twice, first at " + at("a.yaml") + ":2.");
}

TEST_F(ConfigFile, KeysAreWords) {
    const std::string reason = "a key must be a word, not a section, a list or nothing.";
    EXPECT_EQ(error_of("[1, 2]: 3\n"), here(1) + reason);
    EXPECT_EQ(error_of("banks: 1\n? {a: 1}\n: 3\n"), here(2) + reason);
    EXPECT_EQ(error_of("~: 3\n"), here(1) + reason);
    EXPECT_EQ(error_of("\"\": 3\n"), here(1) + "a key must have a name.");
}

TEST_F(ConfigFile, AnchorsAliasesAndTagsAreNotPartOfTheFormat) {
    EXPECT_EQ(error_of("seed: 1\nbanks: &b 4\n"),
              here(2) +
                  "key 'banks': anchor '&b' is not accepted; repeat the value or use include.");
    EXPECT_EQ(error_of("memory: &m\n  self: *m\n"),
              here(1) +
                  "key 'memory': anchor '&m' is not accepted; repeat the value or use include.");
    EXPECT_EQ(error_of("seed: 1\nbanks: !!int 4\n"),
              here(2) + "key 'banks': tag 'tag:yaml.org,2002:int' is not accepted; write the plain "
                        "value.");
}

TEST_F(ConfigFile, WindowsLineEndsAndByteOrderMarkAreRead) {
    EXPECT_EQ(loaded("\xEF\xBB\xBF"
                     "banks: 4\r\nmemory:\r\n  refresh: false\r\n")
                  .banks,
              4);
    EXPECT_EQ(error_of("banks: 4\r\nsed: 3\r\n").rfind(here(2) + "key 'sed' is unknown", 0), 0U);
}

// YAML would take everything up to the next quote, or to the end, for the text.
TEST_F(ConfigFile, QuotesAreClosedOnTheirLine) {
    EXPECT_EQ(error_of("title: \"mine\nbanks: 4\n# the users\"\n"),
              here(1) + "key 'title': the quote \" is not closed on its line.");
    EXPECT_EQ(error_of("banks: 4\ntitle: 'mine\nseed: 3\n"),
              here(2) + "key 'title': the quote ' is not closed on its line.");
    EXPECT_EQ(error_of("memory: {\n  latency_ns: 3, refresh: \"true }\n"),
              here(2) + "key 'memory.refresh': the quote \" is not closed on its line.");
    EXPECT_EQ(loaded("title: 'it''s'\nbanks: 4\n").title, "it's");
    EXPECT_EQ(loaded("\xEF\xBB\xBF\"title\": \"a \\\" b\" # don't\nbanks: 4\n").title, "a \" b");
    EXPECT_EQ(loaded("title: a 'quoted word\nbanks: 4\n").banks, 4);
    EXPECT_EQ(loaded("title: |\n  'two\n  lines\nbanks: 4\n").title, "'two\nlines\n");
}

TEST_F(ConfigFile, JsonIsReadAndItsKeysStandOnce) {
    EXPECT_EQ(loaded("{\"banks\": 4, \"memory\": {\"refresh\": false}}").banks, 4);
    EXPECT_EQ(error_of("{\"banks\": 4,\n \"banks\": 5}"),
              here(2) + "key 'banks': is given twice, first at " + at("a.yaml") + ":1.");
}

TEST_F(ConfigInclude, OwnKeysWinAndPlacesAreKept) {
    write("memory/fast.yaml", "latency_ns: 10\naccess_bytes: 128\n");
    const std::string path =
        write("a.yaml", "banks: 4\nmemory:\n  include: memory/fast.yaml\n  access_bytes: 32\n");
    Keys keys;
    const auto source = ConfigSource::from_file(path);
    source.load(keys);
    EXPECT_EQ(keys.memory.latency_ns, 10.0);
    EXPECT_EQ(keys.memory.access_bytes, 32);
    EXPECT_EQ(source.place("memory.latency_ns"), at("memory/fast.yaml") + ":1");
    EXPECT_EQ(source.place("memory.access_bytes"), path + ":4");
}

TEST_F(ConfigInclude, JoinsSectionsAndFollowsFoldersOfIncludedFiles) {
    write("shared/base.yaml", "include: deeper/memory.yaml\nbanks: 16\nseed: 5\n");
    write("shared/deeper/memory.yaml", "memory: {refresh: false, latency_ns: 7}\nseed: 3\n");
    const Keys keys = loaded("include: shared/base.yaml\nbanks: 2\nmemory:\n  latency_ns: 9\n");
    EXPECT_EQ(keys.banks, 2);
    EXPECT_EQ(keys.seed, 5);
    EXPECT_FALSE(keys.memory.refresh);
    EXPECT_EQ(keys.memory.latency_ns, 9.0);
}

TEST_F(ConfigInclude, TakesAListInWhichTheLaterFileWins) {
    write("one.yaml", "banks: 1\nseed: 1\n");
    write("two.yaml", "banks: 2\n");
    const Keys keys = loaded("include: [one.yaml, two.yaml]\n");
    EXPECT_EQ(keys.banks, 2);
    EXPECT_EQ(keys.seed, 1);
}

TEST_F(ConfigInclude, SectionWithoutKeysDoesNotHideIncludedOnes) {
    write("one.yaml", "memory: {latency_ns: 7}\n");
    EXPECT_EQ(loaded("include: one.yaml\nmemory:\n").memory.latency_ns, 7.0);
}

TEST_F(ConfigInclude, ErrorsInsideNameTheIncludedFile) {
    write("one.yaml", "seed: 1\nbanks: 65\n");
    EXPECT_EQ(error_of("include: one.yaml\n"),
              at("one.yaml") +
                  ":2: key 'banks' is '65', but must be an integer in decimal digits, 1 to 64.");
}

TEST_F(ConfigInclude, MustComeFirstAndNameFiles) {
    write("one.yaml", "seed: 1\n");
    EXPECT_EQ(error_of("banks: 4\ninclude: one.yaml\n"),
              here(2) +
                  "key 'include' must be the first key of its section, because later keys win.");
    const std::string wrong =
        here(2) + "key 'memory.include' must be the path of a YAML file or a list of such paths.";
    EXPECT_EQ(error_of("memory:\n  include: {a: b}\n"), wrong);
    EXPECT_EQ(error_of("memory:\n  include: [[a]]\n"), wrong);
    EXPECT_EQ(error_of("include:\n"),
              here(1) + "key 'include' has no value; the path of a YAML file is expected.");
}

TEST_F(ConfigInclude, MissingFileNamesTheIncludingLine) {
    const std::string message = error_of("include: none.yaml\n");
    EXPECT_EQ(message.rfind(here(1) + "key 'include': configuration file '", 0), 0U) << message;
    EXPECT_NE(message.find("cannot be read: No such file or directory."), std::string::npos);
}

TEST_F(ConfigInclude, CirclesAreFound) {
    write("b.yaml", "seed: 1\nmemory:\n  include: ./sub/../a.yaml\n");
    const std::string message = error_of("include: b.yaml\n");
    EXPECT_EQ(message.rfind(at("b.yaml") + ":3: key 'memory.include': include of '", 0), 0U)
        << message;
    EXPECT_NE(message.find("goes in a circle; a file must not include itself."), std::string::npos);
}

TEST_F(HostileConfig, IncludesThatDoubleAtEveryStepEnd) {
    for (int step = 0; step < 20; ++step) {
        const std::string next = std::to_string(step + 1) + ".yaml";
        write(std::to_string(step) + ".yaml", "include: [" + next + ", " + next + "]\n");
    }
    write("20.yaml", "banks: 4\n");
    EXPECT_NE(error_of_path(at("0.yaml")).find("more than 100 includes in one configuration"),
              std::string::npos);
}

TEST_F(HostileConfig, DeepNestingAndManyKeysEnd) {
    EXPECT_NE(error_of("a: " + std::string(40, '[') + std::string(40, ']'))
                  .find("nested more than 32 levels deep"),
              std::string::npos);
    EXPECT_EQ(error_of(std::string(100000, '[')).rfind(here(1), 0), 0U);
    std::string many;
    for (int i = 0; i < 5000; ++i) {
        many += "k" + std::to_string(i) + ": 1\n";
    }
    EXPECT_EQ(error_of(many), here(4097) + "key 'k4096': more than 4096 keys in one section.");
}

TEST_F(HostileConfig, DevicesAreNoConfigurations) {
    if (!std::filesystem::exists("/dev/zero")) {
        GTEST_SKIP() << "this system has no /dev/zero";
    }
    EXPECT_EQ(error_of_path("/dev/zero"),
              "configuration file '/dev/zero' is not a regular file; a YAML file is expected.");
}

TEST_F(HostileConfig, HugeFilesAreNotRead) {
    const std::string path = write("huge.yaml", std::string((1 << 20) + 1, ' '));
    EXPECT_EQ(error_of_path(path), "configuration file '" + path +
                                       "' is longer than 1048576 bytes, the most that is allowed.");
}

TEST_F(HostileConfig, LongAndUnprintableValuesStayOneShortLine) {
    EXPECT_EQ(error_of("banks: \"a\\nb" + std::string(1000, 'c') + "\"\n"),
              here(1) + "key 'banks' is the quoted text 'a\\nb" + std::string(57, 'c') +
                  "...', but must be an integer in decimal digits, 1 to 64.");
}

/// Any cut and any flipped byte of a file either loads or gives one line that names the file.
TEST_F(HostileConfig, DamagedFilesGiveOneSentence) {
    const std::string good = "include: b.yaml\nbanks: 4\ntitle: \"q\\u00e9\"\norder: morton\n"
                             "memory: {latency_ns: 1.5, refresh: true}\n";
    write("b.yaml", "seed: 3\n");
    int failures = 0;
    const auto check = [&](const std::string& yaml) {
        const std::string message = sentence_of([&] {
            Keys keys;
            ConfigSource::from_text(at("a.yaml"), yaml).load(keys);
        });
        failures += message.empty() ? 0 : 1;
        EXPECT_EQ(message.find('\n'), std::string::npos) << message;
        EXPECT_TRUE(message.empty() || message.rfind(at(""), 0) == 0) << message;
    };
    for (std::size_t i = 0; i < good.size(); ++i) {
        check(good.substr(0, i));
        for (const char byte : {'\0', '\n', '\t', ':', '{', '&', '*', '!', '"', '\xff', '-', '?'}) {
            std::string damaged = good;
            damaged[i] = byte;
            check(damaged);
        }
    }
    EXPECT_GT(failures, 500);
}

} // namespace
} // namespace degs::config_test
