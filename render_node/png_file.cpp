#include "render_node/png_file.h"

#include "files/whole_file.h"

#include <png.h>

#include <stdexcept>
#include <string>

namespace omentum::render {

void write_png(const Picture& picture, const std::filesystem::path& file) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(picture.size.width);
  header.height = static_cast<png_uint_32>(picture.size.height);
  header.format = PNG_FORMAT_RGBA;
  header.flags = PNG_IMAGE_FLAG_FAST;  // a third of the time for a tenth more bytes

  const auto refuse = [&](const std::string& reason) {
    throw std::runtime_error(file.string() + ": cannot write the picture: " + reason);
  };
  // in memory first: libpng gives no reason for what the disk refuses
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, picture.rgba.data(), 0, nullptr)) {
    refuse(header.message);
  }
  files::write_whole(file, {bytes.data(), size});
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
