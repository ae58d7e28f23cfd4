#include "engine/model/node_transform.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include "engine/model/gltf.h"

namespace gearshift::engine {

namespace {

double max_abs_entry(const glm::dmat4& matrix) {
  double max = 0.0;
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) max = std::max(max, std::abs(matrix[column][row]));
  }
  return max;
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

bool set_node_transform(const glm::dmat4& matrix, Node& node) {
  glm::dmat3 axes(matrix);
  glm::dvec3 scale(0.0);
  for (int i = 0; i < 3; ++i) {
    scale[i] = glm::length(axes[i]);
    axes[i] = scale[i] > 0.0 ? axes[i] / scale[i] : glm::dvec3(glm::dmat3(1.0)[i]);
  }
  if (glm::determinant(axes) < 0.0) {  // the matrix mirrors: flip x (any axis would do)
    scale.x = -scale.x;
    axes[0] = -axes[0];
  }
  node.translation = glm::vec3(matrix[3]);
  node.rotation = glm::quat(glm::normalize(glm::quat_cast(axes)));
  node.scale = glm::vec3(scale);
  // Shear cannot be represented by translation, rotation and scale. So a matrix composed again from them differs if
  // there was shear. The tolerance allows for float precision.
  return max_abs_entry(glm::dmat4(node.local()) - matrix) <= 1e-4 * std::max(1.0, max_abs_entry(matrix));
}

bool drop_flat_meshes(Model& model) {
  const std::vector<glm::mat4> world = rest_pose(model);
  bool any = false;
  for (std::size_t i = 0; i < world.size(); ++i) {
    if (!is_finite(world[i])) throw GltfError("the node positions are out of range");
    if (model.nodes[i].mesh == kNone || model.nodes[i].skin != kNone) continue;
    if (std::isnormal(glm::determinant(glm::mat3(world[i])))) continue;
    model.nodes[i].mesh = kNone;
    any = true;
  }
  return any;
}

}  // namespace gearshift::engine
