# Writes version.h with the state of the source tree at build time (cmake -P), and defines the target that does
# so (include). The header is only touched when it changes; outside of git the sha is empty.
#   cmake -DSOURCE=... -DOUTPUT=... -DPTBENCH_VERSION=... -DPTBENCH_COMPILER=... -P Version.cmake

function(ptbench_git_state sha dirty)
  set(found_sha "")
  set(found_dirty false)
  find_program(GIT git)
  if(GIT)
    execute_process(COMMAND ${GIT} -C ${SOURCE} rev-parse --show-prefix HEAD OUTPUT_VARIABLE answer
                    RESULT_VARIABLE failed ERROR_QUIET)
    # A prefix means that some other repository holds this tree; its sha would say nothing.
    if(NOT failed AND answer MATCHES "^\n([0-9a-f]+)")
      set(found_sha ${CMAKE_MATCH_1})
      execute_process(COMMAND ${GIT} -C ${SOURCE} status --porcelain --untracked-files=no
                      OUTPUT_VARIABLE changes ERROR_QUIET)
      if(changes)
        set(found_dirty true)
      endif()
    endif()
  endif()
  set(${sha} "${found_sha}" PARENT_SCOPE)
  set(${dirty} ${found_dirty} PARENT_SCOPE)
endfunction()

if(CMAKE_SCRIPT_MODE_FILE)
  ptbench_git_state(PTBENCH_GIT_SHA PTBENCH_GIT_DIRTY)
  configure_file(${SOURCE}/bench/version.h.in ${OUTPUT} @ONLY)
else()
  set(PTBENCH_VERSION_DIR ${PROJECT_BINARY_DIR}/generated)
  get_filename_component(ptbench_source ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
  set(ptbench_compiler "${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}")
  add_custom_target(ptbench_version_header
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${ptbench_source} -DOUTPUT=${PTBENCH_VERSION_DIR}/bench/version.h
            -DPTBENCH_VERSION=${PROJECT_VERSION} "-DPTBENCH_COMPILER=${ptbench_compiler}"
            -P ${CMAKE_CURRENT_LIST_FILE}
    BYPRODUCTS ${PTBENCH_VERSION_DIR}/bench/version.h
    COMMENT "Version header" VERBATIM)
  add_library(ptbench_version INTERFACE)
  target_include_directories(ptbench_version INTERFACE ${PTBENCH_VERSION_DIR})
  add_dependencies(ptbench_version ptbench_version_header)
endif()
