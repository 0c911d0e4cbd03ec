// What a durable writer has to say to whoever comes.
#pragma once

#include "transport/fast/cdr.h"
#include "transport/topics.h"

#include <map>

namespace omentum::transport::fast {

/// Whether late joiners get the topic's newest samples.
template <class M>
inline constexpr bool kDurable = kTopicSpec<M>.durability == Durability::kTransientLocal;

/// The newest sample of each key. One thread at a time.
template <class M>
class NewestByKey {
  static_assert(!kDurable<M> || kTopicSpec<M>.depth == 1, "what is kept is the newest sample");

 public:
  void keep(const M& sample) { newest_[key_hash(sample)] = sample; }

  template <class Say>
  void for_each(Say&& say) const {
    for (const auto& [key, sample] : newest_) say(sample);
  }

 private:
  std::map<KeyHash, M> newest_;
};

}  // namespace omentum::transport::fast
