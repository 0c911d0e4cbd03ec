// A scene's file. What is read of it goes over the wire to the other machines: that works too.
#include "scene/scene.h"

#include "tests/fuzz/input_file.h"
#include "tests/fuzz/seed_files.h"

#include <stdexcept>

namespace omentum::fuzz {

void try_input(std::span<const std::uint8_t> input) {
  const InputFile file(text_of(input));
  try {
    scene::load_scene(file.path());
  } catch (const std::runtime_error& refusal) {
    check_refusal(refusal.what(), file.path());
  }
}

std::vector<std::string> seeds() {
  return read_inputs(OMENTUM_SOURCE_DIR "/scenes");
}

}  // namespace omentum::fuzz
