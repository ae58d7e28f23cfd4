// Takes the parts out of a mesh, changes them and puts them back, to reduce the draws of moving nodes.
#pragma once

#include <string_view>
#include <vector>

#include "app/cabin/stage/mesh_builder.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

struct MeshPart {
  MeshData mesh_data;
  int material = engine::kNone;
};

// Index of a node or material. Throw std::runtime_error with the name if the model lacks it.
int required_node(const engine::Model& model, std::string_view name);
int required_material(const engine::Model& model, std::string_view name);

std::vector<MeshPart> parts_of(const engine::Model& model, int node);

// The node's parts transformed by `placed`, which must be invertible.
std::vector<MeshPart> transformed_parts(const engine::Model& model, int node, const glm::mat4& placed);

// Gives the node a new mesh; parts with the same material are merged.
void set_parts(engine::Model& model, int node, const std::vector<MeshPart>& parts);

// Replaces one material of `node` by another that it already uses, which saves a draw.
void replace_material(engine::Model& model, std::string_view node, std::string_view from, std::string_view to);

// Moves the mesh of `from` into `into`, at the same place, which saves a draw per shared material. Throws
// std::runtime_error unless both have the same parent.
void merge_into(engine::Model& model, std::string_view from, std::string_view into);

// Moves the parts of `node` with that material to a new static node beside it.
void split_static_part(engine::Model& model, std::string_view node, std::string_view material);

// Adds a second node with the same mesh and returns it.
int add_twin(engine::Model& model, int node, std::string name, int parent);

}  // namespace gearshift::cabin
