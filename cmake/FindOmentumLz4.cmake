# LZ4, which has no CMake package of its own on every system, as the target Omentum::lz4. Used by the build and by the
# installed package (OmentumConfig.cmake).
include(FindPackageHandleStandardArgs)

find_library(OMENTUM_LZ4_LIBRARY lz4)
find_path(OMENTUM_LZ4_INCLUDE lz4.h)

find_package_handle_standard_args(OmentumLz4
  REQUIRED_VARS OMENTUM_LZ4_LIBRARY OMENTUM_LZ4_INCLUDE
  REASON_FAILURE_MESSAGE "Debian: apt install liblz4-dev")
mark_as_advanced(OMENTUM_LZ4_LIBRARY OMENTUM_LZ4_INCLUDE)

if(OmentumLz4_FOUND AND NOT TARGET Omentum::lz4)
  add_library(Omentum::lz4 UNKNOWN IMPORTED)
  set_target_properties(Omentum::lz4 PROPERTIES
    IMPORTED_LOCATION "${OMENTUM_LZ4_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${OMENTUM_LZ4_INCLUDE}")
endif()
