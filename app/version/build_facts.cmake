# Writes what is known of this build into a header, and leaves one that says so already as it is.
# cmake -D source=FOLDER -D header=FILE -D type=... -D compiler=... -D libraries=... -P build_facts.cmake
set(commit "unknown")  # no git here, or sources without their history
find_program(git git)
if(git)
  # Of the source folder itself: an unpacked release may lie within somebody else's repository.
  execute_process(COMMAND ${git} --git-dir=${source}/.git --work-tree=${source} describe --always --dirty --abbrev=12
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
  if(code EQUAL 0)
    set(commit "${described}")
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_facts.h.in ${header} @ONLY)
