// A datagram's payload as Fast DDS' side decodes it (Cyclone DDS decodes with its own code, of which ours
// only copies what it has checked). The first byte chooses the topic, the second whether only its key is
// read.
#include "tests/fuzz/harness.h"
#include "tests/fuzz/topic_choice.h"
#include "transport/bounds.h"
#include "transport/fast/cdr.h"

namespace omentum::fuzz {

namespace {

template <class M>
std::vector<char> bytes_of(const M& message) {
  std::vector<char> bytes(transport::fast::encoded_bytes(message));
  if (transport::fast::encode(message, bytes.data(), bytes.size()) != bytes.size())
    broken("a decoded message has another size than is foreseen");
  return bytes;
}

template <class M>
void decode_and_encode(std::span<const std::uint8_t> payload, bool keys_only) {
  std::vector<char> bytes(payload.begin(), payload.end());
  M message;
  if (!transport::fast::decode(bytes.data(), bytes.size(), keys_only, message)) return;
  if (!transport::within_bounds(message)) broken("a decoded message is over the bounds of the IDL");
  std::vector<char> again = bytes_of(message);
  M twin;
  if (!transport::fast::decode(again.data(), again.size(), false, twin))
    broken("a message that was decoded and encoded is refused");
  if (bytes_of(twin) != again) broken("a message changes on its way through the wire");  // NaN == NaN, here
  transport::fast::key_hash(message);
}

}  // namespace

void try_input(std::span<const std::uint8_t> input) {
  if (input.size() < 2) return;
  with_topic(input[0], [&]<class M>(msg::MessageTag<M>) {
    decode_and_encode<M>(input.subspan(2), (input[1] & 1U) != 0);
  });
}

std::vector<std::string> seeds() {
  return encoded_topics([](char topic) { return std::string{topic, 0}; });
}

}  // namespace omentum::fuzz
