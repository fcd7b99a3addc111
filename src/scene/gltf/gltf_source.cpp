// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_source.hpp"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/visible_text.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/scene_folder.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;  // "BIN" and a zero
constexpr std::size_t kGlbHeader = 12, kChunkHeader = 8;

std::uint32_t little_endian(const std::vector<char>& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i) {
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
}

void put_little_endian(std::vector<char>& bytes, std::size_t at, std::uint64_t value) {
    for (int i = 0; i < 4; ++i) {
        bytes[at + i] = static_cast<char>(value >> (8 * i) & 0xFFU);
    }
}

struct GlbChunk {
    std::uint32_t type;
    std::size_t begin, bytes; ///< of the content
    std::size_t end() const { return begin + bytes; }
};

std::vector<GlbChunk> chunk_table(const GltfSource& source, std::size_t end) {
    constexpr std::size_t kMostChunks = 64;
    std::vector<GlbChunk> chunks;
    for (std::size_t at = kGlbHeader; at < end;) {
        const std::string which = "chunk " + std::to_string(chunks.size()) + " of the GLB";
        if (end - at < kChunkHeader) {
            fail_file(source.path, which + " is cut off: its header needs 8 bytes, and " +
                                       std::to_string(end - at) + " are left.");
        }
        const GlbChunk chunk{little_endian(source.bytes, at + 4), at + kChunkHeader,
                             little_endian(source.bytes, at)};
        if (chunk.bytes > end - chunk.begin) {
            fail_file(source.path, which + " says that it has " + std::to_string(chunk.bytes) +
                                       " bytes, and " + std::to_string(end - chunk.begin) +
                                       " are left.");
        }
        if (chunk.bytes % 4 != 0) {
            fail_file(source.path, which + " has " + std::to_string(chunk.bytes) +
                                       " bytes; a multiple of 4 is needed.");
        }
        if (chunks.size() == kMostChunks) {
            fail_file(source.path, "the GLB has more than " + std::to_string(kMostChunks) +
                                       " chunks; a JSON and a BIN chunk are read.");
        }
        chunks.push_back(chunk);
        at = chunk.end();
    }
    return chunks;
}

/// Length of the GLB as its header says it.
std::size_t glb_length(GltfSource& source) {
    const std::size_t size = source.bytes.size();
    if (size < kGlbHeader + kChunkHeader) {
        fail_file(source.path,
                  "the GLB has " + std::to_string(size) + " bytes; 20 are needed for its headers.");
    }
    const std::uint32_t version = little_endian(source.bytes, 4);
    if (version != 2) {
        fail_file(source.path,
                  "this is a GLB of version " + std::to_string(version) + "; version 2 is read.");
    }
    const std::size_t length = little_endian(source.bytes, 8);
    if (length > size || length < kGlbHeader + kChunkHeader) {
        fail_file(source.path, "the header of the GLB says that the file has " +
                                   std::to_string(length) + " bytes, and it has " +
                                   std::to_string(size) + ".");
    }
    if (length < size) {
        source.notes.push_back(std::to_string(size - length) +
                               " bytes after the end of the GLB are ignored.");
    }
    return length;
}

/// Returns the JSON chunk. Chunks of other applications are cut off: the library refuses them, and
/// the specification wants them ignored.
GlbChunk check_glb(GltfSource& source) {
    const std::vector<GlbChunk> chunks = chunk_table(source, glb_length(source));
    if (chunks.empty() || chunks[0].type != kJsonChunk || chunks[0].bytes == 0) {
        fail_file(source.path, "the first chunk of the GLB is not JSON.");
    }
    const bool has_bin = chunks.size() > 1 && chunks[1].type == kBinChunk && chunks[1].bytes > 0;
    const std::size_t kept = has_bin ? 2 : 1;
    if (kept < chunks.size()) {
        source.notes.push_back(
            std::to_string(chunks.size() - kept) +
            " chunk(s) of the GLB that are neither JSON nor its data are ignored.");
    }
    source.bin_bytes = has_bin ? chunks[1].bytes : 0;
    source.bytes.resize(chunks[kept - 1].end());
    put_little_endian(source.bytes, 8, source.bytes.size());
    return chunks[0];
}

int hexadecimal(char c) {
    const std::string digits = "0123456789abcdef";
    const std::size_t at =
        digits.find(static_cast<char>(std::tolower(static_cast<unsigned char>(c))));
    return at == std::string::npos ? -1 : static_cast<int>(at);
}

std::string percent_decoded(const std::string& uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escape = uri[i] == '%' && i + 2 < uri.size() && hexadecimal(uri[i + 1]) >= 0 &&
                            hexadecimal(uri[i + 2]) >= 0;
        text += escape ? static_cast<char>(hexadecimal(uri[i + 1]) * 16 + hexadecimal(uri[i + 2]))
                       : uri[i];
        i += escape ? 2 : 0;
    }
    return text;
}

