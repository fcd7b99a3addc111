// SPDX-License-Identifier: Apache-2.0
#include "scene/cameras/json_entries.hpp"

#include <algorithm>
#include <set>

#include "scene/cameras/camera_place.hpp"
#include "scene/files/input_file.hpp"

namespace degs {
namespace {

using Json = nlohmann::json;
using Take = std::function<void(std::size_t, const Json&)>;
using Where = JsonEntries::Where;

constexpr std::uint64_t kMostJsonBytes = 256U << 20U;
constexpr int kMostDepth = 64;         ///< of arrays and objects inside each other
constexpr std::size_t kMostKeys = 256; ///< of an entry

/// Listens to the parser of the JSON library. It keeps the values of one entry at a time, and of
/// these only the keys that it needs, so that a file cannot take memory that its cameras do not.
class EntryListener {
public:
    EntryListener(const std::string& path, const JsonEntries& entries, const Take& take)
        : path_(path), entries_(entries), take_(take), level_(entries.where == Where::Root    ? 0
                                                              : entries.where == Where::Array ? 1
                                                                                              : 2),
          inside_(entries.where != Where::List) {}

    /// Whether the parser is to keep what it has found; `depth` counts the arrays and objects
    /// around it. Throws InputError.
    bool hear(int depth, Json::parse_event_t event, const Json& value) {
        using Event = Json::parse_event_t;
        switch (event) {
        case Event::key:
            return hear_key(depth, value.get_ref<const std::string&>());
        case Event::object_end:
            return depth != level_ || !inside_ || end_entry(value);
        case Event::array_end:
            return true;
        default:
            hear_value(depth, event, value);
            return true;
        }
    }

    std::size_t entries() const { return index_; }
    bool found_list() const { return found_list_; }

private:
    [[noreturn]] void fail(const std::string& sentence) const {
        CameraPlace(path_, entry_name(entries_, index_)).fail(sentence);
    }

    void hear_value(int depth, Json::parse_event_t event, const Json& value) {
        const bool array = event == Json::parse_event_t::array_start;
        const bool object = event == Json::parse_event_t::object_start;
        if (depth == 0 && !(entries_.where == Where::Array ? array : object)) {
            fail_file(path_, std::string(entries_.file_is) + ", and this is a single " +
                                 (object  ? "object"
                                  : array ? "array"
                                          : value.type_name()) +
                                 ".");
        }
        if (entries_.where == Where::List && depth == 1 && inside_ && !array) {
            fail_file(path_, std::string("the key '") + entries_.list + "' is not an array.");
        }
        if (depth == level_ && inside_ && !object) {
            fail("is not an object with the keys " + std::string(entries_.needed) + ".");
        }
        if (depth > level_ && inside_ && wanted_ && ++values_ > entries_.most_values) {
            fail("has more values in its '" + key_ + "' than any key needs.");
        }
        if (depth > kMostDepth) {
            fail("has arrays or objects more than " + std::to_string(kMostDepth) +
                 " deep inside each other.");
        }
    }

    bool hear_key(int depth, const std::string& key) {
        if (entries_.where == Where::List && depth == 1) {
            inside_ = key == entries_.list;
            if (inside_ && found_list_) {
                fail_file(path_, "the file has the key '" + key + "' twice.");
            }
            found_list_ = found_list_ || inside_;
            return inside_;
        }
        return depth != level_ + 1 || !inside_ || hear_entry_key(key);
    }

    bool hear_entry_key(const std::string& key) {
        if (!seen_.insert(key).second) {
            fail("has the key " + in_quotes(key) + " twice.");
        }
        if (seen_.size() > kMostKeys) {
            fail("has more than " + std::to_string(kMostKeys) + " keys.");
        }
        wanted_ = std::find(entries_.keys.begin(), entries_.keys.end(), key) != entries_.keys.end();
        values_ = 0;
        key_ = wanted_ ? key : std::string();
        return wanted_;
    }

    bool end_entry(const Json& entry) {
        take_(index_, entry);
        ++index_;
        seen_.clear();
        wanted_ = false;
        return false;
    }

    const std::string& path_;
    const JsonEntries& entries_;
    const Take& take_;
    int level_;   ///< arrays and objects around an entry
    bool inside_; ///< the array of entries
    bool found_list_ = false;
    std::size_t index_ = 0;
    std::set<std::string> seen_; ///< keys of this entry
    std::string key_;            ///< the last of them, if it is wanted
    bool wanted_ = false;
    int values_ = 0; ///< of that key so far
};

} // namespace

std::string entry_name(const JsonEntries& entries, std::size_t index) {
    return entries.where == Where::Root ? entries.entry
                                        : entries.entry + (" " + std::to_string(index));
}

void read_json_entries(const std::string& path, const JsonEntries& entries, const Take& take) {
    InputFile file(path);
    file.require_at_most(kMostJsonBytes);
    EntryListener listener(path, entries, take);
    try {
        const Json rest =
            Json::parse(file.stream(), [&](int depth, Json::parse_event_t event, Json& value) {
                return listener.hear(depth, event, value);
            });
    } catch (const Json::parse_error& error) {
        fail_file(path, "this is not valid JSON (at byte " + std::to_string(error.byte) + "); " +
                            entries.file_is + ".");
    } catch (const Json::exception&) { // a number beyond double
        fail_file(path, "a number in this JSON file is out of range.");
    }
    if (entries.where == Where::List && !listener.found_list()) {
        fail_file(path, std::string("the file has no key '") + entries.list + "'; " +
                            entries.file_is + ".");
    }
    if (listener.entries() == 0) {
        fail_file(path, "the array holds no camera; at least one is needed.");
    }
}

} // namespace degs
