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

// A new mesh for the node; pieces of one material become one.
void set_pieces(Model& model, int node, const std::vector<Piece>& pieces);

// What `node` shows in one material is shown in another from now on: a draw less.
void repaint(Model& model, std::string_view node, std::string_view from, std::string_view to);

// What `node` shows in that material goes to a new node beside it, which stands still as the file places it.
void leave_behind(Model& model, std::string_view node, std::string_view material);

// A second node for the same mesh. Returns it.
int add_twin(Model& model, int node, std::string name, int parent);

}  // namespace gearshift
