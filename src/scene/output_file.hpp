// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace degs {

/// Calls `write` with the name of a temporary file in the folder of `path`, then renames that
/// file to `path`: readers see the old file or the whole new one, also if the run is killed. If
/// `write` throws, the temporary file is removed. InputError if the folder is missing, cannot be
/// written, or `path` is a folder.
void write_atomically(const std::string& path,
                      const std::function<void(const std::string& temporary)>& write);

} // namespace degs
