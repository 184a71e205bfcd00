# tks_embed(NAME FILE): NAME.inc in the build folder of this directory holds the bytes of FILE as
# the numbers of an array.
function(tks_embed name file)
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," numbers "${hex}")
  file(GENERATE OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/${name}.inc" CONTENT "${numbers}\n")
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${file}")
endfunction()
