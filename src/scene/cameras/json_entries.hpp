// SPDX-License-Identifier: Apache-2.0
// Reads the objects of a JSON file one at a time.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace degs {

/// Which objects of a JSON file are read.
struct JsonEntries {
    enum class Where {
        Root,  ///< the file is one object
        Array, ///< the file is an array of objects
        List   ///< the file is an object, and its key `list` holds an array of objects
    };
    Where where = Where::Array;
    const char* list = "";    ///< the key, for Where::List
    const char* file_is = ""; ///< e.g. "a camera file is a JSON array of cameras"
    const char* entry = "";   ///< what a message calls an entry; for a list, its number follows
    const char* needed = "";  ///< keys that every entry has, for messages
    std::vector<const char*> keys; ///< all that are kept
    int most_values = 0;           ///< of a key that is kept; nested arrays count as one more each
};

/// Parses the file and hands over every entry with the kept keys alone. Memory stays in proportion
/// to what the entries need, whatever else the file holds. Throws InputError for a file that is not
/// valid JSON, larger than 256 MiB, not of that shape, with a key twice in one entry, nested more
/// than 64 deep, or with more than 256 keys in one entry.
void read_json_entries(const std::string& path, const JsonEntries& entries,
                       const std::function<void(std::size_t index, const nlohmann::json&)>& take);

/// What messages call entry `index`, e.g. "camera 3".
std::string entry_name(const JsonEntries& entries, std::size_t index);

} // namespace degs
