# cmake --install: the programs, and the libraries that other programs may build on, as the package Omentum. One of
# them alone: --component programs, --component development.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

foreach(program haptic_node deform_node render_node virtual_device ros_bridge omentum_domain omentum_session device_check organ_build organ_solve organ_check organ_phantom
    scene_prepare force_map tissue_compare)
  if(TARGET ${program})
    install(TARGETS ${program} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
  endif()
endforeach()

if(NOT TARGET omentum_geometry OR NOT TARGET omentum_physics OR NOT TARGET omentum_organ)
  return()
endif()

set(omentum_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Omentum)

install(TARGETS omentum_files omentum_geometry omentum_physics omentum_organ EXPORT OmentumTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
foreach(room geometry physics organ)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${room} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/omentum
    COMPONENT development FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT OmentumTargets NAMESPACE Omentum:: DESTINATION ${omentum_package_dir} COMPONENT development)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/OmentumConfig.cmake.in
  ${PROJECT_BINARY_DIR}/OmentumConfig.cmake INSTALL_DESTINATION ${omentum_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/OmentumConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${PROJECT_BINARY_DIR}/OmentumConfig.cmake
  ${PROJECT_BINARY_DIR}/OmentumConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindOmentumLz4.cmake
  ${PROJECT_SOURCE_DIR}/cmake/FindOmentumNumerics.cmake
  DESTINATION ${omentum_package_dir} COMPONENT development)
