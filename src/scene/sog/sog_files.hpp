// SPDX-License-Identifier: Apache-2.0
// Where the parts of a SOG scene lie: in an archive, or in the folder of its meta.json.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace degs {

class SogFiles {
public:
    virtual ~SogFiles() = default;
    virtual std::string meta() const = 0; ///< the text of meta.json
    /// The file that meta.json calls `name`; InputError if it has more than `limit_bytes`.
    virtual std::string read(const std::string& name, std::uint64_t limit_bytes) const = 0;
    /// Bytes of everything, packed, that meta.json names (`images`, each once) or the archive
    /// holds.
    virtual std::uint64_t bytes(const std::vector<std::string>& images) const = 0;
};

/// `path` is an archive, or a JSON text with its images in the same folder. InputError if it is a
/// streamed scene of many levels, which streamed_sog.hpp reads.
std::unique_ptr<SogFiles> open_sog_files(const std::string& path);

enum class SceneJson { Other, Sog, SogLevels, Gltf };

/// What the JSON text `path` is by its name or the members of its root: meta.json of a SOG scene,
/// lod-meta.json of a streamed one, a glTF, or something else (also if it is no JSON).
SceneJson kind_of_json(const std::string& path);

} // namespace degs
