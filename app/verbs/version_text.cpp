#include "app/verbs/version_text.h"

#include <fmt/format.h>

#include "app/base/program_name.h"
#include "app/verbs/build_facts.h"

namespace gearshift::verbs {

std::string version_text() {
  return fmt::format("{}\ncommit {}\n{} build by {}\nbuilt with {}", base::program_name(), kCommit, kBuildType,
                     kCompiler, kLibraries);
}

std::string commit_text() {
  return kCommit;
}

}  // namespace gearshift::verbs
