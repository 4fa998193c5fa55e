# find_package(strandlab): targets strandlab::run and the rooms below it (docs/architecture.md).
include(${CMAKE_CURRENT_LIST_DIR}/libraries.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/rooms.cmake)
