// Prints samples of topics that it has no definition of: names, types and bounds come from the wire alone, as
// recorders and spies get them (OMG DDS-XTypes 1.3, TypeInformation and TypeLookup). Plain Cyclone DDS; no
// line of ours, nor of what idlc makes of idl/.
//   transport_type_spy DOMAIN TOPIC...      "FIELD = VALUE" for each number and text of one sample of each
#include <dds/dds.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_typelib.h>
#include <dds/ddsi/ddsi_xt_typeinfo.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr dds_duration_t kPatience = DDS_SECS(20), kPause = DDS_MSECS(5);

/// Reads plain CDR of this machine's byte order.
class CdrCursor {
 public:
  explicit CdrCursor(std::vector<unsigned char> sample) : sample_(std::move(sample)) {
    constexpr unsigned char kPlainLittleEndian[] = {0, 1};
    if (sample_.size() < kHeader || !std::equal(kPlainLittleEndian, kPlainLittleEndian + 2, sample_.begin()))
      throw std::runtime_error("a sample that is no plain CDR, little endian");
  }

  template <class T>
  T take() {
    at_ = (at_ - kHeader + sizeof(T) - 1) / sizeof(T) * sizeof(T) + kHeader;
    T value;
    std::memcpy(&value, take_bytes(sizeof(T)), sizeof(T));
    return value;
  }
  std::string take_text() {
    const auto letters = take<std::uint32_t>();  // with a zero behind
    return {take_bytes(letters), letters - 1};
  }
  /// Up to three bytes behind the last field are padding.
  bool at_end() const { return at_ <= sample_.size() && sample_.size() - at_ < kHeader; }

 private:
  static constexpr std::size_t kHeader = 4;

  const char* take_bytes(std::size_t count) {
    if (count > sample_.size() - std::min(at_, sample_.size()))
      throw std::runtime_error("a sample shorter than its type");
    at_ += count;
    return reinterpret_cast<const char*>(sample_.data()) + at_ - count;
  }

  std::vector<unsigned char> sample_;
  std::size_t at_ = kHeader;
};

using TypeId = DDS_XTypes_TypeIdentifier;

/// Goes through a sample along its type; structs that it does not know it asks the network for.
class Printer {
 public:
  Printer(dds_entity_t participant, CdrCursor& cdr) : participant_(participant), cdr_(cdr) {}

  void print(const std::string& name, const TypeId& type) {
    switch (type._d) {
      case DDS_XTypes_TK_BOOLEAN:
        std::printf("%s = %s\n", name.c_str(), cdr_.take<std::uint8_t>() ? "true" : "false");
        break;
      case DDS_XTypes_TK_BYTE:
        return print_number<std::uint8_t>(name);
      case DDS_XTypes_TK_INT32:
        return print_number<std::int32_t>(name);
      case DDS_XTypes_TK_UINT32:
        return print_number<std::uint32_t>(name);
      case DDS_XTypes_TK_INT64:
        return print_number<std::int64_t>(name);
      case DDS_XTypes_TK_UINT64:
        return print_number<std::uint64_t>(name);
      case DDS_XTypes_TK_FLOAT32:
        std::printf("%s = %.9g\n", name.c_str(), cdr_.take<float>());
        break;
      case DDS_XTypes_TK_FLOAT64:
        std::printf("%s = %.17g\n", name.c_str(), cdr_.take<double>());
        break;
      case DDS_XTypes_TI_STRING8_SMALL:
      case DDS_XTypes_TI_STRING8_LARGE:
        std::printf("%s = \"%s\"\n", name.c_str(), cdr_.take_text().c_str());
        break;
      case DDS_XTypes_TI_PLAIN_SEQUENCE_SMALL:
        return print_sequence(name, *type._u.seq_sdefn.element_identifier);
      case DDS_XTypes_TI_PLAIN_SEQUENCE_LARGE:
        return print_sequence(name, *type._u.seq_ldefn.element_identifier);
      case DDS_XTypes_EK_COMPLETE:
        return print_struct(name, type);
      default:
        throw std::runtime_error(name + " has a type of kind " + std::to_string(type._d));
    }
  }

 private:
  template <class T>
  void print_number(const std::string& name) {
    std::printf("%s = %s\n", name.c_str(), std::to_string(cdr_.take<T>()).c_str());
  }

  void print_sequence(const std::string& name, const TypeId& element) {
    const auto length = cdr_.take<std::uint32_t>();
    std::printf("%s has %u\n", name.c_str(), length);
    for (std::uint32_t i = 0; i < length; ++i) print(name + "[" + std::to_string(i) + "]", element);
  }

  void print_struct(const std::string& name, const TypeId& type) {
    dds_typeobj_t* object = nullptr;
    if (dds_get_typeobj(participant_, reinterpret_cast<const dds_typeid_t*>(&type), kPatience, &object) !=
        DDS_RETCODE_OK)
      throw std::runtime_error("nobody tells the type of " + (name.empty() ? "the sample" : name));
    const std::unique_ptr<dds_typeobj_t, dds_return_t (*)(dds_typeobj_t*)> owner(object, dds_free_typeobj);
    const auto& complete = reinterpret_cast<const DDS_XTypes_TypeObject*>(object)->_u.complete;
    if (complete._d != DDS_XTypes_TK_STRUCTURE) throw std::runtime_error(name + " is no struct");
    const auto& members = complete._u.struct_type.member_seq;
    for (std::uint32_t i = 0; i < members._length; ++i) {
      const DDS_XTypes_CompleteStructMember& member = members._buffer[i];
      print(name + (name.empty() ? "" : ".") + member.detail.name, member.common.member_type_id);
    }
  }

