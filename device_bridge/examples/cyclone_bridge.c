/* A haptic device's bridge from the IDL alone, in C on Cyclone DDS: no line of Omentum is linked. It moves a
 * simulated hand; a maker replaces struct hand and hand_step() by encoders and motors.
 *
 *   idlc -f case-sensitive -x final idl/common.idl && idlc -f case-sensitive -x final idl/tool.idl
 *   cc cyclone_bridge.c common.c tool.c -lddsc -lm -o cyclone_bridge
 *   cyclone_bridge DOMAIN          with device_check, or `launch_scripts/run --device none --domain DOMAIN`
 *
 * docs/devices.md has the rules, by the names that stand here in comments. */
#include "tool.h"

#include <dds/dds.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
  PERIOD_NS = 1000000,
  SENT = 64,
  OLDEST_NS = 50000000,
  EXPIRES_NS = 20000000,
  DECAY_NS = 20000000,
  FADE_NS = 200000000
};
static const double max_force_n = 8, slew_n_s = 2000;
static volatile sig_atomic_t running = 1;

static void stop(int number) {
  (void)number;
  running = 0;
}

static int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

/* the newest answer that may be exerted, and what is left of it */
struct answer {
  omentum_msg_ToolForce force;
  int64_t came_ns, fading_since_ns;
  double exerted[3];
};

/* "echo_seq, echo_stamp_ns": only an answer to a pose of ours, of the last 50 ms, newer than the one before
 */
static void take(struct answer* answer, const omentum_msg_ToolForce* force, const int64_t* sent_ns,
                 int64_t now) {
  const bool ours =
      force->echo_stamp_ns == sent_ns[force->echo_seq % SENT] && now - force->echo_stamp_ns <= OLDEST_NS;
  const bool finite = isfinite(force->force.x) && isfinite(force->force.y) && isfinite(force->force.z);
  if (force->tool != 0 || !ours || !finite || force->seq <= answer->force.seq) return;
  if (answer->force.seq == 0 || now - answer->came_ns > EXPIRES_NS)
    answer->fading_since_ns = now; /* "after an expiry" */
  answer->force = *force;
  answer->came_ns = now;
}

/* "valid_for_s", "after an expiry", "limits", "jumps": what the motors exert now; the answer's number, or 0
 */
static uint64_t exert(struct answer* answer, int64_t now) {
  const int64_t over_ns = now - answer->came_ns - (int64_t)(1e9 * answer->force.valid_for_s);
  double share = answer->force.seq == 0 ? 0 : fmin(1, (double)(now - answer->fading_since_ns) / FADE_NS);
  if (over_ns > 0) share *= fmax(0, 1 - (double)over_ns / DECAY_NS);
  if (answer->force.state & (omentum_msg_FORCE_FAULT | omentum_msg_FORCE_PAUSED)) share = 0;
  const double wanted[3] = {share * answer->force.force.x, share * answer->force.force.y,
                            share * answer->force.force.z};
  const double size = sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1] + wanted[2] * wanted[2]);
  const double kept = size > max_force_n ? max_force_n / size : 1, step = slew_n_s * 1e-9 * PERIOD_NS;
  for (int i = 0; i < 3; ++i) {
    const double change = kept * wanted[i] - answer->exerted[i];
    answer->exerted[i] += share == 0 ? change : fmax(-step, fmin(step, change)); /* falls at once */
  }
  return share > 0 ? answer->force.seq : 0;
}

/* a mass of 0.2 kg on a spring and a damper, whose other end goes up and down above the liver's right lobe */
struct hand {
  double at[3], velocity[3];
};

static void hand_step(struct hand* hand, const double* force, double t) {
  const double middle[3] = {-0.048, -0.015, 0.038}, depth = 0.015, turns_s = 0.8, dt = 1e-9 * PERIOD_NS;
  for (int i = 0; i < 3; ++i) {
    const double target = middle[i] + (i == 2 ? depth * cos(turns_s * t) : 0),
                 target_speed = i == 2 ? -depth * turns_s * sin(turns_s * t) : 0;
    hand->velocity[i] +=
        dt / 0.2 * (400 * (target - hand->at[i]) + 12 * (target_speed - hand->velocity[i]) + force[i]);
    hand->at[i] += dt * hand->velocity[i];
  }
}

