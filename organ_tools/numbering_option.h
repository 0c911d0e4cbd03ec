// --numbering, of the programs that take or print node numbers.
#pragma once

#include "geometry/file_numbers.h"
#include "runtime/command_line.h"

namespace omentum::organ_tools {

/// Adds "--numbering file|position" to `line`; `numbering` holds the default and must outlive it.
void add_numbering_option(runtime::CommandLine& line, geometry::Numbering& numbering);

}  // namespace omentum::organ_tools
