// How many threads OpenBLAS uses, for as long as a guard lives.
#pragma once

#include <string>

namespace omentum::physics {

/// Sets OpenBLAS's thread count for the whole process and restores it on destruction. Workers that share out
/// the work themselves set 1: nested threads only cost. Not to be nested across threads.
class BlasThreads {
 public:
  explicit BlasThreads(int threads);
  ~BlasThreads();
  BlasThreads(const BlasThreads&) = delete;
  BlasThreads& operator=(const BlasThreads&) = delete;

 private:
  int before_;
};

/// OpenBLAS's own description, e.g. "OpenBLAS 0.3.21 ... SkylakeX".
std::string blas_description();

/// Empty when the BLAS that CHOLMOD calls is OpenBLAS; else a warning that says which library serves and
/// what to install (the reference BLAS is 5-6 times slower).
std::string blas_warning();

}  // namespace omentum::physics
