// SPDX-License-Identifier: Apache-2.0
// Files that a scene file names, which lie in its folder.
#pragma once

#include <string>

namespace degs {

/// The canonical name of the file that `scene` calls `name`, in its folder or below it; links are
/// followed first. InputError "<scene>: <which>; ..." if the name holds control characters, leads
/// out of the folder or is no regular file. `which` is a clause that names the file as the scene
/// does.
std::string file_in_scene_folder(const std::string& scene, const std::string& name,
                                 const std::string& which);

/// Whether a byte of `name` is a control character of ASCII, as no name of a file needs. Behind a
/// zero the system would not see the rest.
bool has_control_characters(const std::string& name);

} // namespace degs