  dds_entity_t participant_;
  CdrCursor& cdr_;
};

dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity < 0) throw std::runtime_error(std::string(what) + ": " + dds_strretcode(entity));
  return entity;
}

template <class Look>
auto wait_for(Look&& look, const std::string& what) {
  const dds_time_t end = dds_time() + kPatience;
  while (dds_time() < end) {
    if (auto found = look()) return found;
    dds_sleepfor(kPause);
  }
  throw std::runtime_error("no " + what);
}

/// What the first writer or reader that tells it announces the topic's type to be.
class TypeOfTopic {
 public:
  TypeOfTopic(dds_entity_t participant, const char* topic) {
    const dds_entity_t announcements[] = {announced(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION),
                                          announced(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION)};
    wait_for([&] { return find(announcements[0], topic) || find(announcements[1], topic); },
             std::string("writer or reader tells the type of ") + topic);
  }
  ~TypeOfTopic() { dds_free_typeinfo(info_); }
  TypeOfTopic(const TypeOfTopic&) = delete;
  TypeOfTopic& operator=(const TypeOfTopic&) = delete;

  const dds_typeinfo_t* info() const { return info_; }
  const TypeId& id() const { return *reinterpret_cast<const TypeId*>(ddsi_typeinfo_complete_typeid(info_)); }

 private:
  static dds_entity_t announced(dds_entity_t participant, dds_entity_t topic) {
    return checked(dds_create_reader(participant, topic, nullptr, nullptr), "announcements");
  }

  bool find(dds_entity_t announcements, const char* topic) {
    void* loan = nullptr;
    dds_sample_info_t seen;
    while (!info_ && dds_read_mask(announcements, &loan, &seen, 1, 1, DDS_NOT_READ_SAMPLE_STATE) > 0) {
      auto* end = static_cast<dds_builtintopic_endpoint_t*>(loan);
      const dds_typeinfo_t* announced = nullptr;
      if (seen.valid_data && std::strcmp(end->topic_name, topic) == 0 &&
          dds_builtintopic_get_endpoint_type_info(end, &announced) == DDS_RETCODE_OK && announced)
        info_ = ddsi_typeinfo_dup(announced);
      dds_return_loan(announcements, &loan, 1);
      loan = nullptr;
    }
    return info_;
  }

  dds_typeinfo_t* info_ = nullptr;
};

std::vector<unsigned char> next_sample(dds_entity_t reader, const std::string& what) {
  ddsi_serdata* taken = nullptr;
  dds_sample_info_t info;
  wait_for(
      [&] {
        if (dds_takecdr(reader, &taken, 1, &info, DDS_ANY_STATE) < 1) return false;
        if (!info.valid_data) ddsi_serdata_unref(taken);
        return info.valid_data;
      },
      "sample of " + what);
  std::vector<unsigned char> bytes(ddsi_serdata_size(taken));
  ddsi_serdata_to_ser(taken, 0, bytes.size(), bytes.data());
  ddsi_serdata_unref(taken);
  return bytes;
}

void print_one(dds_entity_t participant, const char* name) {
  const TypeOfTopic type(participant, name);
  dds_topic_descriptor_t* descriptor = nullptr;
  checked(
      dds_create_topic_descriptor(DDS_FIND_SCOPE_GLOBAL, participant, type.info(), kPatience, &descriptor),
      "nobody tells its type");
  const dds_entity_t topic = checked(dds_create_topic(participant, descriptor, name, nullptr, nullptr), name);
  dds_delete_topic_descriptor(descriptor);
  CdrCursor cdr(next_sample(checked(dds_create_reader(participant, topic, nullptr, nullptr), name), name));
  std::printf("topic %s\n", name);
  Printer(participant, cdr).print("", type.id());
  if (!cdr.at_end()) throw std::runtime_error(std::string(name) + ": a sample longer than its type");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 3) throw std::runtime_error("usage: transport_type_spy DOMAIN TOPIC...");
  const auto domain = static_cast<dds_domainid_t>(std::atoi(argv[1]));
  checked(dds_create_domain(domain,
                            "<CycloneDDS><Domain Id=\"any\"><General><Interfaces>"
                            "<NetworkInterface name=\"lo\" multicast=\"true\"/></Interfaces></General>"
                            "</Domain></CycloneDDS>"),
          "a domain");
  const dds_entity_t participant = checked(dds_create_participant(domain, nullptr, nullptr), "a participant");
  for (int i = 2; i < argc; ++i) print_one(participant, argv[i]);
  dds_delete(DDS_CYCLONEDDS_HANDLE);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "transport_type_spy: %s\n", error.what());
  return 1;
}