static dds_qos_t* quality(bool durable) {
  dds_qos_t* qos = dds_create_qos();
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1; /* what Fast DDS reads */
  dds_qset_data_representation(qos, 1, &representation);
  dds_qset_reliability(qos, durable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, DDS_MSECS(100));
  dds_qset_durability(qos, durable ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
  return qos;
}

/* a reader's or a writer's participant, topic and quality; DDS refuses in `checked` */
static dds_entity_t checked(dds_entity_t entity, const char* what) {
  if (entity >= 0) return entity;
  fprintf(stderr, "cyclone_bridge: %s: %s\n", what, dds_strretcode(entity));
  exit(2);
}

static dds_entity_t topic(dds_entity_t participant, const dds_topic_descriptor_t* type, const char* message) {
  char name[64];
  snprintf(name, sizeof name, "omentum/%u/%s", omentum_msg_PROTOCOL_VERSION, message);
  return checked(dds_create_topic(participant, type, name, NULL, NULL), name);
}

int main(int argc, char** argv) {
  if (argc != 2) return fprintf(stderr, "usage: cyclone_bridge DOMAIN\n"), 2;
  signal(SIGTERM, stop), signal(SIGINT, stop);
  /* one machine: lo, told to use multicast; for several machines leave the interface to Cyclone. A bridge
   * that is killed is missed after the lease. */
  const char* config =
      "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
      "multicast=\"true\"/></Interfaces>"
      "</General><Discovery><LeaseDuration>2s</LeaseDuration><SPDPInterval>500ms</SPDPInterval></Discovery>"
      "</Domain></CycloneDDS>";
  const dds_domainid_t domain = (dds_domainid_t)atoi(argv[1]);
  checked(dds_create_domain(domain, config), "domain");
  const dds_entity_t participant = checked(dds_create_participant(domain, NULL, NULL), "participant");
  dds_qos_t *newest = quality(false), *durable = quality(true);
  dds_qset_deadline(newest, DDS_MSECS(40)),
      dds_qset_liveliness(newest, DDS_LIVELINESS_AUTOMATIC, DDS_MSECS(100));
  const dds_entity_t poses =
      checked(dds_create_writer(participant, topic(participant, &omentum_msg_ToolPose_desc, "tool_pose"),
                                newest, NULL),
              "tool_pose");
  const dds_entity_t infos =
      checked(dds_create_writer(participant, topic(participant, &omentum_msg_DeviceInfo_desc, "device_info"),
                                durable, NULL),
              "device_info");
  dds_qos_t* reads = quality(false);
  const dds_entity_t forces =
      checked(dds_create_reader(participant, topic(participant, &omentum_msg_ToolForce_desc, "tool_force"),
                                reads, NULL),
              "tool_force");

  const omentum_msg_DeviceInfo info = {.tool = 0,
                                       .name = "example in C",
                                       .max_force_n = max_force_n,
                                       .max_torque_nm = 0.1,
                                       .max_stiffness_n_m = 2000,
                                       .workspace_min = {-0.2, -0.2, -0.1},
                                       .workspace_max = {0.2, 0.2, 0.3},
                                       .sensed_axes = 63,
                                       .actuated_axes = 7};
  dds_write(infos, &info);

  struct answer answer = {.force = {.seq = 0}};
  struct hand hand = {.at = {-0.048, -0.015, 0.053}};
  omentum_msg_ToolPose pose = {.tool = 0, .valid = true};
  int64_t sent_ns[SENT] = {0};
  for (int64_t begin = now_ns(), tick = begin; running; tick += PERIOD_NS) {
    const struct timespec next = {tick / 1000000000, tick % 1000000000};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &next, NULL);
    omentum_msg_ToolForce force;
    void* sample = &force;
    dds_sample_info_t sample_info;
    while (dds_take(forces, &sample, &sample_info, 1, 1) > 0)
      if (sample_info.valid_data) take(&answer, &force, sent_ns, now_ns());
    pose.answer_seq = exert(&answer, now_ns()); /* moved the hand until it is measured below */
    hand_step(&hand, answer.exerted, 1e-9 * (double)(tick - begin));
    const double roll = 0.3 * sin(1e-9 * (double)(tick - begin)),
                 roll_speed = 0.3 * cos(1e-9 * (double)(tick - begin));
    ++pose.seq, pose.stamp_ns = now_ns();
    pose.position = (omentum_msg_Vec3){hand.at[0], hand.at[1], hand.at[2]};
    pose.linear_velocity = (omentum_msg_Vec3){hand.velocity[0], hand.velocity[1], hand.velocity[2]};
    pose.orientation = (omentum_msg_Quat){cos(roll / 2), 0, 0, sin(roll / 2)}; /* about z of T and of W */
    pose.angular_velocity = (omentum_msg_Vec3){0, 0, roll_speed};
    sent_ns[pose.seq % SENT] = pose.stamp_ns;
    dds_write(poses, &pose);
  }
  memset(answer.exerted, 0, sizeof answer.exerted); /* "end": nothing is exerted any more */
  dds_delete_qos(newest), dds_delete_qos(durable), dds_delete_qos(reads);
  dds_delete(participant);
  return 0;
}
