// What a person does with mouse and keys at this moment, as a window tells it.
#pragma once

#include <cstdint>

namespace omentum::render {

/// Since the last frame, and what is held down now. Off-screen: nothing, ever.
struct Pointer {
  bool inside = false;        // over the picture, and no widget of the panel has it
  float x = 0, y = 0;         // shares of the picture's width and height, from its upper left corner
  float dx = 0, dy = 0;       // pixels since the last frame
  float wheel = 0;            // steps since the last frame, positive away from the person
  std::uint32_t buttons = 0;  // msg::POINTER_LEFT, _RIGHT, _MIDDLE
  std::uint32_t keys = 0;     // msg::POINTER_KEY_*
  bool camera_key = false;    // while it is held down the pointer is the camera's
  bool next_tool = false;     // the key that picks another one went down
};

}  // namespace omentum::render
