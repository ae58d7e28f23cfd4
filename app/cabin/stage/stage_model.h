// Builds the meshes and nodes of the stage from the files in assets/models and from parts generated for the gate.
// Merges them, so that few draw calls are needed.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cabin/stage/stage.h"
#include "engine/model/model.h"

namespace gearshift::cabin {

// Throws GltfError if a model file is invalid, std::runtime_error if a required node is missing.
engine::Model make_stage_model(const StageConfig& config, const std::filesystem::path& folder);

// Names of the nodes that are lit by the open sky: road, land, bodywork. All other nodes are inside the cabin.
std::vector<std::string> outdoor_names();

}  // namespace gearshift::cabin
