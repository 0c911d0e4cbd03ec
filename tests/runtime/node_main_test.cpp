#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::string kScene = OMENTUM_SOURCE_DIR "/scenes/liver.toml";

// The example as a child process whose standard output and error come through one pipe.
class Child {
 public:
  explicit Child(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), NODE_MAIN_EXAMPLE);
    std::vector<char*> argv;
    for (auto& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) std::abort();
    pid_ = fork();
    if (pid_ == 0) {
      dup2(ends[1], STDOUT_FILENO);
      dup2(ends[1], STDERR_FILENO);
      close(ends[0]);
      execv(argv[0], argv.data());
      _exit(127);
    }
    close(ends[1]);
    out_ = fdopen(ends[0], "r");
  }
  ~Child() { fclose(out_); }

  std::string line() {
    std::array<char, 4096> buffer{};
    return fgets(buffer.data(), buffer.size(), out_) != nullptr ? buffer.data() : "";
  }
  std::string rest() {
    std::string text;
    for (std::string next = line(); !next.empty(); next = line()) text += next;
    return text;
  }
  void send(int signal) const { kill(pid_, signal); }
  int exit_code() {
    int status = 0;
    waitpid(pid_, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  pid_t pid_;
  FILE* out_;
};

void expect_refused(const std::vector<std::string>& arguments, const std::string& says) {
  Child child(arguments);
  const std::string text = child.rest();
  EXPECT_EQ(child.exit_code(), 2) << text;
  EXPECT_THAT(text, StartsWith("node_main_example: "));
  EXPECT_THAT(text, HasSubstr(says));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(NodeMain, WrongArgumentsAreOneLineAndExitCodeTwo) {
  expect_refused({}, "--scene");
  expect_refused({"--scene", kScene, "--dds", "zenoh"}, "zenoh");
  expect_refused({"--scene", kScene, "--domain", "231"}, "231");
  expect_refused({"--scene", kScene, "--domain", "one"}, "one");
  expect_refused({"--scene", kScene, "--profile", "wan"}, "wan");
  expect_refused({"--scene", kScene, "--speed", "3"}, "--speed");
  expect_refused({"--scene"}, "--scene");
}

TEST(NodeMain, AMissingSceneIsOneLineAndExitCodeTwo) {
  expect_refused({"--scene", "/nonexistent/x.toml"}, "/nonexistent/x.toml");
}

TEST(NodeMain, HelpListsTheSharedOptionsAndSucceeds) {
  Child child({"--help"});
  const std::string text = child.rest();
  EXPECT_EQ(child.exit_code(), 0);
  for (const char* option : {"--scene", "--dds", "--domain", "--profile", "--secure", "--report", "--help"}) {
    EXPECT_THAT(text, HasSubstr(option));
  }
}

TEST(StopSignal, SigintAndSigtermEndCleanlyEvenTwice) {
  for (const int signal : {SIGINT, SIGTERM}) {
    Child child({"--scene", kScene});
    ASSERT_EQ(child.line(), "ready\n");
    child.send(signal);
    child.send(SIGTERM);
    EXPECT_EQ(child.rest(), "stopped\n");
    EXPECT_EQ(child.exit_code(), 0);
  }
}

}  // namespace
