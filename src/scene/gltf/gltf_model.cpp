// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_model.hpp"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "base/visible_text.hpp"
#include "degs/error.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;

/// Bytes of every file that the library may read.
using Allowed = std::map<std::string, std::uint64_t>;

const Allowed::value_type* find_allowed(const std::string& name, void* allowed) {
    std::error_code error;
    const std::string canonical = fs::weakly_canonical(name, error).string();
    const auto* const files = static_cast<const Allowed*>(allowed);
    const auto found = files->find(canonical);
    return error || found == files->end() ? nullptr : &*found;
}

bool file_exists(const std::string& name, void* allowed) {
    return find_allowed(name, allowed) != nullptr;
}

std::string same_path(const std::string& name, void* /*allowed*/) {
    return name;
}

/// The declared bytes of the buffer; a file may be longer.
bool read_allowed(std::vector<unsigned char>* bytes, std::string* error, const std::string& name,
                  void* allowed) {
    const Allowed::value_type* const file = find_allowed(name, allowed);
    if (file == nullptr) {
        *error = "only files in the folder of the scene are read";
        return false;
    }
    try {
        InputFile input(file->first);
        bytes->resize(std::min(file->second, input.size()));
        input.read_exactly(reinterpret_cast<char*>(bytes->data()), bytes->size());
        return true;
    } catch (const InputError& failure) {
        *error = failure.what();
        return false;
    }
}

bool write_nothing(std::string* error, const std::string& /*name*/,
                   const std::vector<unsigned char>& /*bytes*/, void* /*allowed*/) {
    *error = "a reader writes no files";
    return false;
}

bool ignore_image(tinygltf::Image* /*image*/, int /*index*/, std::string* /*error*/,
                  std::string* /*warning*/, int /*width*/, int /*height*/,
                  const unsigned char* /*bytes*/, int /*size*/, void* /*user*/) {
    return true;
}

/// First line of a complaint of the library, without its full stop.
std::string first_line(const std::string& complaint) {
    constexpr std::size_t kMost = 200;
    std::string line = complaint.substr(0, std::min(complaint.find('\n'), kMost));
    for (char& c : line) {
        c = c < ' ' || c > '~' ? '?' : c;
    }
    line.erase(line.find_last_not_of(". ") + 1);
    return line.empty() ? "without a reason" : line;
}

void load(GltfFile& file, const GltfSource& source, Allowed& allowed) {
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(ignore_image, nullptr);
    loader.SetFsCallbacks({file_exists, same_path, read_allowed, write_nothing, &allowed});
    std::error_code ignored;
    const std::string folder =
        fs::canonical(absolute_path(source.path).parent_path(), ignored).string();
    std::string error, warning;
    bool loaded = false;
    const auto size = static_cast<unsigned>(source.bytes.size());
    try {
        loaded = source.binary ? loader.LoadBinaryFromMemory(
                                     &file.model, &error, &warning,
                                     reinterpret_cast<const unsigned char*>(source.bytes.data()),
                                     size, folder)
                               : loader.LoadASCIIFromString(&file.model, &error, &warning,
                                                            source.bytes.data(), size, folder);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& failure) {
        error = failure.what();
    }
    if (error.find("\"asset\" object not found") != std::string::npos) {
        error = "it has no asset with a version in it, and version 2 is read";
    }
    if (!loaded || !error.empty()) { // some errors drop an object and let the load succeed
        file.fail("the glTF library refuses the file: " + first_line(error) + ".");
    }
}

/// Major and minor of "2.0"; nothing for other texts.
std::optional<std::pair<int, int>> parse_version(const std::string& text) {
    std::pair<int, int> version;
    const char* const end = text.data() + text.size();
    const auto major = std::from_chars(text.data(), end, version.first);
    if (major.ec != std::errc() || major.ptr == end || *major.ptr != '.' || text[0] == '-') {
        return std::nullopt;
    }
    const auto minor = std::from_chars(major.ptr + 1, end, version.second);
    const bool good = minor.ec == std::errc() && minor.ptr == end && version.second >= 0;
    return good ? std::optional(version) : std::nullopt;
}

/// Files of a later minor version are read unless they say that they need it.
void check_version(const GltfFile& file) {
    const std::string& version = file.model.asset.version;
    const std::string& least = file.model.asset.minVersion;
    const auto parsed = parse_version(version);
    if (!parsed || parsed->first != 2) {
        file.fail("this is a glTF of version '" + first_line(version.substr(0, 20)) +
                  "'; version 2 is read.");
    }
    const auto needed = parse_version(least);
    if (!least.empty() && (!needed || *needed > std::pair(2, 0))) {
        file.fail("its minVersion says that a reader of glTF of version '" +
                  first_line(least.substr(0, 20)) + "' is needed; version 2.0 is read.");
    }
}

/// Materials and textures do not matter to splats.
bool is_known_extension(const std::string& name) {
    const char* const known[] = {"KHR_gaussian_splatting",
                                 "KHR_gaussian_splatting_compression_spz_2",
                                 "KHR_gaussian_splatting_compression_spz",
                                 "KHR_spz_gaussian_splats_compression",
                                 "KHR_mesh_quantization",
                                 "EXT_mesh_gpu_instancing"};
    return std::find(std::begin(known), std::end(known), name) != std::end(known) ||
           name.rfind("KHR_materials_", 0) == 0 || name.rfind("KHR_texture_", 0) == 0;
}

void check_extensions(const GltfFile& file) {
    for (const std::string& name : file.model.extensionsRequired) {
        if (!is_known_extension(name)) {
            file.fail("the file requires the extension " + quoted_name(name) +
                      ", which is not read.");
        }
    }
}

} // namespace

void GltfFile::fail(const std::string& sentence) const {
    fail_file(path, sentence);
}

void GltfFile::note(const std::string& sentence) {
    if (std::find(notes.begin(), notes.end(), sentence) == notes.end()) {
        notes.push_back(sentence);
    }
}

GltfFile parse_gltf(GltfSource source) {
    GltfFile file;
    file.path = source.path;
    file.notes = source.notes;
    Allowed allowed;
    for (std::size_t i = 0; i < source.buffers.size(); ++i) {
        if (!source.external[i].empty()) {
            std::uint64_t& bytes = allowed[source.external[i]];
            bytes = std::max(bytes, source.buffers[i].bytes);
        }
    }
    load(file, source, allowed);
    check_version(file);
    check_extensions(file);
    return file;
}

std::string quoted_name(const std::string& name) {
    constexpr std::size_t kMost = 60;
    return name.empty() ? "" : "'" + first_line(name.substr(0, kMost)) + "'";
}

const tinygltf::Value* member_of(const tinygltf::Value& value, const std::string& key) {
    return value.IsObject() && value.Has(key) ? &value.Get(key) : nullptr;
}

} // namespace degs
