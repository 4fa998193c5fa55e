# What find_package(strandlab) finds after an installation: libraries, headers, and the libraries they stand on.
include(CMakePackageConfigHelpers)
set(package lib/cmake/strandlab)
install(DIRECTORY src/strandlab DESTINATION include FILES_MATCHING PATTERN "*.hpp")
install(EXPORT strandlab NAMESPACE strandlab:: DESTINATION ${package} FILE rooms.cmake)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/strandlabConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES cmake/strandlabConfig.cmake cmake/libraries.cmake ${PROJECT_BINARY_DIR}/strandlabConfigVersion.cmake
  DESTINATION ${package})

# Eigen aligns its vectors by the instruction set of who includes it: a program for AVX must see ours as we built them.
if(NOT STRANDLAB_NATIVE)
  target_compile_definitions(strandlab_core INTERFACE $<INSTALL_INTERFACE:EIGEN_MAX_ALIGN_BYTES=16>)
endif()