std::string external_file(const GltfSource& source, std::size_t index) {
    const GltfBuffer& buffer = source.buffers[index];
    const std::string which =
        "buffer " + std::to_string(index) + " lies in '" + visible(buffer.uri.substr(0, 200)) + "'";
    std::string file = file_in_scene_folder(source.path, percent_decoded(buffer.uri), which);
    std::error_code error;
    const std::uint64_t size = fs::file_size(file, error);
    if (error || size < buffer.bytes) {
        fail_file(source.path, which + ", which has " + std::to_string(error ? 0 : size) +
                                   " bytes; its byteLength is " + std::to_string(buffer.bytes) +
                                   ".");
    }
    return file;
}

/// Types of data: URIs that the library decodes; the first two are those of the specification.
void check_data_uri(const GltfSource& source, std::size_t index) {
    const std::string& uri = source.buffers[index].uri;
    for (const char* const type :
         {"application/octet-stream", "application/gltf-buffer", "text/plain"}) {
        if (uri.rfind(std::string("data:") + type + ";base64,", 0) == 0) {
            return;
        }
    }
    constexpr std::size_t kMostType = 100;
    const std::size_t end = std::min({uri.find(','), uri.size(), kMostType});
    fail_file(source.path, "buffer " + std::to_string(index) + " is a data URI of the type '" +
                               visible(uri.substr(5, end - 5)) +
                               "'; allowed are 'application/octet-stream;base64' and "
                               "'application/gltf-buffer;base64'.");
}

/// The specification lets the BIN chunk be up to 3 bytes longer than its buffer, to end at a
/// multiple of 4.
void check_bin_chunk(const GltfSource& source) {
    if (source.buffers.empty() || !source.buffers[0].uri.empty() || source.bin_bytes == 0) {
        return;
    }
    const std::uint64_t declared = source.buffers[0].bytes;
    constexpr std::uint64_t kMostPadding = 3;
    if (source.bin_bytes > declared + kMostPadding) {
        fail_file(source.path, "the BIN chunk of the GLB has " + std::to_string(source.bin_bytes) +
                                   " bytes, and the byteLength of its buffer is " +
                                   std::to_string(declared) +
                                   "; at most 3 bytes may be left over.");
    }
}

/// Sizes are added up before anything is allocated.
void check_buffers(GltfSource& source) {
    std::uint64_t total = 0;
    for (std::size_t i = 0; i < source.buffers.size(); ++i) {
        const GltfBuffer& buffer = source.buffers[i];
        total += buffer.bytes;
        if (buffer.bytes == 0 || total > kMostBytes) {
            fail_file(source.path,
                      "buffer " + std::to_string(i) + " has a byteLength of " +
                          std::to_string(buffer.bytes) +
                          "; at least 1 is needed, and all buffers together may have " +
                          std::to_string(kMostBytes) + " bytes.");
        }
        if (buffer.uri.empty() && (i > 0 || !source.binary)) {
            fail_file(source.path, "buffer " + std::to_string(i) +
                                       " has no uri; only the first buffer of a GLB needs none.");
        }
        const bool in_file = !buffer.uri.empty() && !is_data_uri(buffer.uri);
        if (is_data_uri(buffer.uri)) {
            check_data_uri(source, i);
        }
        source.external.push_back(in_file ? external_file(source, i) : std::string{});
    }
}

} // namespace

bool is_data_uri(const std::string& uri) {
    const std::string scheme = "data:"; // in either case
    return uri.size() >= scheme.size() &&
           std::equal(scheme.begin(), scheme.end(), uri.begin(), [](char a, char b) {
               return a == std::tolower(static_cast<unsigned char>(b));
           });
}

GltfSource read_gltf_source(const std::string& path) {
    GltfSource source;
    source.path = path;
    InputFile file(path);
    file.require_at_most(kMostBytes);
    source.bytes.resize(file.size());
    file.read_exactly(source.bytes.data(), source.bytes.size());
    source.binary = source.bytes.size() >= 4 && std::memcmp(source.bytes.data(), "glTF", 4) == 0;
    const GlbChunk json =
        source.binary ? check_glb(source) : GlbChunk{kJsonChunk, 0, source.bytes.size()};
    source.buffers =
        scan_gltf_json(path, source.bytes.data() + json.begin, source.bytes.data() + json.end());
    check_buffers(source);
    check_bin_chunk(source);
    return source;
}

std::vector<std::string> gltf_external_files(const std::string& path) {
    std::vector<std::string> files = read_gltf_source(path).external;
    files.erase(std::remove(files.begin(), files.end(), std::string{}), files.end());
    return files;
}

} // namespace degs
