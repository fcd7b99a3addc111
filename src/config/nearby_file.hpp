// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace degs {

/// For the end of a message about a file that is not there: " (did you mean 'scenes/garden.ply'?)"
/// if its folder holds a file of a similar name or of the same name with an extension, else empty.
std::string nearby_file(const std::string& path);

} // namespace degs
