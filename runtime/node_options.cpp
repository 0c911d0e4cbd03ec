#include "runtime/node_options.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

namespace omentum::runtime {
namespace {

constexpr int kBadInput = 2;  // the exit code of every refused argument, scene, mesh or organ

std::string on_one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int refuse(const std::string& name, const std::string& what) {
  std::cerr << name << ": " << on_one_line(what) << std::endl;
  return kBadInput;
}

}  // namespace

void add_node_options(CLI::App& app, NodeOptions& options) {
  app.add_option("--scene", options.scene, "scene file (TOML)")->required()->type_name("FILE");
  app.add_option("--organ", options.organ, "organ file instead of the scene's")->type_name("FILE");
  app.add_option("--dds", options.dds, "DDS vendor: fast or cyclone")
      ->check(CLI::IsMember({"fast", "cyclone"}))
      ->capture_default_str();
  app.add_option("--domain", options.domain, "DDS domain")->check(CLI::Range(0, 230))->capture_default_str();
  app.add_option("--profile", options.profile, "loopback (one machine) or lan")
      ->check(CLI::IsMember({"loopback", "lan"}))
      ->capture_default_str();
  app.add_option("--secure", options.keystore, "DDS Security key store")->type_name("KEYSTORE");
  app.add_option("--report", options.report, "write this node's numbers here at the end (JSON)")
      ->type_name("FILE");
  app.add_option("--log", options.log, "write every tick here (CSV)")->type_name("FILE");
}

int node_main(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
  const std::string name = std::filesystem::path(argc > 0 ? argv[0] : "omentum").filename().string();
  try {
    app.parse(argc, argv);
    run();
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    return refuse(name, std::string(e.what()) + " (see " + name + " --help)");
  } catch (const std::exception& e) {
    return refuse(name, e.what());
  }
}

}  // namespace omentum::runtime
