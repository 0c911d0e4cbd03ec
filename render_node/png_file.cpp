#include "render_node/png_file.h"

#include "files/png_file.h"

#include <png.h>

#include <stdexcept>
#include <string>

namespace omentum::render {

void write_png(const Picture& picture, const std::filesystem::path& file) {
  files::write_png(file, picture.size.width, picture.size.height, picture.rgba);
}

Picture read_png(const std::filesystem::path& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const auto refuse = [&] {
    const std::string reason = header.message;
    png_image_free(&header);
    throw std::runtime_error(file.string() + ": not a readable PNG picture: " + reason);
  };
  if (!png_image_begin_read_from_file(&header, file.c_str())) refuse();
  header.format = PNG_FORMAT_RGBA;
  Picture picture{{static_cast<int>(header.width), static_cast<int>(header.height)}, {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(header));
  if (!png_image_finish_read(&header, nullptr, picture.rgba.data(), 0, nullptr)) refuse();
  return picture;
}

}  // namespace omentum::render
