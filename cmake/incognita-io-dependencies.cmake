# The libraries behind incognita::io, for this build and for find_package(incognita COMPONENTS io).
# Sets incognita_io_missing to those that are not found, Debian's package in brackets.
set(incognita_io_missing)
foreach(library IN ITEMS "pugixml (libpugixml-dev)" "yaml-cpp (libyaml-cpp-dev)" "PNG (libpng-dev)"
                         "ZLIB (zlib1g-dev)" "nlohmann_json (nlohmann-json3-dev)")
  string(REGEX REPLACE " .*" "" package "${library}")
  find_package(${package} QUIET)
  if(NOT "${${package}_FOUND}")
    list(APPEND incognita_io_missing "${library}")
  endif()
endforeach()
