// All meshes and nodes of the stage: the files of assets/models, what is made for the gate, few draws.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/stage/stage.h"
#include "engine/model/model.h"

namespace gearshift {

// Throws GltfError (a file), std::runtime_error (a node that the stage needs is missing).
Model make_stage_model(const StageConfig& config, const std::filesystem::path& folder);

// Nodes under the open sky: road, land, bodywork. All others stand in the cabin.
std::vector<std::string> outdoor_names();

}  // namespace gearshift
