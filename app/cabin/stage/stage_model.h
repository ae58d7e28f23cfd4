// Makes all meshes and nodes of the stage from the files of assets/models and the parts made for the gate, merged into
// few draws.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cabin/stage/stage.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

// Throws GltfError (bad model file), std::runtime_error (a required node is missing).
engine::Model make_stage_model(const StageConfig& config, const std::filesystem::path& folder);

// Names of the nodes that are lit by the open sky: road, land, bodywork. All other nodes are inside the cabin.
std::vector<std::string> outdoor_names();

}  // namespace gearshift::cabin
