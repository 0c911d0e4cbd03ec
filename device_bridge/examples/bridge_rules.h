/* What a bridge owes between its topics and its motors (docs/devices.md, whose words stand in quotes here),
 * and the hand that both examples move. C and C++; no DDS. */
#pragma once

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <time.h>

enum { kPosesKept = 64, kNoForce = 32 + 64 }; /* FORCE_FAULT, FORCE_PAUSED */
static const int64_t kPeriod_ns = 1000000, kOldest_ns = 50000000, kExpiry_ns = 20000000, kDecay_ns = 20000000,
                     kFade_ns = 200000000;
static const double kMaxForce_n = 8, kSlew_n_s = 2000;

static inline int64_t now_ns(void) {
  struct timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * INT64_C(1000000000) + now.tv_nsec;
}

static inline void sleep_until_ns(int64_t time_ns) {
  const struct timespec at = {(time_t)(time_ns / 1000000000), (long)(time_ns % 1000000000)};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, NULL);
}

/* Of a ToolForce, what is exerted. */
struct Answer {
  uint64_t seq, echo_seq;
  int64_t echo_stamp_ns;
  double force[3], valid_for_s;
  uint32_t state;
};

/* All zero in the beginning. */
struct Bridge {
  int64_t sent_ns[kPosesKept]; /* the stamps of the newest poses, by number */
  struct Answer newest;        /* number 0: none came yet */
  int64_t came_ns, fading_since_ns;
  double exerted[3]; /* what the motors exert, N, in W */
};

static inline void bridge_sent(struct Bridge* bridge, uint64_t seq, int64_t stamp_ns) {
  bridge->sent_ns[seq % kPosesKept] = stamp_ns;
}

/* "echo_seq, echo_stamp_ns": an answer to a pose of ours, of the last 50 ms, newer than the one before. "Not
 * finite". */
static inline void bridge_take(struct Bridge* bridge, const struct Answer* answer, int64_t now) {
  const bool ours = answer->echo_stamp_ns == bridge->sent_ns[answer->echo_seq % kPosesKept] &&
                    now - answer->echo_stamp_ns <= kOldest_ns;
  if (!ours || answer->seq <= bridge->newest.seq) return;
  for (int i = 0; i < 3; ++i)
    if (!isfinite(answer->force[i])) return;
  /* "After an expiry", and after the first answer */
  if (bridge->newest.seq == 0 || now - bridge->came_ns > kExpiry_ns) bridge->fading_since_ns = now;
  bridge->newest = *answer;
  bridge->came_ns = now;
}

/* Once a period: "valid_for_s", "after an expiry", "state", "limits", "jumps". Sets what the motors exert;
 * the number of the answer that it is, or is left of: the next pose's answer_seq. */
static inline uint64_t bridge_exert(struct Bridge* bridge, int64_t now) {
  const struct Answer* newest = &bridge->newest;
  const int64_t over_ns = now - bridge->came_ns - (int64_t)(1e9 * newest->valid_for_s);
  double share = newest->seq == 0 ? 0 : fmin(1, (double)(now - bridge->fading_since_ns) / (double)kFade_ns);
  if (over_ns > 0) share *= fmax(0, 1 - (double)over_ns / (double)kDecay_ns);
  if (newest->state & kNoForce) share = 0;
  const double size = sqrt(newest->force[0] * newest->force[0] + newest->force[1] * newest->force[1] +
                           newest->force[2] * newest->force[2]);
  if (size * share > kMaxForce_n) share = kMaxForce_n / size;
  const double step = kSlew_n_s * 1e-9 * (double)kPeriod_ns;
  for (int i = 0; i < 3; ++i) {
    const double change = share * newest->force[i] - bridge->exerted[i];
    bridge->exerted[i] += share == 0 ? change : fmax(-step, fmin(step, change)); /* it may end at once */
  }
  return share > 0 ? newest->seq : 0;
}

/* A mass of 0.2 kg on a spring and a damper, whose other end goes up and down above the right lobe of
 * scenes/liver.toml, and which rolls to and fro about z. */
struct Hand {
  double at[3], velocity[3], roll, roll_speed;
};

static inline void hand_step(struct Hand* hand, const double* force, double t) {
  const double middle[3] = {-0.048, -0.015, 0.038}, depth_m = 0.015, rate = 0.8,
               dt = 1e-9 * (double)kPeriod_ns;
  const double mass_kg = 0.2, spring_n_m = 400, damper_n_s_m = 12, roll_rad = 0.3;
  for (int i = 0; i < 3; ++i) {
    const double target = middle[i] + (i == 2 ? depth_m * cos(rate * t) : 0);
    const double target_speed = i == 2 ? -depth_m * rate * sin(rate * t) : 0;
    const double pull =
        spring_n_m * (target - hand->at[i]) + damper_n_s_m * (target_speed - hand->velocity[i]);
    hand->velocity[i] += dt / mass_kg * (pull + force[i]);
    hand->at[i] += dt * hand->velocity[i];
  }
  hand->roll = roll_rad * sin(t);
  hand->roll_speed = roll_rad * cos(t);
}
