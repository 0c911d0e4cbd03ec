#include "runtime/command_line.h"

#include "files/whole_file.h"
#include "runtime/processor.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <iostream>
#include <new>
#include <stdexcept>
#include <system_error>

namespace omentum::runtime {
namespace {

constexpr int kBadInput = 2;  // the exit code of every refused argument, scene, mesh or organ
constexpr int kMachineLacks = 3;

std::string on_one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int refuse(const std::string& name, const std::string& what, int code = kBadInput) {
  std::cerr << name << ": " << on_one_line(what) << std::endl;
  return code;
}

}  // namespace

using Option = CommandLine::Option;

Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}
Option& Option::between(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
Option& Option::between(double low, double high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
Option& Option::not_negative() {
  option_->check(CLI::NonNegativeNumber);
  return *this;
}
Option& Option::one_of(const std::vector<std::string>& words) {
  option_->check(CLI::IsMember(words));
  return *this;
}
Option& Option::writes_file() {
  option_->check([](const std::string& file) -> std::string {
    try {
      files::require_writable(file);
      return {};
    } catch (const std::exception& e) {
      return e.what();
    }
  });
  return *this;
}
Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}

CommandLine::CommandLine(const std::string& name, const std::string& description)
    : app_(std::make_unique<CLI::App>(description, name)) {}
CommandLine::~CommandLine() = default;

Option CommandLine::option(const std::string& name, std::string& value, const std::string& description) {
  return Option(app_->add_option(name, value, description));
}
Option CommandLine::option(const std::string& name, std::filesystem::path& value,
                           const std::string& description) {
  return Option(app_->add_option(name, value, description));
}
Option CommandLine::option(const std::string& name, int& value, const std::string& description) {
  return Option(app_->add_option(name, value, description));
}
Option CommandLine::option(const std::string& name, double& value, const std::string& description) {
  return Option(app_->add_option(name, value, description));
}
Option CommandLine::option(const std::string& name, Taker take, const std::string& description) {
  const auto use = [name, take = std::move(take)](const std::string& text) {
    if (const std::string wrong = take(text); !wrong.empty()) throw CLI::ValidationError(name, wrong);
  };
  return Option(app_->add_option_function<std::string>(name, use, description));
}
Option CommandLine::option(const std::string& name, std::vector<std::string>& values,
                           const std::string& description) {
  return Option(app_->add_option(name, values, description)
                    ->expected(1)
                    ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
}
Option CommandLine::flag(const std::string& name, bool& value, const std::string& description) {
  return Option(app_->add_flag(name, value, description));
}

void CommandLine::require_room() const {
  if (has_room(room_)) return;
  throw std::runtime_error("not enough memory or processes: it needs " + std::to_string(room_.threads) +
                           " threads and " + std::to_string(room_.bytes >> 20) +
                           " MiB of addresses (see ulimit -v, -u, and the limits of a container)");
}

int CommandLine::run(int argc, char** argv, const std::function<void()>& program) {
  const std::string name = std::filesystem::path(argc > 0 ? argv[0] : app_->get_name()).filename().string();
  try {
    require_processor();
    app_->parse(argc, argv);
    require_room();
    program();
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app_->exit(e);
    return refuse(name, std::string(e.what()) + " (see " + name + " --help)");
  } catch (const std::bad_alloc&) {
    return refuse(name, "not enough memory (see ulimit -v, and the limit of a container)");
  } catch (const std::system_error& e) {
    const bool no_thread = e.code() == std::errc::resource_unavailable_try_again;
    return refuse(
        name, no_thread ? "not enough memory or processes for another thread (see ulimit -v, -u)" : e.what());
  } catch (const MachineLacks& e) {
    return refuse(name, e.what(), kMachineLacks);
  } catch (const std::exception& e) {
    return refuse(name, e.what());
  }
}

}  // namespace omentum::runtime
