// Whether this machine's processor has the instructions that the program was built for.
#pragma once

#include <functional>
#include <span>
#include <string>

namespace omentum::runtime {

/// Those of `needed` that `has` denies, separated by commas.
std::string missing(std::span<const char* const> needed, const std::function<bool(const std::string&)>& has);

/// Whether the processor, and the system with it, has an instruction set, by its name in built_for.h; false
/// for a name that is none of them.
bool processor_has(const std::string& name);

/// Throws MachineLacks with what to do where the processor lacks what the kernels of this build use: they
/// would end the program by SIGILL at some tick.
void require_processor();

}  // namespace omentum::runtime
