// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// From now on signals that end the program remove its half-written files before they do so, and
/// SIGINT (Ctrl-C) and SIGTERM print a sentence on stderr; shells see 128 and the signal's number.
/// A signal that the program was started to ignore stays ignored. Files that exceed a limit
/// (SIGXFSZ) fail to be written instead.
void announce_interruption();

/// Makes `text` the one that is printed from now on, instead of "Interrupted."; more than some
/// 500 bytes are cut.
void set_interruption_sentence(const std::string& text);

/// From now on the signals end this process without a sentence. For a forked child, whose parent
/// prints it.
void keep_interruption_quiet();

} // namespace degs::sim
