// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs::sim {

/// From now on SIGINT (Ctrl-C) and SIGTERM print a sentence on stderr before they end the program
/// as they always do. A signal that the program was started to ignore stays ignored.
void announce_interruption();

/// That sentence from now on, instead of "Interrupted."; more than some 500 bytes are cut.
void set_interruption_sentence(const std::string& sentence);

/// The signals end this process in silence; for a forked child, whose parent speaks.
void keep_interruption_quiet();

} // namespace degs::sim
