# The studio: its server, and its page and some samples inside the program.
pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)

file(GLOB studio_page CONFIGURE_DEPENDS studio/page/*)
set(studio_samples)
foreach(name fox rough-teapot house light-on-dark)
  list(APPEND studio_samples ${PROJECT_BINARY_DIR}/samples/${name}.png)
endforeach()

# A C++ file with the bytes of FILES, which FUNCTION names.
function(embed_files target function)
  set(assembly "")
  set(symbols "")
  set(rows "")
  set(index 0)
  foreach(file ${ARGN})
    cmake_path(GET file FILENAME name)
    set(symbol ${function}_${index})
    string(APPEND assembly "asm(\".section .rodata\\n${symbol}_begin: .incbin \\\"${file}\\\"\\n${symbol}_end: .byte 0\\n.previous\");\n")
    string(APPEND symbols "extern const char ${symbol}_begin[], ${symbol}_end[];\n")
    string(APPEND rows "      EmbeddedFile{\"${name}\", {${symbol}_begin, ${symbol}_end}},\n")
    math(EXPR index "${index} + 1")
  endforeach()
  set(source ${PROJECT_BINARY_DIR}/studio/${function}.cpp)
  file(CONFIGURE OUTPUT ${source} @ONLY CONTENT "#include <array>\n\n#include \"embedded.h\"\n
${assembly}
extern \"C\" {
${symbols}}\n
namespace inkgrid::studio {\n
std::span<const EmbeddedFile> ${function}() {
  static const std::array files{
${rows}  };
  return files;
}\n
}  // namespace inkgrid::studio\n")
  set_property(SOURCE ${source} PROPERTY OBJECT_DEPENDS "${ARGN}")
  target_sources(${target} PRIVATE ${source})
endfunction()

add_library(inkgrid_studio STATIC
  studio/answers.cpp
  studio/arguments.cpp
  studio/browser.cpp
  studio/documents.cpp
  studio/embedded.cpp
  studio/event_stream.cpp
  studio/guard.cpp
  studio/recording.cpp
  studio/server.cpp
  studio/solve.cpp
  studio/studio.cpp)
embed_files(inkgrid_studio embedded_page ${studio_page})
embed_files(inkgrid_studio embedded_samples ${studio_samples})
target_include_directories(inkgrid_studio PUBLIC ${PROJECT_SOURCE_DIR} PRIVATE src studio)
target_link_libraries(inkgrid_studio PRIVATE inkgrid PkgConfig::HTTPLIB nlohmann_json::nlohmann_json CLI11::CLI11 Threads::Threads)
target_link_libraries(inkgrid_cli PRIVATE inkgrid_studio)
