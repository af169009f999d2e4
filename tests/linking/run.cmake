# Builds the library as somebody else's shared subfolder, and what uses it across that border.
set(place ${BUILD}/linking)

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place} -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER})
run(${CMAKE_COMMAND} --build ${place} --target border)
run(${place}/border)
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/symbols.py ${place}/swage/libswage.so ${CMAKE_CURRENT_LIST_DIR}/../../include/swage)
