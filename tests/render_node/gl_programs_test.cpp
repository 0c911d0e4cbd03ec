// Programs are compiled when a frame first needs them: here all are.
#include "render_node/gl/gl_context.h"
#include "render_node/gl/programs.h"

#include <gtest/gtest.h>

namespace omentum::render::gl {
namespace {

TEST(GlPrograms, EveryLookCompilesForEveryShading) {
  std::unique_ptr<GlContext> context;
  try {
    context = open_egl_context({16, 16});
  } catch (const DisplayError& error) {
    GTEST_SKIP() << error.what();
  }
  for (std::size_t s = 0; s < kShadingCount; ++s) {
    Programs programs(static_cast<Shading>(s));
    for (std::size_t look = 0; look < kLookCount; ++look)
      EXPECT_NO_THROW(programs.of(static_cast<Look>(look))) << "look " << look << ", shading " << s;
    EXPECT_NO_THROW(programs.backdrop());
    EXPECT_NO_THROW(programs.lens());
    EXPECT_EQ(&programs.of(Look::kTissue), &programs.of(Look::kTissue)) << "once";
  }
}

}  // namespace
}  // namespace omentum::render::gl
