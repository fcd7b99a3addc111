// SPDX-License-Identifier: Apache-2.0
#include "config/config_yaml.hpp"

#include <algorithm>
#include <sstream>

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include "base/visible_text.hpp"
#include "config/config_words.hpp"
#include "degs/error.hpp"

namespace degs {
namespace {

using config_words::quote;
using Kind = ConfigNode::Kind;

/// Builds the tree from parser events. Events rather than YAML::Node, because a node graph can hold
/// loops and shared branches, and forgets duplicate keys.
class TreeBuilder : public YAML::EventHandler {
public:
    TreeBuilder(std::string file, const std::string& yaml) : file_(std::move(file)), yaml_(yaml) {
        root_.place = file_;
    }

    ConfigNode take() { return std::move(root_); }

    void OnDocumentStart(const YAML::Mark&) override {}
    void OnDocumentEnd() override {}
    void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
        fail(mark,
             "anchor " + quote("&" + name) + " is not accepted; repeat the value or use include");
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
        fail(mark, "an alias (*name) is not accepted; repeat the value or use include");
    }
    void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { place(mark, Kind::kNull, "?"); }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                  const std::string& value) override {
        require_closed(mark);
        if (expects_key()) {
            return take_key(mark, value);
        }
        ConfigNode& node = place(mark, Kind::kScalar, tag);
        node.text = value;
        node.quoted = tag == "!"; // how the parser marks a scalar in quotes
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                         YAML::EmitterStyle::value) override {
        open_.push_back(&place(mark, Kind::kList, tag));
    }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t,
                    YAML::EmitterStyle::value) override {
        open_.push_back(&place(mark, Kind::kSection, tag));
    }
    void OnSequenceEnd() override { close(); }
    void OnMapEnd() override { close(); }

private:
    [[noreturn]] void fail(const YAML::Mark& mark, const std::string& reason) const {
        const std::string path = config_words::join_path(path_, has_key_ ? key_ : "");
        throw InputError(at(mark) + (path.empty() ? "" : "key " + quote(path) + ": ") + reason +
                         ".");
    }
    std::string at(const YAML::Mark& mark) const { return line_of(mark) + ": "; }
    std::string line_of(const YAML::Mark& mark) const {
        return file_ + ":" + std::to_string(mark.line + 1);
    }
    bool expects_key() const {
        return !open_.empty() && open_.back()->kind == Kind::kSection && !has_key_;
    }
    void require_closed(const YAML::Mark& mark);
    void take_key(const YAML::Mark& mark, const std::string& name);
    ConfigNode& place(const YAML::Mark& mark, Kind kind, const std::string& tag);
    void close();

    std::string file_;
    const std::string& yaml_;
    int line_ = 0;               // of the latest scalar
    std::size_t line_begin_ = 0; // in yaml_
    ConfigNode root_;
    std::vector<ConfigNode*> open_; // a node's siblings grow only after it is closed
    std::string path_;              // of the innermost open section
    std::string key_, key_place_;
    bool has_key_ = false;
};

/// Behind a quote that is never closed, all keys up to the next quote or the end would be text.
void TreeBuilder::require_closed(const YAML::Mark& mark) {
    for (; line_ < mark.line; ++line_) {
        line_begin_ = yaml_.find('\n', line_begin_) + 1;
    }
    const std::size_t end = std::min(yaml_.find('\n', line_begin_), yaml_.size());
    std::size_t at = line_begin_ + mark.column;
    const char quote = at < end ? yaml_[at] : '\0';
    if (quote != '"' && quote != '\'') {
        return;
    }
    for (++at; at < end && yaml_[at] != quote; ++at) {
        at += quote == '"' && yaml_[at] == '\\' ? 1 : 0;
    }
    if (at >= end) {
        fail(mark, std::string("the quote ") + quote + " is not closed on its line");
    }
}

void TreeBuilder::take_key(const YAML::Mark& mark, const std::string& name) {
    key_ = name;
    has_key_ = true;
    key_place_ = line_of(mark);
    if (name.empty()) {
        fail(mark, "a key must have a name");
    }
    if (open_.back()->children.size() >= kMostConfigKeys) {
        fail(mark, "more than " + std::to_string(kMostConfigKeys) + " keys in one section");
    }
    if (const ConfigNode* first = open_.back()->find(name)) {
        fail(mark, "is given twice, first at " + first->place);
    }
}

ConfigNode& TreeBuilder::place(const YAML::Mark& mark, Kind kind, const std::string& tag) {
    if (expects_key()) {
        fail(mark, "a key must be a word, not a section, a list or nothing");
    }
    if (!tag.empty() && tag != "?" && tag != "!") {
        fail(mark, "tag " + quote(tag) + " is not accepted; write the plain value");
    }
    ConfigNode* node = &root_;
    if (!open_.empty()) {
        node = &open_.back()->children.emplace_back();
        node->key = key_;
        node->place = has_key_ ? key_place_ : line_of(mark);
    }
    if (open_.size() > kDeepestConfig) {
        fail(mark, "is nested more than " + std::to_string(kDeepestConfig) + " levels deep");
    }
    if (kind == Kind::kSection || kind == Kind::kList) {
        path_ = config_words::join_path(path_, key_);
    }
    node->kind = kind;
    key_.clear();
    has_key_ = false;
    return *node;
}

void TreeBuilder::close() {
    const std::string& key = open_.back()->key;
    path_.resize(path_.size() - std::min(path_.size(), key.size() + (key.empty() ? 0 : 1)));
    open_.pop_back();
}

} // namespace

ConfigNode parse_config_yaml(const std::string& name, const std::string& text) {
    constexpr const char* kByteOrderMark = "\xEF\xBB\xBF";
    const std::string yaml = text.rfind(kByteOrderMark, 0) == 0 ? text.substr(3) : text;
    try {
        std::istringstream stream(yaml);
        YAML::Parser parser(stream);
        TreeBuilder builder(name, yaml);
        if (!parser.HandleNextDocument(builder)) {
            throw InputError(name + ": the file is empty; a section of keys is expected.");
        }
        TreeBuilder second(name, yaml);
        if (parser.HandleNextDocument(second)) {
            throw InputError(name +
                             ": the file holds more than one YAML document; one is allowed.");
        }
        return builder.take();
    } catch (const YAML::Exception& error) {
        throw InputError(name + ":" + std::to_string(error.mark.line + 1) +
                         ": this is not valid YAML: " + visible(error.msg) + ".");
    }
}

} // namespace degs
