// An organ file: what is read of it can be used, whoever wrote it.
#include "tests/fuzz/input_file.h"
#include "tests/organ/hostile_organ.h"
#include "tests/support/process.h"

namespace omentum::fuzz {

namespace {

struct Checks : organ::HostileOrganTest {
  void TestBody() override {}
  using HostileOrganTest::expect_all_in_range;
  using HostileOrganTest::file;
};

}  // namespace

void try_input(std::span<const std::uint8_t> input) {
  const InputFile file(text_of(input));
  try {
    Checks::expect_all_in_range(organ::load_organ(file.path(), organ::Load::kWithTensors));
    if (testing::Test::HasFailure()) broken("an index of an organ is out of range");
  } catch (const geometry::InputError& refusal) {
    check_refusal(refusal.what(), file.path());
  }
}

std::vector<std::string> seeds() {
  const Checks honest;
  const std::string seed = test::read_text(honest.file);
  try {
    organ::load_organ(InputFile(seed).path(), organ::Load::kWithTensors);
  } catch (const geometry::InputError& refusal) {
    broken(std::string("an honest file is refused, so that nothing else is tried: ") + refusal.what());
  }
  return {seed};
}

}  // namespace omentum::fuzz

// HDF5 1.10 itself leaves some kilobytes behind where it refuses what describes a damaged file's data; a
// program reads its organs once.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libhdf5_serial";
}
