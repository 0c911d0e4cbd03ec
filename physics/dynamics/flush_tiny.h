// No slow arithmetic on numbers that are nearly nothing.
#pragma once

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace omentum::physics {

/// While it lives, results and operands of this thread below the smallest normal number count as zero. What
/// swings out, and what lies far from all forces, comes to such numbers, and some processors take a hundred
/// times as long for them. Without SSE it does nothing.
class FlushTiny {
 public:
#ifdef __SSE__
  FlushTiny() noexcept : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | kFlushResults | kFlushOperands);
  }
  ~FlushTiny() {
    _mm_setcsr(before_);
  }
#else
  FlushTiny() noexcept {}
#endif
  FlushTiny(const FlushTiny&) = delete;
  FlushTiny& operator=(const FlushTiny&) = delete;

 private:
#ifdef __SSE__
  static constexpr unsigned kFlushResults = 0x8000, kFlushOperands = 0x0040;  // MXCSR: FTZ, DAZ
  unsigned before_;
#endif
};

}  // namespace omentum::physics
