// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// From now on SIGINT (Ctrl-C) and SIGTERM print a sentence on stderr before they end the program
/// as they always do. A signal that the program was started to ignore stays ignored.
void announce_interruption();

/// Makes `text` the one that is printed from now on, instead of "Interrupted."; more than some
/// 500 bytes are cut.
void set_interruption_sentence(const std::string& text);

/// From now on the signals end this process without a sentence. For a forked child, whose parent
/// prints it.
void keep_interruption_quiet();

} // namespace degs::sim
