# Debian 12 packages, installed by scripts/install_packages.
find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(PkgConfig REQUIRED)

find_package(Boost 1.74 REQUIRED)

# Libraries whose Debian packages carry no CMake config of their own.
function(strandlab_import target)
  cmake_parse_arguments(ARG "" "" "INCLUDES;LIBRARIES" ${ARGN})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${ARG_INCLUDES})
  target_link_libraries(${target} INTERFACE ${ARG_LIBRARIES})
endfunction()

find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(OPENBLAS_LIBRARY openblas REQUIRED)
strandlab_import(SuiteSparse::CHOLMOD INCLUDES ${CHOLMOD_INCLUDE} LIBRARIES ${CHOLMOD_LIBRARY} ${OPENBLAS_LIBRARY})

pkg_check_modules(CAIRO REQUIRED cairo)
strandlab_import(Cairo::Cairo INCLUDES ${CAIRO_INCLUDE_DIRS} LIBRARIES ${CAIRO_LIBRARIES})

find_package(HDF5 REQUIRED COMPONENTS C)
if(NOT TARGET HDF5::HDF5)  # newer CMake brings it
  strandlab_import(HDF5::HDF5 INCLUDES ${HDF5_INCLUDE_DIRS} LIBRARIES ${HDF5_C_LIBRARIES})
endif()

pkg_check_modules(TOMLPP REQUIRED tomlplusplus)
strandlab_import(tomlplusplus::tomlplusplus INCLUDES "${TOMLPP_INCLUDE_DIRS}" LIBRARIES "${TOMLPP_LIBRARIES}")
target_compile_options(tomlplusplus::tomlplusplus INTERFACE ${TOMLPP_CFLAGS_OTHER})  # the compiled library, not its headers
