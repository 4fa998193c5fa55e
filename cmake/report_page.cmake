# The page of report.html: web/ bundled into one HTML file that becomes part of the program. A build without Node.js and npm
# leaves it out; the program then takes report.html of a release from share/strandlab.
option(STRANDLAB_WEB "Bundle the report's page where Node.js and npm are found" ON)
find_program(STRANDLAB_NODE node)
find_program(STRANDLAB_NPM npm)

if(STRANDLAB_WEB AND STRANDLAB_NODE AND STRANDLAB_NPM)
  set(STRANDLAB_PAGE ${PROJECT_BINARY_DIR}/web/report.html)
  set(web ${PROJECT_SOURCE_DIR}/web)
  # Sources name the sections of the documentation that the page carries.
  file(GLOB web_sources CONFIGURE_DEPENDS ${web}/src/* ${PROJECT_SOURCE_DIR}/docs/*.md
       ${PROJECT_SOURCE_DIR}/src/strandlab/report/*.cpp ${PROJECT_SOURCE_DIR}/src/strandlab/run/*.cpp ${PROJECT_SOURCE_DIR}/src/strandlab/study/*.cpp)
  add_custom_command(OUTPUT ${STRANDLAB_PAGE}
    COMMAND ${web}/bundle ${STRANDLAB_PAGE}
    DEPENDS ${web_sources} ${web}/bundle ${web}/build.mjs ${web}/package.json ${web}/package-lock.json
    COMMENT "Bundling the report's page")
  set_source_files_properties(src/strandlab/report/html.cpp PROPERTIES
    OBJECT_DEPENDS ${STRANDLAB_PAGE} COMPILE_DEFINITIONS STRANDLAB_REPORT_PAGE="${STRANDLAB_PAGE}")
  install(FILES ${STRANDLAB_PAGE} DESTINATION share/strandlab OPTIONAL)
else()
  message(STATUS "Node.js or npm is missing: strandlab will take the report's page from share/strandlab/report.html")
endif()
