// SPDX-License-Identifier: Apache-2.0
// The bytes of a glTF file, checked for what the library that parses them does not check.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace degs {

/// A buffer as the JSON declares it.
struct GltfBuffer {
    std::string uri; ///< as written; empty: the BIN chunk
    std::uint64_t bytes = 0;
};

struct GltfSource {
    std::string path;
    std::vector<char> bytes;     ///< the JSON text, or a GLB of a JSON and at most one BIN chunk
    bool binary = false;         ///< a GLB
    std::uint64_t bin_bytes = 0; ///< of the BIN chunk; 0: there is none
    std::vector<GltfBuffer> buffers;
    std::vector<std::string>
        external; ///< canonical names of the buffers' files, empty where it has none
    std::vector<std::string> notes;
};

/// Reads a .gltf or .glb, told apart by the magic number. Checks the size of the file (below 4
/// GiB), the chunk table of a GLB, the JSON (see scan_gltf_json), and that buffers lie in files of
/// the scene's folder and are not larger than these. InputError for anything else.
GltfSource read_gltf_source(const std::string& path);

/// What the JSON text of a glTF declares as buffers. The text must be JSON of at most 64 levels and
/// 262,144 values, with integers of at most 32 bits outside `extras`; InputError names the byte
/// where it is not.
std::vector<GltfBuffer> scan_gltf_json(const std::string& path, const char* begin, const char* end);

/// Files in which buffers of `path` lie, in order. InputError as read_gltf_source().
std::vector<std::string> gltf_external_files(const std::string& path);

/// Does it start like a data: URI?
bool is_data_uri(const std::string& uri);

} // namespace degs
