// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "scene/gltf/gltf_model.hpp"
#include "splat/transform/cloud_transform.hpp"

namespace degs {

/// A node of the scene with its way to the world: every parent applied.
struct PlacedNode {
    int node = 0;
    Affine global;
};

/// The nodes of the default scene (else of the first, else all that have no parent) and all below
/// them, parents first, children in the order of the file. InputError for indices out of range, a
/// node that is reached twice (a cycle, or two parents), and transforms of the wrong size, not
/// finite or not affine.
std::vector<PlacedNode> place_nodes(const GltfFile& file);

/// The transforms of the instances of a node with EXT_mesh_gpu_instancing, relative to the node;
/// one identity for a node without it.
std::vector<Affine> node_instances(const GltfFile& file, int node);

/// a after b.
Affine operator*(const Affine& a, const Affine& b);

/// "node 3 'name'".
std::string node_words(const GltfFile& file, int node);

} // namespace degs
