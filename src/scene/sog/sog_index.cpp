// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/sog_index.hpp"

#include <algorithm>
#include <cctype>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMostLevels = 100;
constexpr std::uint64_t kMostInRun = 0xFFFFFFFF; ///< of a run; sums stay far from 2^64
constexpr std::size_t kDeepest = 64;             ///< nodes from the root to a leaf

class IndexParser {
public:
    IndexParser(const std::string& where, const Json& root) : where_(where), root_(root) {}

    SogIndex parse() {
        if (!root_.is_object()) {
            fail("is no object");
        }
        if (root_.contains("version") && root_["version"] != 1) {
            fail("has a 'version' other than 1");
        }
        levels_ = whole(root_, "lodLevels", "", kMostLevels);
        if (levels_ == 0) {
            fail("has 0 'lodLevels'; allowed are 1 to " + std::to_string(kMostLevels));
        }
        take_names();
        walk();
        check_counts();
        return std::move(index_);
    }

private:
    /// A node of the tree, and how many of its children were visited.
    struct Visit {
        const Json* node;
        std::size_t children = 0;
    };

    [[noreturn]] void fail(const std::string& what) const {
        fail_file(where_, "its lod-meta.json " + what + ", so it is no streamed SOG scene.");
    }

    std::uint64_t whole(const Json& object, const char* name, const std::string& place,
                        std::uint64_t most) const {
        if (!object.contains(name) || !object[name].is_number_unsigned() ||
            object[name].get<std::uint64_t>() > most) {
            fail("needs a whole number up to " + std::to_string(most) + " in '" + place + name +
                 "'");
        }
        return object[name].get<std::uint64_t>();
    }

    void take_names() {
        if (!root_.contains("filenames") || !root_["filenames"].is_array()) {
            fail("needs a list 'filenames'");
        }
        for (const Json& name : root_["filenames"]) {
            if (!name.is_string()) {
                fail("has an entry of 'filenames' that is no text");
            }
            index_.files.push_back(name.get<std::string>());
        }
        if (!root_.contains("environment") || root_["environment"].is_null()) {
            return; // older writers say null
        }
        if (root_["environment"].is_string()) {
            index_.environment = root_["environment"].get<std::string>();
        }
        if (index_.environment.empty()) {
            fail("has an 'environment' that is no name of a file");
        }
    }

    std::string place() const {
        std::string text = "tree";
        for (std::size_t i = 0; i + 1 < path_.size(); ++i) {
            text += ".children[" + std::to_string(path_[i].children - 1) + "]";
        }
        return text;
    }

    /// Keeps its own path, so that a deep tree costs no stack.
    void walk() {
        if (!root_.contains("tree")) {
            fail("needs an object 'tree'");
        }
        path_.push_back({&root_["tree"]});
        enter(*path_.back().node);
        while (!path_.empty()) {
            Visit& visit = path_.back();
            const auto children = visit.node->find("children");
            if (children == visit.node->end() || visit.children == children->size()) {
                path_.pop_back();
                continue;
            }
            if (path_.size() == kDeepest) {
                fail("has a 'tree' that is deeper than the " + std::to_string(kDeepest) +
                     " allowed");
            }
            path_.push_back({&(*children)[visit.children++]});
            enter(*path_.back().node);
        }
    }

    void enter(const Json& node) {
        if (!node.is_object() || node.contains("children") == node.contains("lods")) {
            fail("needs an object with either 'children' or 'lods' in '" + place() + "'");
        }
        if (node.contains("lods")) {
            add_leaf(node["lods"]);
        } else if (!node["children"].is_array()) {
            fail("needs a list in '" + place() + ".children'");
        }
    }

    void add_leaf(const Json& lods) {
        if (!lods.is_object()) {
            fail("needs an object in '" + place() + ".lods'");
        }
        SogLeaf leaf;
        for (const auto& [key, value] : lods.items()) {
            const int level = level_of(key);
            const std::string at = place() + ".lods." + key;
            if (!value.is_object()) {
                fail("needs an object in '" + at + "'");
            }
            SogRun run;
            run.offset = whole(value, "offset", at + ".", kMostInRun);
            run.count = whole(value, "count", at + ".", kMostInRun);
            run.file = whole(value, "file", at + ".", kMostInRun);
            if (run.file >= index_.files.size()) {
                fail("names file " + std::to_string(run.file) + " in '" + at +
                     ".file', and 'filenames' has " + std::to_string(index_.files.size()));
            }
            if (run.count > 0) {
                leaf[level] = run;
            }
        }
        index_.leaves.push_back(std::move(leaf));
    }

    int level_of(const std::string& key) const {
        const bool number =
            !key.empty() && key.size() < 3 && (key == "0" || key[0] != '0') &&
            std::all_of(key.begin(), key.end(), [](unsigned char c) { return std::isdigit(c); });
        if (!number || std::stoul(key) >= levels_) {
            fail("has a level " + in_quotes(key) + " in '" + place() + ".lods'; allowed are 0 to " +
                 std::to_string(levels_ - 1));
        }
        return std::stoi(key);
    }

    /// Older writers do not count.
    void check_counts() const {
        std::vector<std::uint64_t> sums(levels_, 0);
        for (const SogLeaf& leaf : index_.leaves) {
            for (const auto& [level, run] : leaf) {
                sums[static_cast<std::size_t>(level)] += run.count;
            }
        }
        if (*std::max_element(sums.begin(), sums.end()) == 0) {
            fail("has a 'tree' without Gaussians");
        }
        if (root_.contains("counts") && root_["counts"] != Json(sums)) {
            fail("has 'counts' that are not the sums of the Gaussians in its leaves, " +
                 dump_json(Json(sums)));
        }
    }

    const std::string& where_;
    const Json& root_;
    std::uint64_t levels_ = 0;
    std::vector<Visit> path_; ///< from the root to the node that is read
    SogIndex index_;
};

} // namespace

SogIndex parse_sog_index(const std::string& where, const std::string& text) {
    const Json root = parse_json(text);
    if (root.is_discarded()) {
        fail_file(where, "its lod-meta.json is no JSON, so it is no streamed SOG scene.");
    }
    return IndexParser(where, root).parse();
}

} // namespace degs
