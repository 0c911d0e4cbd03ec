#include "transport/cyclone/entities.h"

#include "transport/keystore.h"

#include <stdexcept>

namespace omentum::transport::cyclone {

namespace {

struct Plugin {
  std::string kind, library, action;
};

void load(dds_qos_t* qos, const Plugin& plugin) {
  const std::string library = "dds.sec." + plugin.kind + ".library.";
  dds_qset_prop(qos, (library + "path").c_str(), plugin.library.c_str());
  dds_qset_prop(qos, (library + "init").c_str(), ("init_" + plugin.action).c_str());
  dds_qset_prop(qos, (library + "finalize").c_str(), ("finalize_" + plugin.action).c_str());
}

void secure(dds_qos_t* qos, const Credentials& credentials) {
  load(qos, {"auth", "dds_security_auth", "authentication"});
  load(qos, {"access", "dds_security_ac", "access_control"});
  load(qos, {"crypto", "dds_security_crypto", "crypto"});
  const auto set_file = [&](const char* name, const std::filesystem::path& file) {
    dds_qset_prop(qos, name, ("file:" + file.string()).c_str());
  };
  set_file("dds.sec.auth.identity_ca", credentials.identity_authority);
  set_file("dds.sec.auth.identity_certificate", credentials.certificate);
  set_file("dds.sec.auth.private_key", credentials.key);
  set_file("dds.sec.access.permissions_ca", credentials.permissions_authority);
  set_file("dds.sec.access.governance", credentials.governance);
  set_file("dds.sec.access.permissions", credentials.permissions);
}

dds_entity_t create_participant(const BusOptions& options) {
  const Qos qos(dds_create_qos(), dds_delete_qos);
  dds_qset_entity_name(qos.get(), options.name.c_str());
  if (!options.keystore.empty())
    secure(qos.get(), find_credentials(options.keystore, Vendor::kCyclone, options.name));
  return checked(dds_create_participant(static_cast<dds_domainid_t>(options.domain), qos.get(), nullptr),
                 "a participant in domain " + std::to_string(options.domain));
}

dds_duration_t duration(std::chrono::milliseconds time) {
  return DDS_MSECS(time.count());
}

}  // namespace

Entities::Entities(const BusOptions& options) : domain(options), participant(create_participant(options)) {}

Entities::~Entities() {
  dds_delete(participant);
}

dds_entity_t Entities::topic(const TopicSpec& spec, const dds_topic_descriptor_t& type) const {
  return checked(dds_create_topic(participant, &type, spec.name, nullptr, nullptr),
                 std::string("the topic ") + spec.name);
}

namespace {

Qos common_qos(const TopicSpec& spec) {
  // a reliable writer waits at most this for room (never with keep last); also of no effect on readers
  constexpr dds_duration_t kMaxBlocking = DDS_MSECS(100);
  Qos qos(dds_create_qos(), dds_delete_qos);
  dds_qset_reliability(
      qos.get(),
      spec.reliability == Reliability::kReliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
      kMaxBlocking);
  dds_qset_durability(qos.get(), spec.durability == Durability::kTransientLocal
                                     ? DDS_DURABILITY_TRANSIENT_LOCAL
                                     : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, spec.depth);
  if (spec.durability == Durability::kTransientLocal)
    dds_qset_durability_service(qos.get(), 0, DDS_HISTORY_KEEP_LAST, spec.depth, DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  if (spec.liveliness_lease.count() > 0)
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_AUTOMATIC, duration(spec.liveliness_lease));
  // plain CDR, which Fast DDS 2.9 uses for every type
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &representation);
  return qos;
}

}  // namespace

Qos writer_qos(const TopicSpec& spec) {
  Qos qos = common_qos(spec);
  if (spec.deadline.count() > 0) dds_qset_deadline(qos.get(), duration(spec.deadline));
  return qos;
}

Qos reader_qos(const TopicSpec& spec) {
  Qos qos = common_qos(spec);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, spec.depth * spec.writers);
  return qos;
}

dds_entity_t checked(dds_entity_t entity, const std::string& what) {
  if (entity < 0) throw std::runtime_error("Cyclone DDS refused " + what + ": " + dds_strretcode(entity));
  return entity;
}

EndpointStatus writer_status(dds_entity_t writer) {
  EndpointStatus status;
  dds_publication_matched_status_t matched{};
  dds_get_publication_matched_status(writer, &matched);
  status.matched = static_cast<int>(matched.current_count);
  dds_offered_deadline_missed_status_t deadline{};
  dds_get_offered_deadline_missed_status(writer, &deadline);
  status.deadline_missed = deadline.total_count;
  dds_offered_incompatible_qos_status_t incompatible{};
  dds_get_offered_incompatible_qos_status(writer, &incompatible);
  status.incompatible_qos = incompatible.total_count;
  dds_liveliness_lost_status_t liveliness{};
  dds_get_liveliness_lost_status(writer, &liveliness);
  status.liveliness_lost = liveliness.total_count;
  return status;
}

EndpointStatus reader_status(dds_entity_t reader) {
  EndpointStatus status;
  dds_subscription_matched_status_t matched{};
  dds_get_subscription_matched_status(reader, &matched);
  status.matched = static_cast<int>(matched.current_count);
  dds_requested_incompatible_qos_status_t incompatible{};
  dds_get_requested_incompatible_qos_status(reader, &incompatible);
  status.incompatible_qos = incompatible.total_count;
  return status;
}

}  // namespace omentum::transport::cyclone
