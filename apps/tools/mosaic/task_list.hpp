// SPDX-License-Identifier: Apache-2.0
// taskJson() and taskMakefile() write down the tasks of a mosaic for engines: each with the command
// that runs it, the tasks that it needs, and the files that it leaves.
#pragma once

#include <string>

#include "apps/tools/mosaic/work_folder.hpp"
#include "apps/tools/output/json.hpp"

namespace tetrakis::tools {

/// {"tasks": [{"id", "group", "command": [words], "needs": [ids], "outputs": [paths]}, ...]}
Json taskJson(const WorkFolder& folder);

/// Rules for make: `tetrakis mosaic tasks WORK --make | make -f - -j8`. Each part depends on those
/// that it needs; TETRAKIS is the program.
std::string taskMakefile(const WorkFolder& folder);

}  // namespace tetrakis::tools
