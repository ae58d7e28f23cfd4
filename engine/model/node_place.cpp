#include "engine/model/node_place.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "engine/model/gltf.h"

namespace gearshift {

namespace {

double largest(const glm::dmat4& matrix) {
  double most = 0.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) most = std::max(most, std::abs(matrix[column][row]));
  }
  return most;
}

bool is_finite(const glm::mat4& matrix) {
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(matrix[column][row])) return false;
    }
  }
  return true;
}

}  // namespace

bool place_by_matrix(const glm::dmat4& matrix, Node& node) {
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(0.0);
  for (int i = 0; i < 3; ++i) {
    scale[i] = glm::length(axes[i]);
    axes[i] = scale[i] > 0.0 ? axes[i] / scale[i] : glm::dvec3(glm::dmat3(1.0)[i]);
  }
  if (glm::determinant(axes) < 0.0) {  // a mirror: along x, which is as good as any
    scale.x = -scale.x;
    axes[0] = -axes[0];
  }
  node.translation = glm::vec3(matrix[3]);
  node.rotation = glm::quat(glm::normalize(glm::quat_cast(axes)));
  node.scale = glm::vec3(scale);
  // What the three cannot say shows when they are put together again; the bound is a float's precision and more.
  return largest(glm::dmat4(node.local()) - matrix) <= 1e-4 * std::max(1.0, largest(matrix));
}

bool drop_flat_meshes(Model& model) {
  const std::vector<glm::mat4> world = rest_pose(model);
  bool any = false;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!is_finite(world[i])) throw GltfError("its nodes stand beyond what a number can hold");
    if (model.nodes[i].mesh == kNone || model.nodes[i].skin != kNone) continue;
    if (std::isnormal(glm::determinant(glm::mat3(world[i])))) continue;
    model.nodes[i].mesh = kNone;
    any = true;
  }
  return any;
}

}  // namespace gearshift
