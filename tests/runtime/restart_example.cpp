// Starts itself anew with a variable set, and says what came of it.
#include "runtime/restart.h"

#include <cstdlib>
#include <iostream>

int main(int argc, char** argv) {
  std::cout << "begins" << std::endl;
  omentum::runtime::restart_with("OMENTUM_RESTART_TEST", "anew", argv);
  std::cout << argc << " words, the last one " << argv[argc - 1] << ": "
            << std::getenv("OMENTUM_RESTART_TEST") << std::endl;
}
