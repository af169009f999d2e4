# Installs into an empty folder, and builds the pages' programs against it.
set(place ${BUILD}/consumer)
set(source ${CMAKE_CURRENT_LIST_DIR}/../..)
file(REMOVE_RECURSE ${place})

function(run)
  execute_process(COMMAND ${ARGN} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${place}/installed)
file(GLOB helpers RELATIVE ${BUILD}/host/external/helpers ${BUILD}/host/external/helpers/swage-*)
foreach(helper IN LISTS helpers)
  if(NOT EXISTS ${place}/installed/libexec/swage/${helper})
    message(FATAL_ERROR "${helper} is not installed")
  endif()
endforeach()
file(GLOB pages ${source}/README.md ${source}/host/*/README.md)
run(${PYTHON} ${CMAKE_CURRENT_LIST_DIR}/pages.py ${place}/pages ${place}/installed/bin ${pages})
# For other vectors than the library, by which Eigen would align otherwise.
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_FLAGS=-march=native
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${place}/installed -DPAGES=${place}/pages)
run(${CMAKE_COMMAND} --build ${place}/build)
