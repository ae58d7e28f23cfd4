// What a mesh is made of, taken out, changed and put back: fewer draws for pieces that move.
#pragma once

#include <string_view>
#include <vector>

#include "app/stage/patch.h"
#include "engine/model/model.h"

namespace gearshift {

struct Piece {
  Patch patch;
  int material = kNone;
};

// Index of a node or material. Throw std::runtime_error with the name where the model lacks it.
int needed_node(const Model& model, std::string_view name);
int needed_material(const Model& model, std::string_view name);

std::vector<Piece> pieces_of(const Model& model, int node);

// As they are where the node stands in `placed`, which has an inverse.
std::vector<Piece> placed_pieces(const Model& model, int node, const glm::mat4& placed);

// A new mesh for the node; pieces of one material become one.
void set_pieces(Model& model, int node, const std::vector<Piece>& pieces);

// What `node` shows in one material is shown in another from now on: a draw less.
void repaint(Model& model, std::string_view node, std::string_view from, std::string_view to);

// What `from` shows becomes part of `into`, at the same place: a draw less for each material that both have. Throws
// std::runtime_error where they have not the same parent.
void join_into(Model& model, std::string_view from, std::string_view into);

// What `node` shows in that material goes to a new node beside it, which stands still as the file places it.
void leave_behind(Model& model, std::string_view node, std::string_view material);

// A second node for the same mesh. Returns it.
int add_twin(Model& model, int node, std::string name, int parent);

}  // namespace gearshift
