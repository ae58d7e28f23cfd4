// Functions that split a mesh into parts, change them and put them back, to reduce the number of draws.
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

// These two functions return the index of the node or material with this name. They throw std::runtime_error with the
// name if the model has none.
int required_node(const engine::Model& model, std::string_view name);
int required_material(const engine::Model& model, std::string_view name);

std::vector<MeshPart> parts_of(const engine::Model& model, int node);

// Returns the node's parts, transformed by `placed`, which must be invertible.
std::vector<MeshPart> transformed_parts(const engine::Model& model, int node, const glm::mat4& placed);

// Gives the node a new mesh; parts with the same material are merged.
void set_parts(engine::Model& model, int node, const std::vector<MeshPart>& parts);

// Replaces one material of `node` by a material that the node already uses, which reduces the number of draws.
void replace_material(engine::Model& model, std::string_view node, std::string_view from, std::string_view to);

// Merges the mesh of node `from` into that of node `into` without moving it. This reduces the number of draws by one
// per material that the two meshes share. Throws std::runtime_error unless both nodes have the same parent.
void merge_into(engine::Model& model, std::string_view from, std::string_view into);

// Moves the parts of `node` that have this material to a new static node with the same parent.
void split_static_part(engine::Model& model, std::string_view node, std::string_view material);

// Adds a second node with the same mesh and returns its index.
int add_twin(engine::Model& model, int node, std::string name, int parent);

}  // namespace gearshift::cabin
