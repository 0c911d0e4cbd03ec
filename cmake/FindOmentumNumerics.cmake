# The numeric libraries that have no CMake package of their own on every system, as targets: Omentum::openblas,
# Omentum::cholmod, Omentum::hdf5, Omentum::xxhash. Used by the build and by the installed package (OmentumConfig.cmake).
include(FindPackageHandleStandardArgs)

find_library(OMENTUM_OPENBLAS_LIBRARY openblas PATH_SUFFIXES openblas-pthread)
find_path(OMENTUM_OPENBLAS_INCLUDE cblas.h PATH_SUFFIXES openblas-pthread openblas)
find_library(OMENTUM_CHOLMOD_LIBRARY cholmod)
find_path(OMENTUM_CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse)
find_library(OMENTUM_HDF5_LIBRARY NAMES hdf5_serial hdf5 PATH_SUFFIXES hdf5/serial)
find_path(OMENTUM_HDF5_INCLUDE hdf5.h PATH_SUFFIXES hdf5/serial)
find_library(OMENTUM_XXHASH_LIBRARY xxhash)
find_path(OMENTUM_XXHASH_INCLUDE xxhash.h)

find_package_handle_standard_args(OmentumNumerics
  REQUIRED_VARS
    OMENTUM_OPENBLAS_LIBRARY OMENTUM_OPENBLAS_INCLUDE
    OMENTUM_CHOLMOD_LIBRARY OMENTUM_CHOLMOD_INCLUDE
    OMENTUM_HDF5_LIBRARY OMENTUM_HDF5_INCLUDE
    OMENTUM_XXHASH_LIBRARY OMENTUM_XXHASH_INCLUDE
  REASON_FAILURE_MESSAGE "Debian: apt install libopenblas-pthread-dev libsuitesparse-dev libhdf5-dev libxxhash-dev")
mark_as_advanced(
  OMENTUM_OPENBLAS_LIBRARY OMENTUM_OPENBLAS_INCLUDE
  OMENTUM_CHOLMOD_LIBRARY OMENTUM_CHOLMOD_INCLUDE
  OMENTUM_HDF5_LIBRARY OMENTUM_HDF5_INCLUDE
  OMENTUM_XXHASH_LIBRARY OMENTUM_XXHASH_INCLUDE)

foreach(name OPENBLAS CHOLMOD HDF5 XXHASH)
  string(TOLOWER ${name} target)
  if(OmentumNumerics_FOUND AND NOT TARGET Omentum::${target})
    add_library(Omentum::${target} UNKNOWN IMPORTED)
    set_target_properties(Omentum::${target} PROPERTIES
      IMPORTED_LOCATION "${OMENTUM_${name}_LIBRARY}"
      INTERFACE_INCLUDE_DIRECTORIES "${OMENTUM_${name}_INCLUDE}")
  endif()
endforeach()
