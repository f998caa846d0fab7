# Installs the build into an empty prefix and checks that what is installed can be moved to another machine.
file(REMOVE_RECURSE "${prefix}")
execute_process(COMMAND ${CMAKE_COMMAND} --install "${build}" --prefix "${prefix}" COMMAND_ERROR_IS_FATAL ANY)

file(GLOB_RECURSE package_files "${prefix}/*.cmake" "${prefix}/*.pc")
foreach(package_file IN LISTS package_files)
  file(READ "${package_file}" text)
  foreach(place IN ITEMS "${source}" "${build}" "${prefix}")
    string(FIND "${text}" "${place}" found)
    if(NOT found EQUAL -1)
      message(FATAL_ERROR "${package_file} names ${place}")
    endif()
  endforeach()
endforeach()

# Elsewhere, for those who must find it there.
file(REMOVE_RECURSE "${prefix}_moved")
file(COPY "${prefix}/" DESTINATION "${prefix}_moved")
