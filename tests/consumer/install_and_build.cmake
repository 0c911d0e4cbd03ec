# Installs the libraries into the build folder, then configures, builds and runs the consumer against them.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}")
  endif()
endfunction()

file(REMOVE_RECURSE ${CONSUMER_BUILD})
run(${CMAKE_COMMAND} --install ${OMENTUM_BUILD} --prefix ${CONSUMER_BUILD}/install --component development)
run(${CMAKE_COMMAND} -S ${CONSUMER_SOURCE} -B ${CONSUMER_BUILD}/build
  -DCMAKE_BUILD_TYPE=Release -DCMAKE_PREFIX_PATH=${CONSUMER_BUILD}/install)
run(${CMAKE_COMMAND} --build ${CONSUMER_BUILD}/build)
run(${CONSUMER_BUILD}/build/consumer ${CONSUMER_BUILD}/tetrahedron.h5)
