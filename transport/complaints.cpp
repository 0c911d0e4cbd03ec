#include "transport/complaints.h"

#include "files/console.h"

#include <exception>
#include <functional>
#include <mutex>
#include <set>
#include <string>

namespace omentum::transport {

namespace {

struct Told {
  std::mutex mutex;
  std::set<std::string, std::less<>> kinds;
};

// Process-wide because stderr and the vendors' logs are. It never ends: their threads complain until the
// process is gone.
Told& told() {
  static Told& told = *new Told;
  return told;
}

bool is_first(std::string_view kind) {
  Told& all = told();
  const std::lock_guard lock(all.mutex);
  return all.kinds.find(kind) == all.kinds.end() && all.kinds.emplace(kind).second;
}

}  // namespace

bool tell_once(std::string_view who, std::string_view kind, std::string_view message) noexcept {
  try {
    if (!is_first(kind)) return false;
    files::say(std::string(who).append(": ").append(message));
    return true;
  } catch (const std::exception&) {
    return false;  // no memory to remember it by: better not told than told without end
  }
}

bool complain_once(std::string_view vendor, std::string_view kind, std::string_view message) noexcept {
  try {
    const std::string first_line(message.substr(0, message.find('\n')));
    return tell_once(vendor, std::string(vendor).append(" ").append(kind),
                     first_line + " (further ones are not told)");
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace omentum::transport
