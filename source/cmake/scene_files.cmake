# Writes HEADER with the files of the scenes of `scree --new`, as rows of a table in C++. SCENES: one "NAME FILE..." each, the case first;
# files count from FOLDER.
set(rows "")
foreach(scene ${SCENES})
  separate_arguments(words UNIX_COMMAND "${scene}")
  list(POP_FRONT words name)
  foreach(path ${words})
    file(READ ${FOLDER}/${path} text)
    get_filename_component(file ${path} NAME)
    string(APPEND rows "{ \"${name}\", \"${file}\", R\"scree(${text})scree\" },\n")
  endforeach()
endforeach()
file(WRITE ${HEADER} "${rows}")
