/* A haptic device's bridge from the IDL alone, in C on Cyclone DDS: no line of Omentum is linked. A maker
 * replaces hand_step() by encoders and motors.
 *
 *   idlc -f case-sensitive -x final idl/common.idl && idlc -f case-sensitive -x final -I idl idl/tool.idl
 *   cc cyclone_bridge.c common.c tool.c -lddsc -lm -o cyclone_bridge
 *   cyclone_bridge DOMAIN          beside device_check, or `launch_scripts/run --device none --domain DOMAIN`
 */
#include "bridge_rules.h"
#include "tool.h"

#include <dds/dds.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

/* One machine: lo, told to use multicast; for several machines leave the interface to Cyclone. A bridge that
 * is killed is missed after the lease. */
static const char* const kConfiguration =
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
    "multicast=\"true\"/></Interfaces></General>"
    "<Discovery><LeaseDuration>2s</LeaseDuration><SPDPInterval>500ms</SPDPInterval></Discovery></Domain></"
    "CycloneDDS>";

static volatile sig_atomic_t running = 1;

static void stop(int number) {
  (void)number;
  running = 0;
}

static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "cyclone_bridge: %s: %s\n", what, dds_strretcode(entity));
  exit(2);
}

/* transport/topics.h has the quality of every topic */
static dds_qos_t* quality(bool durable) {
  dds_qos_t* qos = dds_create_qos();
  const dds_data_representation_id_t representation =
      DDS_DATA_REPRESENTATION_XCDR1; /* what Fast DDS 2.9 reads */
  dds_qset_data_representation(qos, 1, &representation);
  dds_qset_reliability(qos, durable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  dds_qset_durability(qos, durable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* message) {
  char name[64];
  snprintf(name, sizeof name, "omentum/%u/%s", omentum_msg_PROTOCOL_VERSION, message);
  return checked(dds_create_topic(participant, type, name, NULL, NULL), name);
}

static void take_answers(dds_entity_t forces, struct Bridge* bridge) {
  omentum_msg_ToolForce force;
  void* sample = &force;
  dds_sample_info_t info;
  while (dds_take(forces, &sample, &info, 1, 1) > 0) {
    if (!info.valid_data || force.tool != 0) continue;
    const struct Answer answer = {force.seq,           force.echo_seq,
                                  force.echo_stamp_ns, {force.force.x, force.force.y, force.force.z},
                                  force.valid_for_s,   force.state};
    bridge_take(bridge, &answer, now_ns());
  }
}

static void fill(omentum_msg_ToolPose* pose, const struct Hand* hand) {
  pose->valid = true;
  pose->position = (omentum_msg_Vec3){hand->at[0], hand->at[1], hand->at[2]};
  pose->linear_velocity = (omentum_msg_Vec3){hand->velocity[0], hand->velocity[1], hand->velocity[2]};
  pose->orientation = (omentum_msg_Quat){cos(hand->roll / 2), 0, 0, sin(hand->roll / 2)};
  pose->angular_velocity = (omentum_msg_Vec3){0, 0, hand->roll_speed};
}

int main(int argc, char** argv) {
  if (argc != 2) {
    fprintf(stderr, "usage: cyclone_bridge DOMAIN\n");
    return 2;
  }
  signal(SIGTERM, stop);
  signal(SIGINT, stop);
  const dds_domainid_t domain = (dds_domainid_t)atoi(argv[1]);
  checked(dds_create_domain(domain, kConfiguration), "domain");
  const dds_entity_t participant = checked(dds_create_participant(domain, NULL, NULL), "participant");
  dds_qos_t *read = quality(false), *written = quality(false), *kept = quality(true);
  dds_qset_deadline(written, DDS_MSECS(40));
  dds_qset_liveliness(written, DDS_LIVELINESS_AUTOMATIC, DDS_MSECS(100));
  const dds_entity_t poses =
      checked(dds_create_writer(participant, topic(participant, &omentum_msg_ToolPose_desc, "tool_pose"),
                                written, NULL),
              "poses");
  const dds_entity_t infos =
      checked(dds_create_writer(participant, topic(participant, &omentum_msg_DeviceInfo_desc, "device_info"),
                                kept, NULL),
              "info");
  const dds_entity_t forces =
      checked(dds_create_reader(participant, topic(participant, &omentum_msg_ToolForce_desc, "tool_force"),
                                read, NULL),
              "forces");

  const omentum_msg_DeviceInfo info = {.tool = 0,
                                       .name = "example in C",
                                       .max_force_n = kMaxForce_n,
                                       .max_torque_nm = 0.1,
                                       .max_stiffness_n_m = 2000,
                                       .workspace_min = {-0.2, -0.2, -0.1},
                                       .workspace_max = {0.2, 0.2, 0.3},
                                       .sensed_axes = 63,
                                       .actuated_axes = 7};
  checked(dds_write(infos, &info), "device_info");

  struct Bridge bridge = {.newest = {.seq = 0}};
  struct Hand hand = {.at = {-0.048, -0.015, 0.053}};
  omentum_msg_ToolPose pose = {.tool = 0};
  const int64_t begin = now_ns();
  for (int64_t tick = begin; running; tick += kPeriod_ns) {
    sleep_until_ns(tick);
    take_answers(forces, &bridge);
    pose.answer_seq = bridge_exert(&bridge, now_ns()); /* under it the hand comes to the pose below */
    hand_step(&hand, bridge.exerted, 1e-9 * (double)(tick - begin));
    fill(&pose, &hand);
    ++pose.seq;
    pose.stamp_ns = now_ns();
    bridge_sent(&bridge, pose.seq, pose.stamp_ns);
    dds_write(poses, &pose);
  }
  dds_delete_qos(read);
  dds_delete_qos(written);
  dds_delete_qos(kept);
  dds_delete(participant); /* "end": it leaves, and nothing is exerted any more */
  return 0;
}
