// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tiny_gltf.h>

#include "scene/gltf/gltf_source.hpp"

namespace degs {

/// A glTF that the library has parsed. Nothing in it is checked but the sizes of its buffers: every
/// index and range is looked at where it is used.
struct GltfFile {
    std::string path;
    tinygltf::Model model;
    std::vector<std::string> notes;

    [[noreturn]] void fail(const std::string& sentence) const;
    /// Adds a note unless the same has been said.
    void note(const std::string& sentence);
};

/// Parses the bytes, with no access to files except the buffers of `source`, and decodes no image.
/// InputError for whatever the library complains about, a major version other than 2, and required
/// extensions that this reader does not know. The bytes of `source` are released.
GltfFile parse_gltf(GltfSource source);

/// "'name'" of an object of the file for a message, or "" if it has none; printable, at most 60
/// characters.
std::string quoted_name(const std::string& name);

/// The member `key` of an object value; nullptr if there is none or `value` is no object.
const tinygltf::Value* member_of(const tinygltf::Value& value, const std::string& key);

} // namespace degs
