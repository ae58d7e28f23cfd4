// Combines models into one, and merges static meshes to reduce draw calls.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift::engine {

// Appends `part` to `whole` with all its nodes; its root nodes become children of `parent` (kNone: roots). Returns the
// index of its first node.
int append_model(Model& whole, const Model& part, int parent = kNone);

// Merges everything static: every mesh whose node is not named in `moving`, not a descendant of such a node and not
// skinned becomes part of a mesh at a new root node "Static", with one primitive per material. Its nodes stay, without
// a mesh. Names must match completely: a node whose name merely ends in one of `moving` does not count. Throws
// std::invalid_argument with the name if there is no such node.
Model merge_static(const Model& model, std::span<const std::string_view> moving);

// Number of draws in one frame: the primitives of all nodes that carry a mesh.
int draw_count(const Model& model);

}  // namespace gearshift::engine
