#include "organ_tools/fast_blas.h"

#include "physics/blas_kernels.h"
#include "physics/blas_memory.h"
#include "runtime/restart.h"

#include <cstdlib>
#include <iostream>

namespace omentum::organ_tools {
namespace {

constexpr int kExitRefused = 2;
constexpr const char* kAsked = "OPENBLAS_CORETYPE";
constexpr const char* kChose = "OMENTUM_BLAS_CHOSE";  // from the program to itself, started anew

}  // namespace

void start_with_fast_blas(char** argv) {
  if (std::getenv(kAsked) != nullptr) return;
  const std::string chose = physics::blas_core();
  const auto better = physics::better_blas_core(physics::vector_unit(), chose);
  if (!better) return;
  setenv(kChose, chose.c_str(), 1);
  runtime::restart_with(kAsked, *better, argv);
  unsetenv(kChose);  // still here
}

void require_blas_memory(const char* program, int callers) {
  if (physics::keep_blas_buffers(callers)) return;
  std::cerr << program << ": " << physics::kNoBlasMemory << std::endl;
  std::_Exit(kExitRefused);
}

void tell_fast_blas(const char* program) {
  const char* const chose = std::getenv(kChose);
  if (chose == nullptr) return;
  std::cerr << program << ": OpenBLAS does not know this processor and chose its " << chose
            << " kernels: started anew with " << kAsked << "=" << std::getenv(kAsked) << std::endl;
}

}  // namespace omentum::organ_tools
