#include "runtime/processor.h"

#include "runtime/built_for.h"
#include "runtime/command_line.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace omentum::runtime {

extern const char* const kBuiltForNames[];  // built_for_names.cpp

std::span<const char* const> built_for() noexcept {
  std::size_t count = 0;
  while (kBuiltForNames[count]) ++count;
  return {kBuiltForNames, count};
}

std::string missing(std::span<const char* const> needed, const std::function<bool(const std::string&)>& has) {
  std::string list;
  for (const char* name : needed)
    if (!has(name)) list.append(list.empty() ? "" : ", ").append(name);
  return list;
}

#if defined(__x86_64__)
namespace {

struct InstructionSet {
  std::string_view name;
  bool there;
};

}  // namespace

bool processor_has(const std::string& name) {
  __builtin_cpu_init();
// the compiler takes a literal only
#define OMENTUM_HAS(literal) (InstructionSet{literal, __builtin_cpu_supports(literal) != 0})
#ifdef __clang__  // which knows no such names and would refuse the file
#define OMENTUM_HAS_NEWER(literal) (InstructionSet{literal, true})
#else
#define OMENTUM_HAS_NEWER(literal) OMENTUM_HAS(literal)
#endif
  const std::array known{OMENTUM_HAS("sse3"),
                         OMENTUM_HAS("ssse3"),
                         OMENTUM_HAS("sse4.1"),
                         OMENTUM_HAS("sse4.2"),
                         OMENTUM_HAS("sse4a"),
                         OMENTUM_HAS("popcnt"),
                         OMENTUM_HAS("avx"),
                         OMENTUM_HAS_NEWER("f16c"),
                         OMENTUM_HAS("fma"),
                         OMENTUM_HAS("fma4"),
                         OMENTUM_HAS("xop"),
                         OMENTUM_HAS("bmi"),
                         OMENTUM_HAS("bmi2"),
                         OMENTUM_HAS_NEWER("lzcnt"),
                         OMENTUM_HAS_NEWER("movbe"),
                         OMENTUM_HAS("avx2"),
                         OMENTUM_HAS_NEWER("avxvnni"),
                         OMENTUM_HAS("avx512f"),
                         OMENTUM_HAS("avx512cd"),
                         OMENTUM_HAS("avx512bw"),
                         OMENTUM_HAS("avx512dq"),
                         OMENTUM_HAS("avx512vl"),
                         OMENTUM_HAS("avx512ifma"),
                         OMENTUM_HAS("avx512vbmi"),
                         OMENTUM_HAS("avx512vbmi2"),
                         OMENTUM_HAS("avx512vnni"),
                         OMENTUM_HAS("avx512bitalg"),
                         OMENTUM_HAS("avx512bf16"),
                         OMENTUM_HAS("avx512vpopcntdq"),
                         OMENTUM_HAS_NEWER("avx512fp16")};
#undef OMENTUM_HAS_NEWER
#undef OMENTUM_HAS
  const auto found = std::ranges::find(known, name, &InstructionSet::name);
  return found != known.end() && found->there;
}
#else
// built for another family, whose programs do not even start elsewhere; -march=native gives no list of names
// there
bool processor_has(const std::string&) {
  return true;
}
#endif

void require_processor() {
  const std::string lacks = missing(built_for(), processor_has);
  if (lacks.empty()) return;
  throw MachineLacks("this processor lacks " + lacks +
                     ", for which the program was built; build it on this machine, or with "
                     "-DOMENTUM_NATIVE=OFF for every machine");
}

}  // namespace omentum::runtime
