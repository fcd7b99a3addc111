// SPDX-License-Identifier: Apache-2.0
// What a server reads and writes, a line of JSON each; docs/command-line.md describes it.
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

struct Request {
    std::string id = "null";            ///< as JSON; null if the line names none
    std::vector<std::string> arguments; ///< the words behind "degs"
    std::string folder;                 ///< in which the command runs; empty: that of the server
    bool stop = false;                  ///< ends the request with this id, in place of a command
    std::string mistake;                ///< a sentence: why the line is no request; empty: it is
};

Request read_request(const std::string& line);

/// A line that the command has written to stderr.
std::string said_line(const std::string& id, const std::string& text);
/// The end of a request, with everything that the command has written to stdout.
std::string ended_line(const std::string& id, int code, const std::string& printed);

} // namespace degs::sim
