// SPDX-License-Identifier: Apache-2.0
// What the array did for each tile of the first frame, as pictures and as layers of an image.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/shell/output_folder.hpp"
#include "sim/simulation/run_result.hpp"

namespace degs::sim {

/// One measure of every tile, row by row; NaN where a tile lists no splat.
struct TileMap {
    std::string name;  ///< of files and layers
    std::string title; ///< with the unit
    std::vector<float> values;
};

struct TileMaps {
    TileGrid grid;
    std::vector<TileMap> maps;
};

TileMaps tile_maps_of(const RunResult& result);
/// The map, and below it its title and a legend.
Image map_picture(const TileMaps& maps, const TileMap& map, const std::string& subtitle);
/// The map over the image that it is of, pixel by pixel, and below it the same legend.
Image map_over(const TileMaps& maps, const TileMap& map, const std::string& subtitle,
               const Image& image);

/// Names of the files that write_tile_maps() writes.
std::vector<std::string> tile_map_files();
/// tiles.exr with every map as a layer, and for each map a picture and an overlay.
void write_tile_maps(const RunResult& result, const OutputFolder& out);
/// The paths of the maps that a run replaces: those in `maps`, and those that an earlier run left
/// among its results in `out`.
std::vector<std::string> old_tile_maps(const OutputFolder& out,
                                       const std::optional<OutputFolder>& maps);

} // namespace degs::sim
