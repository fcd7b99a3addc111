// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog_files.hpp"

#include <filesystem>
#include <set>

#include <nlohmann/json.hpp>

#include "base/visible_text.hpp"
#include "scene/archive/zip_archive.hpp"
#include "scene/files/input_file.hpp"
#include "scene/files/scene_folder.hpp"

namespace degs {
namespace {

constexpr std::uint64_t kMaxMetaBytes = 1 << 20;
constexpr const char* kMetaName = "meta.json";
constexpr const char* kLevelsName = "lod-meta.json";

class SogArchive : public SogFiles {
public:
    explicit SogArchive(const std::string& path) : archive_(path) {
        if (!archive_.has(kMetaName) && archive_.has(kLevelsName)) {
            fail_file(path, "the archive holds a streamed SOG scene (lod-meta.json), which is read "
                            "from a folder only; unpack it and name the lod-meta.json.");
        }
    }
    std::string meta() const override { return archive_.read(kMetaName, kMaxMetaBytes); }
    std::string read(const std::string& name, std::uint64_t limit_bytes) const override {
        return archive_.read(name, limit_bytes);
    }
    std::uint64_t bytes(const std::vector<std::string>& /*images*/) const override {
        return archive_.bytes();
    }

private:
    ZipArchive archive_;
};

class SogFolder : public SogFiles {
public:
    explicit SogFolder(const std::string& path) : path_(path) {}
    std::string meta() const override { return read_text(path_, kMaxMetaBytes); }
    std::string read(const std::string& name, std::uint64_t limit_bytes) const override {
        return read_text(file(name), limit_bytes);
    }
    std::uint64_t bytes(const std::vector<std::string>& images) const override {
        std::uint64_t sum = InputFile(path_).size();
        for (const std::string& name : std::set<std::string>(images.begin(), images.end())) {
            sum += InputFile(file(name)).size();
        }
        return sum;
    }

private:
    std::string file(const std::string& name) const {
        return file_in_scene_folder(path_, name,
                                    "its image lies in '" + visible(name.substr(0, 100)) + "'");
    }
    std::string path_;
};

using RootJson = nlohmann::json;

/// Looks at the keys of the root until one of them decides, and keeps nothing.
class RootScan : public nlohmann::json_sax<RootJson> {
public:
    SceneJson kind() const { return kind_; }

    bool null() override { return true; }
    bool boolean(bool /*value*/) override { return true; }
    bool number_integer(number_integer_t /*value*/) override { return true; }
    bool number_unsigned(number_unsigned_t /*value*/) override { return true; }
    bool number_float(number_float_t /*value*/, const string_t& /*text*/) override { return true; }
    bool string(string_t& /*value*/) override { return true; }
    bool binary(binary_t& /*value*/) override { return true; }
    bool start_object(std::size_t /*elements*/) override { return ++depth_ > 0; }
    bool key(string_t& name) override { return depth_ != 1 || !decides(name); }
    bool end_object() override { return --depth_ >= 0; }
    bool start_array(std::size_t /*elements*/) override { return ++depth_ > 0; }
    bool end_array() override { return --depth_ >= 0; }
    bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                     const nlohmann::detail::exception& /*error*/) override {
        return false;
    }

private:
    bool decides(const std::string& name) {
        const std::set<std::string> sog{"means", "quats", "sh0", "shN"};
        const std::set<std::string> levels{"lodLevels", "filenames", "tree"};
        const std::set<std::string> gltf{"meshes",      "nodes",   "scenes",
                                         "bufferViews", "buffers", "accessors"};
        if (sog.count(name) != 0) {
            kind_ = SceneJson::Sog;
        } else if (levels.count(name) != 0) {
            kind_ = SceneJson::SogLevels;
        } else if (gltf.count(name) != 0) {
            kind_ = SceneJson::Gltf;
        } else {
            kind_ = name == "asset" ? SceneJson::Gltf : kind_; // unless a SOG has it
            return false;
        }
        return true;
    }

    int depth_ = 0;
    SceneJson kind_ = SceneJson::Other;
};

} // namespace

SceneJson kind_of_json(const std::string& path) {
    const std::string name = std::filesystem::path(path).filename().string();
    if (name == kMetaName || name == kLevelsName) {
        return name == kMetaName ? SceneJson::Sog : SceneJson::SogLevels;
    }
    InputFile file(path);
    RootScan scan;
    RootJson::sax_parse(file.stream(), &scan);
    return scan.kind();
}

std::unique_ptr<SogFiles> open_sog_files(const std::string& path) {
    InputFile file(path);
    char first = 0;
    file.read_exactly(&first, 1);
    if (first == 'P') { // of a zip archive
        return std::make_unique<SogArchive>(path);
    }
    if (kind_of_json(path) == SceneJson::SogLevels) {
        fail_file(path, "this is the index of a streamed SOG scene (lod-meta.json), and one SOG "
                        "scene is needed: a .sog file or a meta.json.");
    }
    return std::make_unique<SogFolder>(path);
}

} // namespace degs
