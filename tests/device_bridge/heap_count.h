// Counts what this program takes from the heap through operator new.
#pragma once

namespace omentum::test {

long heap_uses();

}  // namespace omentum::test
