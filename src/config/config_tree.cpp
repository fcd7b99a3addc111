// SPDX-License-Identifier: Apache-2.0
#include "config/config_tree.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "config/config_words.hpp"
#include "config/config_yaml.hpp"
#include "config/input_files.hpp"
#include "config/nearby_file.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

namespace fs = std::filesystem;
using config_words::quote;
using Kind = ConfigNode::Kind;

std::string read_bytes(const fs::path& path, const std::string& place) {
    if (path.empty()) {
        throw InputError(place +
                         "configuration file '' has an empty name; the path of a YAML file is "
                         "needed.");
    }
    const std::string name = place + "configuration file " + quote(path.string());
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    if (fs::is_directory(status)) {
        throw InputError(name + " is a directory; a YAML file is expected.");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) { // reading may never end
        throw InputError(name + " is not a regular file; a YAML file is expected.");
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        const int reason = errno;
        throw InputError(name + " cannot be read: " + std::strerror(reason) +
                         (reason == ENOENT ? nearby_file(path) : "") + ".");
    }
    // One byte more than allowed distinguishes a file that is too long from one that just fits, and
    // ends the reading of an endless one.
    std::string bytes(kLargestConfigBytes + 1, '\0');
    file.read(bytes.data(), bytes.size());
    bytes.resize(file.gcount());
    remember_input(path.string());
    if (bytes.size() > kLargestConfigBytes) {
        throw InputError(name + " is longer than " + std::to_string(kLargestConfigBytes) +
                         " bytes, the most that is allowed.");
    }
    return bytes;
}

/// `above` wins: sections are joined key by key, anything else is replaced. A section without keys
/// (its lines commented out, say) sets nothing and so replaces nothing.
void merge(ConfigNode& below, ConfigNode above) {
    if (below.kind == Kind::kSection && above.kind == Kind::kNull) {
        return;
    }
    if (below.kind != Kind::kSection || above.kind != Kind::kSection) {
        below = std::move(above);
        return;
    }
    below.place = above.place;
    below.layer = above.layer;
    for (ConfigNode& child : above.children) {
        const auto twin =
            std::find_if(below.children.begin(), below.children.end(),
                         [&](const ConfigNode& other) { return other.key == child.key; });
        if (twin == below.children.end()) {
            below.children.push_back(std::move(child));
        } else {
            merge(*twin, std::move(child));
        }
    }
}

void set_layer(ConfigNode& node, int layer) {
    node.layer = layer;
    for (ConfigNode& child : node.children) {
        set_layer(child, layer);
    }
}

/// Replaces every `include` of a tree by what it names.
class Includer {
public:
    ConfigNode file(const fs::path& path, const std::string& place) {
        std::error_code ignored; // a path that cannot be resolved cannot be opened either
        const fs::path identity = fs::weakly_canonical(path, ignored);
        if (std::find(open_.begin(), open_.end(), identity) != open_.end()) {
            throw InputError(place + "include of " + quote(path.string()) +
                             " goes in a circle; a file must not include itself.");
        }
        if (++count_ > kMostIncludes) {
            throw InputError(place + "more than " + std::to_string(kMostIncludes) +
                             " includes in one configuration; fewer are allowed.");
        }
        open_.push_back(identity);
        ConfigNode root = text(path.string(), read_bytes(path, place));
        open_.pop_back();
        return root;
    }

    ConfigNode text(const std::string& name, const std::string& yaml) {
        ConfigNode root = parse_config_yaml(name, yaml);
        if (root.kind == Kind::kNull) {
            throw InputError(name + ": the file is empty; a section of keys is expected.");
        }
        if (root.kind != Kind::kSection) {
            throw InputError(name + ": the file is a " +
                             (root.kind == Kind::kList ? "list" : "single value") +
                             "; a section of keys is expected.");
        }
        set_layer(root, static_cast<int>(std::max<std::size_t>(open_.size(), 1)));
        expand(root, fs::path(name).parent_path(), "");
        return root;
    }

private:
    void expand(ConfigNode& section, const fs::path& folder, const std::string& path);
    ConfigNode included(const ConfigNode& include, const fs::path& folder, const std::string& path);

    std::vector<fs::path> open_;
    int count_ = 0;
};

void Includer::expand(ConfigNode& section, const fs::path& folder, const std::string& path) {
    for (ConfigNode& child : section.children) {
        expand(child, folder, config_words::join_path(path, child.key));
    }
    if (section.kind != Kind::kSection) {
        return;
    }
    const ConfigNode* include = section.find("include");
    if (include == nullptr) {
        return;
    }
    const std::string include_path = config_words::join_path(path, "include");
    if (include != &section.children.front()) {
        throw InputError(include->place + ": key " + quote(include_path) +
                         " must be the first key of its section, because later keys win.");
    }
    ConfigNode base = included(*include, folder, include_path);
    base.key = section.key;
    section.children.erase(section.children.begin());
    merge(base, std::move(section));
    section = std::move(base);
}

ConfigNode Includer::included(const ConfigNode& include, const fs::path& folder,
                              const std::string& path) {
    std::vector<ConfigNode> names = include.children;
    if (include.kind == Kind::kScalar) {
        names.push_back(include);
    }
    ConfigNode base;
    base.kind = Kind::kSection;
    for (const ConfigNode& name : names) {
        if (name.kind != Kind::kScalar || include.kind == Kind::kSection || name.text.empty()) {
            throw InputError(include.place + ": key " + quote(path) +
                             " must be the path of a YAML file or a list of such paths.");
        }
        merge(base, file((folder / name.text).lexically_normal(),
                         name.place + ": key " + quote(path) + ": "));
    }
    if (names.empty()) {
        throw InputError(include.place + ": key " + quote(path) +
                         " has no value; the path of a YAML file is expected.");
    }
    return base;
}

} // namespace

const ConfigNode* ConfigNode::find(const std::string& child) const {
    const auto found = std::find_if(children.begin(), children.end(),
                                    [&](const ConfigNode& node) { return node.key == child; });
    return found == children.end() ? nullptr : &*found;
}

std::filesystem::path folder_of(const ConfigNode& node) {
    const bool option = node.place.rfind("--", 0) == 0;
    return option ? fs::path()
                  : fs::path(node.place.substr(0, node.place.rfind(':'))).parent_path();
}

ConfigNode read_config_file(const std::filesystem::path& path, const std::string& place) {
    return Includer().file(path, place);
}

ConfigNode read_config_text(const std::string& name, const std::string& yaml) {
    return Includer().text(name, yaml);
}

} // namespace degs
