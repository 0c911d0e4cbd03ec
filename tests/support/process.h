// Runs the project's programs as a user would: real processes, ended by signals.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace omentum::test {

/// A folder of this test's own, removed at its end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "omentum-test-XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// One program with its arguments, running until it ends or this object does. Its messages (stderr) are kept.
class Process {
 public:
  /// `program`: a name in the build's bin/, or a path.
  Process(const std::string& program, const std::vector<std::string>& arguments) {
    const std::string path = program.find('/') == std::string::npos ? OMENTUM_BIN_DIR "/" + program : program;
    std::vector<char*> argv{const_cast<char*>(path.c_str())};
    for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    const std::string out = (scratch_ / "out").string(), err = (scratch_ / "err").string();
    pid_ = fork();
    if (pid_ < 0) throw std::runtime_error("fork failed");
    if (pid_ == 0) {
      dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
      dup2(open(out.c_str(), O_WRONLY | O_CREAT, 0600), STDOUT_FILENO);
      dup2(open(err.c_str(), O_WRONLY | O_CREAT, 0600), STDERR_FILENO);
      execv(path.c_str(), argv.data());
      _exit(127);
    }
  }
  ~Process() { end(SIGKILL); }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool running() {
    if (pid_ > 0 && waitpid(pid_, &status_, WNOHANG) == pid_) pid_ = 0;
    return pid_ > 0;
  }
  /// Waits; the exit code, or minus the signal that ended it.
  int wait() {
    if (pid_ > 0) {
      waitpid(pid_, &status_, 0);
      pid_ = 0;
    }
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : -WTERMSIG(status_);
  }
  void send(int signal) {
    if (running()) kill(pid_, signal);
  }
  int end(int signal) {
    send(signal);
    return wait();
  }
  int terminate() { return end(SIGTERM); }
  std::string messages() const { return read_text(scratch_ / "err"); }
  std::string output() const { return read_text(scratch_ / "out"); }

 private:
  ScratchFolder scratch_;
  pid_t pid_ = 0;
  int status_ = 0;
};

/// Waits until the condition holds; false when it does not within a time that only a failure takes.
template <class Condition>
bool comes_true(Condition&& condition) {
  constexpr auto kPatience = std::chrono::seconds(30);
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

/// A DDS domain that no other test, session or clone on this machine uses for as long as this process lives:
/// its number is held as an abstract socket, by the launcher's rule (launch_scripts/launcher/domain.py). From
/// 100 downwards: the launcher comes from below, and beyond 100 a domain's ports lie among those that the
/// system gives to any program.
inline int domain_of_test() {
  constexpr int kLast = 100, kFirst = 1;
  for (int number = kLast; number >= kFirst; --number) {
    const int held = socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    const std::string name = std::string("omentum-domain-").append(std::to_string(number));
    sockaddr_un address{AF_UNIX, {}};  // the first byte stays zero: abstract
    name.copy(address.sun_path + 1, name.size());
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
    if (bind(held, reinterpret_cast<const sockaddr*>(&address), size) == 0) return number;
    close(held);
  }
  throw std::runtime_error("all DDS domains are in use");
}

}  // namespace omentum::test
