# Both DDS vendors, in whichever of the versions that transport/ speaks (docs/vendors.md): Omentum::fast_dds and
# CycloneDDS::ddsc, in all folders. A package's own check of versions is not asked: it refuses all but the major version
# that is named, and an installed newer one would be passed over in silence.

# omentum_dds_version(NAME VERSION FIRST BEYOND): stops unless FIRST <= VERSION < BEYOND.
function(omentum_dds_version name version first beyond)
  if(version VERSION_LESS first OR NOT version VERSION_LESS beyond)
    message(FATAL_ERROR "${name} ${version} was found; Omentum is written for ${first} and later, below ${beyond}")
  endif()
endfunction()

# omentum_fast_dds(): Fast DDS is `fastdds` from 3 on, `fastrtps` before
function(omentum_fast_dds)
  find_package(fastcdr REQUIRED)
  find_package(fastdds QUIET CONFIG)
  if(fastdds_FOUND)
    set(package fastdds)
  else()
    find_package(fastrtps QUIET CONFIG)
    if(NOT fastrtps_FOUND)
      message(FATAL_ERROR "Fast DDS was not found, neither as fastdds (3.x) nor as fastrtps (2.9 to 2.14); install libfastrtps-dev")
    endif()
    set(package fastrtps)
  endif()
  omentum_dds_version("Fast DDS" "${${package}_VERSION}" 2.9 4)
  add_library(omentum_fast_dds INTERFACE)
  add_library(Omentum::fast_dds ALIAS omentum_fast_dds)
  target_link_libraries(omentum_fast_dds INTERFACE ${package} fastcdr)
  message(STATUS "Fast DDS ${${package}_VERSION}")
endfunction()

function(omentum_cyclone_dds)
  find_package(CycloneDDS QUIET CONFIG)
  if(NOT CycloneDDS_FOUND)
    message(FATAL_ERROR "Cyclone DDS was not found; install cyclonedds-dev")
  endif()
  omentum_dds_version("Cyclone DDS" "${CycloneDDS_VERSION}" 0.10 12)
  message(STATUS "Cyclone DDS ${CycloneDDS_VERSION}")
endfunction()

set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
omentum_fast_dds()
omentum_cyclone_dds()
unset(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL)
