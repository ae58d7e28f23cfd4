// One model out of several, and few draws out of many.
#pragma once

#include <span>
#include <string_view>

#include "engine/model/model.h"

namespace gearshift {

// Appends `part` to `whole` with all its nodes; its root nodes become children of `parent` (kNone: roots). Returns the
// index of its first node.
int append_model(Model& whole, const Model& part, int parent = kNone);

// Joins all that never moves: every mesh of a node that is neither named in `moving`, nor a descendant of one, nor
// skinned, becomes part of one mesh per material at a new root node "Static"; the nodes stay, without a mesh. A node
// whose name ends in one of `moving` after a prefix is not meant: names are whole. Unknown names throw
// std::invalid_argument with the name.
Model merge_static(const Model& model, std::span<const std::string_view> moving);

// Draws of one frame: primitives over the nodes that carry a mesh.
int draw_count(const Model& model);

}  // namespace gearshift
