#include "benchmarks/child_run.h"

#include <chrono>
#include <stdexcept>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace omentum::bench {
namespace {

constexpr double kBytesPerKilobyte = 1024;  // ru_maxrss
constexpr int kNotFound = 127;              // as shells say it

}  // namespace

ChildRun run_child(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(program + ": no process can be started");
  if (child == 0) {
    dup2(open("/dev/null", O_WRONLY), STDOUT_FILENO);
    execv(program.c_str(), argv.data());
    _exit(kNotFound);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status), took.count(),
          kBytesPerKilobyte * static_cast<double>(usage.ru_maxrss)};
}

}  // namespace omentum::bench
