# Writes facts about this build to a header. The header is not touched if nothing has changed. Usage:
# cmake -D source=FOLDER -D header=FILE -D type=... -D compiler=... -D libraries=... -P build_facts.cmake
set(commit "unknown")  # used if git or the source's history is not available
find_program(git git)
if(git)
  # Use only the .git folder in the source folder itself, because an unpacked release may lie inside a different
  # repository.
  execute_process(COMMAND ${git} --git-dir=${source}/.git --work-tree=${source} describe --always --dirty --abbrev=12
                  OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE code)
  if(code EQUAL 0)
    set(commit "${described}")
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_facts.h.in ${header} @ONLY)
