// Address sanitizer's options for every program that links the transport.

// Fast DDS 2.9.1 deletes the statistics part of each of its writers and readers through a base class without
// a virtual destructor. The check of sizes would end every program at that place, and nothing of ours relies
// on it.
// NOLINTBEGIN(readability-identifier-naming,bugprone-reserved-identifier): the sanitizer's own name
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "new_delete_type_mismatch=0";
}
// NOLINTEND(readability-identifier-naming,bugprone-reserved-identifier)
