# The command line, split so that the tests can link its parts: everything but main is tks_cli.
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)

set(commands
  command_compare.cpp command_decode.cpp command_encode.cpp command_info.cpp command_line.cpp
  command_synth.cpp command_truncate.cpp command_verify.cpp encode_arguments.cpp)
tks_room(tks_cli
  SOURCES
    ${commands} comparison.cpp json.cpp output.cpp output_names.cpp progress.cpp
    report.cpp report_page.cpp report_plot.cpp scene.cpp stream.cpp viewed_mesh.cpp
  USES tetrakis tks_files tks_render tks_synth tks_conformance CLI11::CLI11
    nlohmann_json::nlohmann_json)
target_link_libraries(tks_cli PRIVATE PkgConfig::TKS_FILE_FORMATS)  # base64
# CLI11 is all in headers, and compiled whole wherever they are included: for 10 to 15 s.
set_target_properties(tks_cli PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
set_source_files_properties(${commands} PROPERTIES UNITY_GROUP commands)

add_executable(tetrakis_cli main.cpp)
set_target_properties(tetrakis_cli PROPERTIES OUTPUT_NAME tetrakis)
target_link_libraries(tetrakis_cli PRIVATE tks_cli)
install(TARGETS tetrakis_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
