// The command line of a program.
#pragma once

#include "runtime/room.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace omentum::runtime {

/// What this machine has not: nothing that was asked for is wrong, and others can do without the program.
class MachineLacks : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Options, positional arguments and --help of one program; "name" is an argument, "--name" an option,
/// "-o,--output" two names of one. Values are written by run(), so they must outlive it. CLI11 does the work,
/// and command_line.cpp alone includes it: it would cost every program six seconds of compiling. One thread.
class CommandLine {
 public:
  /// What has been said of an option so far; each call says more.
  class Option {
   public:
    explicit Option(CLI::Option* option) : option_(option) {}
    Option& required();
    Option& type_name(const std::string& name);  // as --help shows its value: FILE
    Option& between(int low, int high);          // ends included
    Option& between(double low, double high);
    Option& not_negative();
    Option& one_of(const std::vector<std::string>& words);
    Option& writes_file();   // refused at the start where it could not be written
    Option& show_default();  // the value that the variable has by now

   private:
    CLI::Option* option_;
  };

  /// Uses an option's text; returns what is wrong with it, or nothing.
  using Taker = std::function<std::string(const std::string& text)>;

  CommandLine(const std::string& name, const std::string& description);
  ~CommandLine();

  Option option(const std::string& name, std::string& value, const std::string& description);
  Option option(const std::string& name, std::filesystem::path& value, const std::string& description);
  Option option(const std::string& name, int& value, const std::string& description);
  Option option(const std::string& name, double& value, const std::string& description);
  Option option(const std::string& name, Taker take, const std::string& description);
  /// May be given several times, one value each.
  Option option(const std::string& name, std::vector<std::string>& values, const std::string& description);
  Option flag(const std::string& name, bool& value, const std::string& description);

  /// Refuses to start, by run(), where the system does not give `room`: of several calls the last one's.
  void needs(const Room& room) { room_ = room; }

  /// Parses, calls `program`, and turns what happens into an exit code: 0 after program() returns, and for
  /// --help; 2 with one line "NAME: what and where" on stderr for a wrong argument or any std::exception, but
  /// 3 for MachineLacks, also of the processor (processor.h).
  int run(int argc, char** argv, const std::function<void()>& program);

 private:
  void require_room() const;

  std::unique_ptr<CLI::App> app_;
  Room room_;
};

}  // namespace omentum::runtime
