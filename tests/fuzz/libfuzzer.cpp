// The harness as libFuzzer calls it (https://llvm.org/docs/LibFuzzer.html). "--seeds=FOLDER" writes the seeds
// there and ends.
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_files.h"

#include <cstdlib>

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view kOption = "--seeds=";
  for (int i = 1; i < *argc; ++i) {
    if (const std::string_view argument = (*argv)[i]; argument.starts_with(kOption)) {
      omentum::fuzz::write_seeds(argument.substr(kOption.size()));
      std::exit(0);
    }
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  omentum::fuzz::try_input({data, size});
  return 0;
}
