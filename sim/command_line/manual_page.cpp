// SPDX-License-Identifier: Apache-2.0
#include "sim/command_line/manual_page.hpp"

namespace degs::sim {
namespace {

/// Date of the last change to the text of this file; the rest of the page follows the program.
constexpr const char* kDate = "2026-11-22";

/// Text in which man sees no commands: hyphens stay hyphens, and no line begins with '.' or '\''.
std::string roff(const std::string& text) {
    std::string out = text.find_first_of(".'") == 0 ? "\\&" : "";
    for (const char c : text) {
        if (c == '\\') {
            out += "\\e";
        } else if (c == '-') {
            out += "\\-";
        } else {
            out += c;
        }
    }
    return out;
}

std::string section(const std::string& name) {
    return ".SH " + name + "\n";
}

std::string item(const std::string& what, const std::string& meaning) {
    return ".TP\n\\fB" + roff(what) + "\\fR\n" + roff(meaning) + "\n";
}

/// "--out FOLDER" with the name in bold and the value in italics.
std::string option_item(const OptionEntry& option) {
    const std::string whole = heading(option);
    std::string names;
    for (const std::string& name : option.names) {
        names += (names.empty() ? "" : ", ") + name;
    }
    const std::string value = whole.substr(names.size());
    return ".TP\n\\fB" + roff(names) + "\\fR" +
           (value.empty() ? "" : " \\fI" + roff(value.substr(1)) + "\\fR") + "\n" +
           roff(explanation(option)) + "\n";
}

/// Commands that have commands are introduced by these. The rules of options follow the options.
void add_command(const CommandEntry& command, std::string& page) {
    for (const CommandEntry& below : command.commands) {
        add_command(below, page);
    }
    if (command.commands.empty()) {
        page += ".SS \"" + roff(usage(command)) + "\"\n" + roff(command.meaning) + ".\n";
        for (const OptionEntry& option : command.options) {
            page += option_item(option);
        }
        for (const OptionRule& rule : command.rules) {
            page += item(heading(rule, command.path), explanation(rule) + ".");
        }
    }
}

constexpr const char* kDescription =
    R"(.B degs
renders scenes of 3D Gaussians on transaction\-level models of accelerators. It reports the cycles
that a frame takes, what every processing element did or waited for,
how busy the memory was, and how far the image is from double precision. An accelerator is
described by a configuration file; files for many designs are installed with the program.
.PP
Images, reports and tables are written into a folder, see
.BR \-\-out ;
a summary goes to standard output.
)";

constexpr const char* kExamples = R"(.TP
Simulate the 64\-PE design of the paper on a generated scene:
.B degs run configs/degs\-64.yaml \-\-scene synthetic:object \-\-camera 2
.TP
Compare two accelerators on two views of a scene, two simulations at a time:
.B degs compare configs/degs\-64.yaml configs/degs\-64\-tuned.yaml \-\-scene scene.ply \-\-camera 0,1 \-\-jobs 2
.TP
Explain every key of a configuration file:
.B degs config configs/degs\-64.yaml
)";

} // namespace

std::string manual_page(const CommandEntry& program) {
    std::string page = ".TH DEGS 1 " + std::string(kDate) +
                       " \"degs " DEGS_VERSION "\" \"User Commands\"\n" + section("NAME") +
                       "degs \\- " + roff(program.meaning) + "\n" + section("SYNOPSIS") +
                       ".B degs\n.I COMMAND\n[\\fIOPTIONS\\fR] [\\fIARGUMENTS\\fR]\n" +
                       section("DESCRIPTION") + kDescription + section("OPTIONS");
    for (const OptionEntry& option : program.options) {
        page += option_item(option);
    }
    page += section("COMMANDS");
    add_command(program, page);
    page += section("EXIT STATUS") + item("0", "Success.") +
            item("1", "The model broke one of its invariants, or memory ran out.") +
            item("2", "The command line, a configuration, a scene or the place for results is at "
                      "fault.") +
            item("130", "SIGINT (Ctrl-C) or SIGTERM.");
    return page + section("EXAMPLES") + kExamples;
}

} // namespace degs::sim
