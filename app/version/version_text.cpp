#include "app/version/version_text.h"

#include <fmt/format.h>

#include "app/program_name.h"
#include "app/version/build_facts.h"

namespace gearshift {

std::string version_text() {
  return fmt::format("{}\ncommit {}\n{} build by {}\nbuilt with {}", program_name(), kCommit, kBuildType, kCompiler,
                     kLibraries);
}

std::string commit_text() {
  return kCommit;
}

}  // namespace gearshift
