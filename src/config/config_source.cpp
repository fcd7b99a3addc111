// SPDX-License-Identifier: Apache-2.0
#include "config/config_source.hpp"

#include <algorithm>

#include "config/config_reader.hpp"
#include "config/config_words.hpp"

namespace degs {
namespace {

using config_words::quote;

ConfigNode empty_root() {
    ConfigNode root;
    root.kind = ConfigNode::Kind::kSection;
    return root;
}

/// The path of `path.to.key=value`, or an InputError.
std::string path_of(const std::string& setting, const std::string& option) {
    const std::size_t equals = setting.find('=');
    std::string path = setting.substr(0, equals);
    const bool hollow = path.empty() || path.front() == '.' || path.back() == '.' ||
                        path.find("..") != std::string::npos;
    if (equals == std::string::npos || hollow) {
        throw InputError(option + " " + quote(setting) +
                         ": this is not an override; path.to.key=value is expected.");
    }
    return path;
}

} // namespace

ConfigSource::ConfigSource(ConfigNode root, const std::vector<std::string>& overrides,
                           const std::string& option)
    : root_(std::move(root)) {
    for (const std::string& setting : overrides) {
        Override override;
        override.path = path_of(setting, option);
        override.value.kind = ConfigNode::Kind::kScalar;
        override.value.text = setting.substr(override.path.size() + 1);
        override.value.layer = 0;
        override.value.place = option;
        override.value.place.append(" ").append(setting);
        overrides_.push_back(std::move(override));
    }
}

ConfigSource ConfigSource::from_file(const std::filesystem::path& path,
                                     const std::vector<std::string>& overrides) {
    return {read_config_file(path), overrides};
}

ConfigSource ConfigSource::from_text(const std::string& name, const std::string& yaml,
                                     const std::vector<std::string>& overrides) {
    return {read_config_text(name, yaml), overrides};
}

ConfigSource ConfigSource::from_overrides(const std::vector<std::string>& overrides,
                                          const std::string& option) {
    return {empty_root(), overrides, option};
}

std::vector<std::string>
ConfigSource::read(const std::function<void(ConfigVisitor&)>& describe) const {
    ConfigReader reader(*this);
    describe(reader);
    reader.finish();
    return reader.warnings();
}

const ConfigSource::Override* ConfigSource::override_of(const std::string& path) const {
    const auto last = std::find_if(overrides_.rbegin(), overrides_.rend(),
                                   [&](const Override& each) { return each.path == path; });
    return last == overrides_.rend() ? nullptr : &*last;
}

ConfigSource::Given ConfigSource::strongest(const std::string& path) const {
    for (const Override& each : overrides_) {
        if (each.path == path || each.path.compare(0, path.size() + 1, path + ".") == 0) {
            return {&each.value, each.path};
        }
    }
    return {node_of(path), path};
}

std::string ConfigSource::place(const std::string& path) const {
    if (const Override* set = override_of(path)) {
        return set->value.place;
    }
    const ConfigNode* node = node_of(path);
    return node == nullptr ? "default" : node->place;
}

std::string ConfigSource::folder(const std::string& path) const {
    const ConfigNode* node = override_of(path) == nullptr ? node_of(path) : nullptr;
    return node == nullptr ? "" : folder_of(*node).string();
}

const ConfigNode* ConfigSource::node_of(const std::string& path) const {
    const ConfigNode* node = &root_;
    std::size_t begin = 0;
    while (node != nullptr && begin <= path.size()) {
        const std::size_t end = std::min(path.find('.', begin), path.size());
        node = node->find(path.substr(begin, end - begin));
        begin = end + 1;
    }
    return node;
}

} // namespace degs
