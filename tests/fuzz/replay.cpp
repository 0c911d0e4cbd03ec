// The harness without libFuzzer: every seed, every file of the corpus, and so many spoilt copies of them,
// always the same ones.
//
//     fuzz_NAME CORPUS COUNT     | fuzz_NAME FILE ...   tries these files alone
#include "tests/fuzz/harness.h"
#include "tests/fuzz/seed_files.h"
#include "tests/fuzz/spoil.h"

#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include <unistd.h>

namespace {

using namespace omentum::fuzz;

std::string trying;  // what is tried right now, for who wants to know what broke it

void try_text(std::string input) {
  trying = std::move(input);
  // a copy of its own size, so that a sanitizer sees a read behind its end
  const std::vector<std::uint8_t> bytes(trying.begin(), trying.end());
  try_input(bytes);
}

// Abort and sanitizers end the program here: the input is left behind.
void leave_input() {
  std::ofstream("fuzz-broken-by", std::ios::binary) << trying;
  std::fputs("fuzz: the input that did it is in the file fuzz-broken-by\n", stderr);
}
extern "C" void on_abort(int) {
  leave_input();
  _exit(1);
}

void try_all(const char* corpus, std::uint64_t count) {
  std::vector<std::string> inputs = seeds();
  for (std::string& input : read_inputs(corpus)) inputs.push_back(std::move(input));
  for (const std::string& input : inputs) try_text(input);
  std::mt19937_64 random(1999);
  for (std::uint64_t i = 0; i < count; ++i) try_text(spoilt(inputs[i % inputs.size()], inputs, random));
  std::printf("%zu inputs and %llu spoilt ones: each was answered or refused\n", inputs.size(),
              static_cast<unsigned long long>(count));
}

}  // namespace

#if defined(__SANITIZE_ADDRESS__)
extern "C" void __sanitizer_set_death_callback(void (*callback)());
#endif

int main(int argc, char** argv) {
  std::signal(SIGABRT, on_abort);
#if defined(__SANITIZE_ADDRESS__)
  __sanitizer_set_death_callback(leave_input);
#endif
  std::uint64_t count = 0;
  const std::string_view last = argc == 3 ? argv[2] : "";
  if (std::from_chars(last.data(), last.data() + last.size(), count).ptr == last.data() + last.size() &&
      !last.empty()) {
    try_all(argv[1], count);
    return 0;
  }
  for (int i = 1; i < argc; ++i) {
    std::ifstream in(argv[i], std::ios::binary);
    try_text({std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()});
    std::printf("%s: answered or refused\n", argv[i]);
  }
}
