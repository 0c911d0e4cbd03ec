#include "node_common/refusal.h"

#include <stdexcept>

namespace omentum::node {

void Refusal::because(std::string why) {
  {
    const std::lock_guard lock(mutex_);
    if (why_.empty()) why_ = std::move(why);
  }
  loop_.stop();
}

void Refusal::throw_if_any() const {
  const std::lock_guard lock(mutex_);
  if (!why_.empty()) throw std::runtime_error(why_);
}

}  // namespace omentum::node
