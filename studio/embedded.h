// What:   the files of the page and the sample drawings, inside the program.
// Source: cmake/studio.cmake lists them.
// Differs: nothing.
// Cost:   their size in the program.
#pragma once

#include <span>
#include <string_view>

namespace inkgrid::studio {

struct EmbeddedFile {
  std::string_view name;  // "main.js"
  std::string_view bytes;
};

std::span<const EmbeddedFile> embedded_page();
std::span<const EmbeddedFile> embedded_samples();

// Null where there is none of the name.
const EmbeddedFile* find_embedded(std::span<const EmbeddedFile> files, std::string_view name);

// By the end of the name: "text/javascript".
std::string_view media_type(std::string_view name);

}  // namespace inkgrid::studio
