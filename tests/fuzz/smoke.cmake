# Builds the fuzz targets and runs each for two seconds, the same bytes first each time.
set(launcher "")
if(LAUNCHER)
  set(launcher -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
endif()
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH tests)
file(REMOVE_RECURSE ${BUILD}/tests/fuzz/corpus)
set(ENV{SWAGE_FUZZ_SEED} 1)
foreach(command "${CMAKE_COMMAND};--preset;fuzz;-B;${BUILD};${launcher}"
                "${CMAKE_COMMAND};--build;${BUILD};--parallel;2;--target;fuzz"
                "${CMAKE_CURRENT_LIST_DIR}/run;${BUILD};2")
  execute_process(COMMAND ${command} WORKING_DIRECTORY ${tests}/.. COMMAND_ERROR_IS_FATAL ANY)
endforeach()
