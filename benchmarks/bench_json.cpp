#include "benchmarks/bench_json.h"

#include "files/whole_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace omentum::bench {
namespace {

constexpr std::string_view kOption = "--json";
constexpr int kExitRefused = 2;

[[noreturn]] void refuse(const char* program) {
  std::fprintf(stderr, "%s: %s: found no file name, expected %s FILE\n", program, kOption.data(),
               kOption.data());
  std::exit(kExitRefused);
}

nlohmann::json to_json(const Entry& entry) {
  nlohmann::json object{{"name", entry.name}, {"value", entry.value}, {"unit", entry.unit}};
  if (entry.limit) object["limit"] = *entry.limit;
  if (entry.reference) object["reference"] = *entry.reference;
  if (entry.ratio) object["ratio"] = *entry.ratio;
  return object;
}

}  // namespace

Results::Results(int& argc, char** argv) {
  int kept = 0;
  for (int i = 0; i < argc; ++i) {
    const std::string_view word = argv[i];
    if (word == kOption) {
      file_ = i + 1 < argc ? argv[++i] : "";
    } else if (word.starts_with(kOption) && word.substr(kOption.size()).starts_with('=')) {
      file_ = word.substr(kOption.size() + 1);
    } else {
      argv[kept++] = argv[i];
      continue;
    }
    if (file_.empty()) refuse(argv[0]);
  }
  argc = kept;
  argv[argc] = nullptr;
}

Entry* Results::find(const std::string& name) {
  const auto found =
      std::find_if(entries_.begin(), entries_.end(), [&](const Entry& entry) { return entry.name == name; });
  return found == entries_.end() ? nullptr : &*found;
}

void Results::add(Entry entry) {
  if (Entry* const before = find(entry.name)) {
    *before = std::move(entry);
  } else {
    entries_.push_back(std::move(entry));
  }
}

void Results::compare(const std::string& name, const std::string& to) {
  Entry* const entry = find(name);
  const Entry* const reference = find(to);
  if (entry == nullptr || reference == nullptr || reference->value == 0) return;
  entry->reference = reference->value;
  entry->ratio = entry->value / reference->value;
}

void Results::limit(const std::string& name, double limit) {
  if (Entry* const entry = find(name)) entry->limit = limit;
}

void Results::write() const {
  if (file_.empty()) return;
  nlohmann::json list = nlohmann::json::array();
  for (const Entry& entry : entries_) list.push_back(to_json(entry));
  files::write_whole(file_, list.dump(2) + '\n');
}

}  // namespace omentum::bench
