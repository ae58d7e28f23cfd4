// Combines models into one, and merges static meshes to reduce draw calls.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift::engine {

// Appends `part` with all its nodes to `target`. The root nodes of `part` become children of `parent` (kNone: they stay
// roots). Returns the index that the first node of `part` has in `target`.
int append_model(Model& target, const Model& part, int parent = kNone);

// Merges all static meshes into one mesh at a new root node "Static", with one primitive per material. A mesh is not
// static if it is skinned, or if its node or an ancestor of the node is named in `moving`. The nodes of merged meshes
// remain, without a mesh. Throws std::invalid_argument if no node has a name in `moving`.
Model merge_static(const Model& model, std::span<const std::string_view> moving);

// Number of draws in one frame: the primitives of all nodes that carry a mesh.
int draw_count(const Model& model);

}  // namespace gearshift::engine
