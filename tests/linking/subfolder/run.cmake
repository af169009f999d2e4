# Builds TARGET of the library as somebody else's shared subfolder at PLACE, without the parts named in OFF (all
# optional ones), commas between them, and runs what uses it where that is the target.
if(NOT DEFINED OFF)
  set(OFF OPENMP,OPENCL,CHOLMOD,EMBREE,RENDER,TETGEN,CGAL)
endif()

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${PLACE} -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=
    -DCMAKE_CXX_COMPILER=${COMPILER} -DOFF=${OFF})
run(${CMAKE_COMMAND} --build ${PLACE} --target ${TARGET})
if("${TARGET}" STREQUAL border)
  run(${PLACE}/border)
endif()
