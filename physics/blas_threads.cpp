#include "physics/blas_threads.h"

#include <cblas.h>
#include <dlfcn.h>

namespace omentum::physics {

BlasThreads::BlasThreads(int threads) : before_(openblas_get_num_threads()) {
  openblas_set_num_threads(threads);
}

BlasThreads::~BlasThreads() {
  openblas_set_num_threads(before_);
}

std::string blas_description() {
  return openblas_get_config();
}

std::string blas_warning() {
  // The symbol that CHOLMOD resolves at run time: the first dgemm_ in the process.
  Dl_info serving{};
  void* const symbol = dlsym(RTLD_DEFAULT, "dgemm_");
  if (symbol == nullptr || dladdr(symbol, &serving) == 0) return {};
  const std::string library = serving.dli_fname;
  if (library.find("openblas") != std::string::npos) return {};
  return "dense algebra is served by " + library +
         ", several times slower than OpenBLAS (Debian: apt install libopenblas0-pthread)";
}

}  // namespace omentum::physics
