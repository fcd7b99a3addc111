// SPDX-License-Identifier: Apache-2.0
#include "sim/sweep/tree_changes.hpp"

#include <algorithm>

namespace degs::sim {
namespace {

/// The child with this key, which is made if it is missing.
ConfigNode& child_of(ConfigNode& section, const std::string& key) {
    const auto found = std::find_if(section.children.begin(), section.children.end(),
                                    [&key](const ConfigNode& child) { return child.key == key; });
    ConfigNode& child = found != section.children.end() ? *found : section.children.emplace_back();
    child.key = key;
    return child;
}

/// The node at a path; the sections on the way are made.
ConfigNode& node_at(ConfigNode& tree, const std::string& path, const std::string& place) {
    const std::size_t dot = path.find('.');
    ConfigNode& child = child_of(tree, path.substr(0, dot));
    if (dot == std::string::npos) {
        return child;
    }
    child.place = child.place.empty() ? place : child.place;
    child.kind = ConfigNode::Kind::kSection;
    return node_at(child, path.substr(dot + 1), place);
}

void merge(ConfigNode& section, const ConfigNode& file) {
    section.kind = ConfigNode::Kind::kSection;
    for (const ConfigNode& given : file.children) {
        ConfigNode& child = child_of(section, given.key);
        if (given.kind == ConfigNode::Kind::kSection) {
            child.place = child.place.empty() ? given.place : child.place;
            merge(child, given);
        } else {
            child = given;
            ++child.layer; // that of a file which is included
        }
    }
}

} // namespace

void put_value(ConfigNode& tree, const std::string& path, const std::string& text,
               const std::string& place) {
    ConfigNode& node = node_at(tree, path, place);
    node.kind = ConfigNode::Kind::kScalar;
    node.children.clear();
    node.quoted = false;
    node.text = text;
    node.place = place;
    node.layer = 0;
}

void put_section(ConfigNode& tree, const std::string& path, const ConfigNode& file,
                 const std::string& place) {
    ConfigNode& section = node_at(tree, path, place);
    section.place = section.place.empty() ? place : section.place;
    merge(section, file);
}

} // namespace degs::sim
