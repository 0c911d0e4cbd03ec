#include "render_node/option_words.h"

#include <cstdio>

namespace omentum::render {

std::string parse_size(const std::string& text, Size& size) {
  char rest = 0;
  const int found = std::sscanf(text.c_str(), "%dx%d%c", &size.width, &size.height, &rest);
  if (found == 2 && size.width >= 64 && size.height >= 64 && size.width <= 8192 && size.height <= 8192)
    return {};
  return "found " + text + ", expected WIDTHxHEIGHT from 64x64 to 8192x8192";
}

std::string parse_map(const std::string& text, TissueMap& map) {
  for (const TissueMap known : {TissueMap::kStrain, TissueMap::kStress}) {
    if (text != word(known)) continue;
    map = known;
    return {};
  }
  return "found " + text + ", expected strain or stress";
}

}  // namespace omentum::render
