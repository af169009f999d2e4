# Installs into an empty folder, builds the consumer against it, and reshapes the demo's chair with it.
set(place ${BUILD}/consumer)
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
run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${place}/build -G Ninja -DCMAKE_BUILD_TYPE=Release
    -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${place}/installed)
run(${CMAKE_COMMAND} --build ${place}/build)
run(${place}/installed/bin/swage demo ${place}/demo)
run(${place}/build/readme_example ${place}/demo/rest.obj ${place}/taller.obj)
run(${PROGRAM} info ${place}/taller.obj)
