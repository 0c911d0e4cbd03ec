// The step takes nothing from the heap: proved by counting every way to ask for memory.
#include "haptic_fixtures.h"
#include "haptic_node/contact_message.h"
#include "haptic_node/local_body.h"
#include "haptic_node/tool_line.h"
#include "tests/support/organ_patch.h"

#include <cerrno>
#include <cstddef>

namespace {
thread_local bool counting = false;
thread_local std::size_t count = 0;
inline void note() {
  if (counting) ++count;
}
}  // namespace

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
#define OMENTUM_COUNTS_MALLOC
// glibc's own entries behind the public names
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);

void* malloc(std::size_t size) {
  note();
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  note();
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t size) {
  note();
  return __libc_realloc(p, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  note();
  return __libc_memalign(alignment, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  note();
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** p, std::size_t alignment, std::size_t size) {
  note();
  *p = __libc_memalign(alignment, size);
  return *p ? 0 : ENOMEM;
}
void free(void* p) {
  __libc_free(p);
}
}
#endif

namespace omentum::haptic_test {
namespace {

/// What a block of code asked for.
template <class Work>
std::size_t allocations_of(Work&& work) {
  count = 0;
  counting = true;
  work();
  counting = false;
  return count;
}

void expect_no_allocation(double friction, haptic::ContactMode mode) {
#ifndef OMENTUM_COUNTS_MALLOC
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
  haptic::ToolModel grasper = round_tool();
  grasper.grasps = true;
  haptic::HapticModel model = make_model(block(), {round_tool(), grasper}, friction);
  model.mode = mode;
  Bench bench(std::move(model));
  runtime::FaultList faults;
  haptic::ToolLine line(0, {}, faults);
  msg::Contact message = haptic::make_contact_message(0, 0);
  haptic::ToolInput unused;
  int changes = 0, contacts = -1;
  const std::size_t asked = allocations_of([&] {
    for (int i = 0; i < 5000; ++i) {
      const double t = 1e-3 * i;
      // pressing, sliding, lifting off, a grasp now and then, relocations, two tools over one another's place
      const Vec3 a(0.05 + 0.03 * std::sin(3 * t), 0.05 + 0.03 * std::cos(2 * t),
                   0.038 + 0.006 * std::sin(11 * t));
      const Vec3 b(0.05 - 0.03 * std::sin(2 * t), 0.05 + 0.02 * std::cos(5 * t),
                   0.038 + 0.006 * std::sin(7 * t));
      bench.input(0).relocated = i % 1000 == 999;
      bench.place(0, a).place(1, b, 0.3 * (1 + std::sin(20 * t))).step();
      msg::ToolPose pose{};
      pose.seq = static_cast<std::uint64_t>(i) + 1;
      pose.stamp_ns = i * 1'000'000LL;
      pose.valid = true;
      pose.orientation.w = i % 50 == 0 ? 0.3 : 1.0;
      line.hear(pose, i * 1'000'000LL);
      line.listen(i * 1'000'000LL, unused);
      static_cast<void>(line.answer(bench.output(), i * 1'000'000LL, 1e-3, false));
      haptic::fill_contact_message(0, bench.output(), bench.state(), bench.work().bodies, message);
      changes += bench.result().contacts != contacts;
      contacts = bench.result().contacts;
    }
  });
  EXPECT_EQ(asked, 0u);
  EXPECT_GT(changes, 100) << "the ticks were meant to make and lose contacts";
}

TEST(Allocation, NoneWhenABodyComesUnderAPress) {
#ifndef OMENTUM_COUNTS_MALLOC
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
  haptic::HapticModel model = make_model(block(), {round_tool()});
  model.spare_places = 1;
  Bench bench(std::move(model));
  const haptic::ElasticSurface& organ = bench.model().organs[0];
  bench.step_to({0.05, 0.05, 0.043});
  bench.move_to({0.05, 0.05, 0.036}, 200);
  for (int i = 0; i < 20; ++i) {
    for (haptic::BodyDoor& door : bench.work().doors) {
      const bool leaves = i % 3 == 2;
      door.post(leaves
                    ? nullptr
                    : std::make_unique<haptic::DeformedSurface>(organ.surface, organ.rest, organ.compliance));
    }
    EXPECT_EQ(allocations_of([&] { bench.step_to({0.05, 0.05, 0.036}); }), 0u) << "tick " << i;
  }
}

// A piece of the organ around a place, that swings.
haptic::LocalPatch patch_of(const haptic::ElasticSurface& organ, const Vec3& place, std::int64_t now_ns) {
  const test::OrganPatch around = test::nearest_patch(organ.surface, organ.rest, place, 24);
  haptic::LocalPatch patch;
  patch.arrival_ns = now_ns;
  for (const SurfaceId n : around.nodes) {
    patch.nodes.push_back(organ.file_node[n]);
    patch.positions.push_back(organ.rest[n] +
                              Vec3(0, 0, 1e-3 * std::sin(1e-8 * static_cast<double>(now_ns))));
  }
  patch.velocities.assign(around.nodes.size(), Vec3(0, 0, 0.02));
  patch.forces.assign(around.nodes.size(), Vec3::Zero());
  for (const auto& t : around.triangles)
    patch.triangles.push_back(
        {SurfaceId(std::int32_t{t[0]}), SurfaceId(std::int32_t{t[1]}), SurfaceId(std::int32_t{t[2]})});
  for (std::size_t i = 0; i < 3 * around.nodes.size(); ++i) {
    for (std::size_t j = i; j < 3 * around.nodes.size(); ++j)
      patch.compliance.push_back(
          static_cast<float>(organ.compliance.block(around.nodes[i / 3], around.nodes[j / 3])(i % 3, j % 3)));
  }
  return patch;
}

TEST(Allocation, NoneWhereLocalModelsFollowOneAnother) {
#ifndef OMENTUM_COUNTS_MALLOC
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
  Bench bench(make_model(block(), {round_tool()}));
  const Vec3 pressed(0.05, 0.05, 0.036);
  bench.step_to({0.05, 0.05, 0.045});
  for (int i = 0; i < 300; ++i) {
    bench.state().now_ns += 1'000'000;
    if (i % 5 == 0) {
      const haptic::LocalPatch patch = patch_of(bench.model().organs[0], pressed, bench.state().now_ns);
      ASSERT_EQ(haptic::reason_against(patch, 1), std::nullopt);
      bench.work().doors[0].post(haptic::make_local_body(patch));
    }
    const Vec3 tip = pressed + Vec3(0, 0, 0.009 * std::max(0.0, 1 - i / 100.0));
    EXPECT_EQ(allocations_of([&] { bench.step_to(tip); }), 0u) << "tick " << i;
  }
  EXPECT_GT(bench.output().force.z(), 0.1);
}

TEST(Allocation, CountingSeesTheHeap) {
#ifdef OMENTUM_COUNTS_MALLOC
  EXPECT_GE(allocations_of([] { std::vector<int> v(100); }), 1u);
#else
  GTEST_SKIP() << "the sanitizer owns malloc";
#endif
}

TEST(Allocation, NoneInAFrictionlessTick) {
  expect_no_allocation(0, haptic::ContactMode::kPoint);
}

TEST(Allocation, NoneWithFriction) {
  expect_no_allocation(0.4, haptic::ContactMode::kPoint);
}

TEST(Allocation, NoneInSpreadMode) {
  expect_no_allocation(0, haptic::ContactMode::kSpread);
}

}  // namespace
}  // namespace omentum::haptic_test
