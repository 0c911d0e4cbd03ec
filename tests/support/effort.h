// How often a property is tried.
#pragma once

namespace omentum::test {

/// Trials, or seconds of a simulated hand: all of them, but an eighth in a program that a sanitizer watches.
/// It is up to twenty times as slow, and looks for mistakes in memory and threads, which the first trials
/// make as well as the last; the property itself is tried in full without it.
template <class T>
constexpr T tried(T full) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return full / 8;
#else
  return full;
#endif
}

}  // namespace omentum::test
