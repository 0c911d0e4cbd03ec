// A program that needs a variable which only counts before its libraries are loaded.
#pragma once

#include <string>

namespace omentum::runtime {

/// Starts this program anew, in this process, with the same arguments and `name`=`value` in its environment.
/// Returns only when it does not: the variable is set already (a person's own value stands, and there is no
/// second restart), or the system refuses; errno says why in that case. To be called first in main: whatever
/// was begun is lost.
void restart_with(const std::string& name, const std::string& value, char** argv);

}  // namespace omentum::runtime
