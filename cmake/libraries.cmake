# The libraries that the rooms stand on (Debian 12 packages, scripts/install_packages), for the tree and, installed beside
# strandlabConfig.cmake, for who uses the rooms.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(fmt)
find_dependency(spdlog)
find_dependency(nlohmann_json)
find_dependency(PkgConfig)
find_dependency(Boost 1.74)
find_dependency(HDF5 COMPONENTS C)

# Libraries whose Debian packages carry no CMake config of their own.
function(strandlab_import target)
  cmake_parse_arguments(ARG "" "" "INCLUDES;LIBRARIES" ${ARGN})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${ARG_INCLUDES})
  target_link_libraries(${target} INTERFACE ${ARG_LIBRARIES})
endfunction()

if(NOT TARGET HDF5::HDF5)  # newer CMake brings it
  strandlab_import(HDF5::HDF5 INCLUDES ${HDF5_INCLUDE_DIRS} LIBRARIES ${HDF5_C_LIBRARIES})
endif()

if(NOT TARGET SuiteSparse::CHOLMOD)
  find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
  find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
  find_library(OPENBLAS_LIBRARY openblas REQUIRED)
  strandlab_import(SuiteSparse::CHOLMOD INCLUDES ${CHOLMOD_INCLUDE} LIBRARIES ${CHOLMOD_LIBRARY} ${OPENBLAS_LIBRARY})
endif()

if(NOT TARGET Cairo::Cairo)
  pkg_check_modules(CAIRO REQUIRED cairo)
  strandlab_import(Cairo::Cairo INCLUDES ${CAIRO_INCLUDE_DIRS} LIBRARIES ${CAIRO_LIBRARIES})
endif()

if(NOT TARGET tomlplusplus::tomlplusplus)
  pkg_check_modules(TOMLPP REQUIRED tomlplusplus)
  strandlab_import(tomlplusplus::tomlplusplus INCLUDES "${TOMLPP_INCLUDE_DIRS}" LIBRARIES "${TOMLPP_LIBRARIES}")
  target_compile_options(tomlplusplus::tomlplusplus INTERFACE ${TOMLPP_CFLAGS_OTHER})  # the compiled library, not its headers
endif()
