// Counts what a test program takes from the heap: link heap_count.cpp, which replaces operator new.
#pragma once

#include <cstddef>

namespace omentum::test {

/// Calls of operator new, in all its forms, by this thread so far.
std::size_t heap_allocations();

}  // namespace omentum::test
