#include "files/png_file.h"

#include "files/whole_file.h"

#include <png.h>

#include <stdexcept>
#include <string>

namespace omentum::files {

void write_png(const std::filesystem::path& file, int width, int height, std::span<const std::uint8_t> rgba) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(width);
  header.height = static_cast<png_uint_32>(height);
  header.format = PNG_FORMAT_RGBA;
  header.flags = PNG_IMAGE_FLAG_FAST;  // a third of the time for a tenth more bytes
  // in memory first: libpng gives no reason for what the disk refuses
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, rgba.data(), 0, nullptr))
    throw std::runtime_error(file.string() + ": cannot write the picture: " + header.message);
  write_whole(file, {bytes.data(), size});
}

}  // namespace omentum::files
