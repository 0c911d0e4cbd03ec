// Counts what a test program takes from the heap.
#pragma once

#include <cstddef>

namespace omentum::deform_test {

/// Calls of operator new by this thread so far.
std::size_t allocations();

}  // namespace omentum::deform_test
