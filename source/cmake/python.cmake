# The commands of the Python package, source/python: launchers that start it where it lies, so that none of it needs pip.
set(SCREE_PYTHON /usr/bin/python3 CACHE FILEPATH "Python 3.10 or later with numpy, matplotlib and VTK")

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/source/python/pyproject.toml)
file(STRINGS ${CMAKE_SOURCE_DIR}/source/python/pyproject.toml commands REGEX "^scree-.*:main")
foreach(command ${commands})
  string(REGEX REPLACE "^(scree-[a-z-]*) = \"scree[.](.*):main\"$" "\\1;\\2" command ${command})
  list(GET command 0 name)
  list(GET command 1 launcher_module)
  set(launcher_folder ${CMAKE_SOURCE_DIR}/source/python)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/launcher.in ${CMAKE_BINARY_DIR}/launchers/build/${name} @ONLY)
  set(launcher_folder "$(dirname -- \"$(readlink -f -- \"$0\")\")/../share/scree/python")
  configure_file(${CMAKE_CURRENT_LIST_DIR}/launcher.in ${CMAKE_BINARY_DIR}/launchers/install/${name} @ONLY)
  file(COPY ${CMAKE_BINARY_DIR}/launchers/build/${name} DESTINATION ${CMAKE_BINARY_DIR}
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  install(PROGRAMS ${CMAKE_BINARY_DIR}/launchers/install/${name} DESTINATION bin)
endforeach()
install(DIRECTORY source/python/scree DESTINATION share/scree/python PATTERN __pycache__ EXCLUDE)
